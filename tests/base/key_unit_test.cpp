// Units are read off the end of a key.
#include "hamilcar/base/key_unit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hamilcar {
namespace {

TEST(KeyUnit, IsTheEndOfTheKey) {
    EXPECT_EQ(unit_of_key("mass_kg").symbol, "kg");
    EXPECT_EQ(unit_of_key("mass_kg").stem, "mass");
    EXPECT_EQ(unit_of_key("center_of_mass_m").stem, "center_of_mass");
    EXPECT_EQ(unit_of_key("inertia_kg_m2").symbol, "kg m^2");
    EXPECT_EQ(unit_of_key("damping_N_s_per_m").symbol, "N s/m");
    EXPECT_EQ(unit_of_key("windup_damping_N_m_s_per_rad").symbol, "N m s/rad");
    EXPECT_EQ(unit_of_key("air_density_kg_per_m3").symbol, "kg/m^3");
    EXPECT_EQ(unit_of_key("rack_m_per_revolution").symbol, "m/revolution");
    EXPECT_EQ(unit_of_key("stabilization_gain_per_s").symbol, "1/s");
    EXPECT_EQ(unit_of_key("stabilization_gain_per_s").stem, "stabilization_gain");
}

TEST(KeyUnit, MayBeNone) {
    for (const std::string_view key : {"friction", "drag_coefficient", "longitudinal_stiffness_per_load", "m", ""}) {
        EXPECT_EQ(unit_of_key(key).symbol, "") << key;
        EXPECT_EQ(unit_of_key(key).stem, key);
    }
}

TEST(KeyUnit, ConvertsDegreesAndPercent) {
    EXPECT_DOUBLE_EQ(unit_of_key("camber_deg").to_si, M_PI / 180);
    EXPECT_DOUBLE_EQ(unit_of_key("angular_velocity_deg_per_s").to_si, M_PI / 180);
    EXPECT_EQ(unit_of_key("angular_velocity_deg_per_s").symbol, "deg/s");
    EXPECT_EQ(unit_of_key("grade_percent").to_si, 0.01);
    EXPECT_EQ(unit_of_key("mass_kg").to_si, 1);
    EXPECT_EQ(unit_of_key("max_power_W").symbol, "W");
}

TEST(KeyUnit, ConvertsEngineSpeeds) {
    EXPECT_EQ(unit_of_key("idle_rpm").symbol, "rpm");
    EXPECT_DOUBLE_EQ(60 * unit_of_key("idle_rpm").to_si, 2 * M_PI);
    // A condition inside of a key is no unit.
    EXPECT_EQ(unit_of_key("pump_torque_at_2000rpm_N_m").symbol, "N m");
    EXPECT_EQ(unit_of_key("pump_torque_at_2000rpm_N_m").to_si, 1);
}

TEST(KeyUnit, ConvertsThoseOfBrakes) {
    EXPECT_DOUBLE_EQ(unit_of_key("master_cylinder_diameter_mm").to_si, 1e-3);
    EXPECT_DOUBLE_EQ(unit_of_key("knee_pressure_bar").to_si, 1e5);
    EXPECT_EQ(unit_of_key("pump_flow_cm3_per_s").symbol, "cm^3/s");
    EXPECT_DOUBLE_EQ(unit_of_key("pump_flow_cm3_per_s").to_si, 1e-6);
    EXPECT_EQ(unit_of_key("cooling_W_s_per_K_m").symbol, "W s/(K m)");
    EXPECT_DOUBLE_EQ(unit_of_key("gain_bar_per_deg").to_si, 1e5 / (M_PI / 180));
    EXPECT_EQ(unit_of_key("anti_roll_bar").symbol, "");
    EXPECT_EQ(unit_of_key("rate_hz").symbol, "Hz");
}

}  // namespace
}  // namespace hamilcar
