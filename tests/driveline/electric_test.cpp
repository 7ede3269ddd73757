// Motors by maps, the battery and the shafts behind a gearbox with an inertia, each by itself and by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/vehicle/build_powertrain.hpp"

namespace hamilcar {
namespace {

MotorDescription mapped_motor() {
    MotorDescription d{.max_torque = 200, .max_power = 60e3, .max_speed = 1000};
    d.torque = {
        .level = {200, 400}, .speed = {{0, 300, 1000}, {0, 600, 1000}}, .value = {{200, 200, 20}, {200, 200, 80}}};
    d.efficiency_map = {
        .level = {20, 200}, .speed = {{0, 500, 1000}, {0, 500, 1000}}, .value = {{0.6, 0.8, 0.7}, {0.7, 0.95, 0.85}}};
    return d;
}

TEST(MotorMap, IsBilinearOverSpeedAndVoltage) {
    const ElectricMotor<double> m(mapped_motor());
    EXPECT_NEAR(m.strongest(650, 200), 110, 1e-12);
    EXPECT_NEAR(m.strongest(650, 400), 185, 1e-12);
    EXPECT_NEAR(m.strongest(650, 300), (110 + 185) / 2.0, 1e-12);
    EXPECT_NEAR(m.strongest(-650, 300), m.strongest(650, 300), 0) << "either way it turns";
    EXPECT_NEAR(m.strongest(100, 500), 200, 1e-12) << "beyond the last voltage: the last";
    EXPECT_NEAR(m.strongest(1000, 100), 20, 1e-12) << "below the first: the first";
    EXPECT_NEAR(m.at(0.5, 650, 300), 0.5 * m.strongest(650, 300), 1e-12);
}

TEST(MotorMap, PowerIsThatOfTheShaftThroughTheEfficiency) {
    const ElectricMotor<double> m(mapped_motor());
    const double efficiency = 0.5 * (0.8 + 0.95);  // at 110 N m, between 20 and 200, and 500 rad/s
    EXPECT_NEAR(m.electric_power(110, 500), 110 * 500 / efficiency, 1e-9);
    EXPECT_NEAR(m.electric_power(-110, 500), -110 * 500 * efficiency, 1e-9);
    EXPECT_NEAR(m.electric_power(110, -500), -110 * 500 * efficiency, 1e-9) << "it brakes backward";
    EXPECT_EQ(m.electric_power(110, 0), 0);
}

Battery<double> battery() {
    Battery<double> b;
    b.present = 1, b.inverse_capacity = 1 / 3600.0, b.resistance = 0.1;
    b.open_voltage = Curve<double>({0, 1}, {300, 400});
    b.max_discharge = 50e3, b.max_charge = 20e3, b.auxiliary_power = 400;
    return b;
}

// What is asked of it for long: U = U_0 - R I and P = U I, that is U = U_0/2 + sqrt(U_0^2/4 - R P).
TEST(Battery, VoltageSettlesWhereResistanceAndPowerAgree) {
    const Battery<double> b = battery();
    for (const double power : {-15e3, 0.0, 10e3, 45e3}) {
        double values[2] = {0.5, 350};
        const BatteryState<const double> at{values[0], values[1]};
        for (int i = 0; i < 2000; ++i) values[1] += 1e-4 * b.evaluate(power, at).voltage_rate;
        const double all = power + 400, expected = 175 + std::sqrt(175 * 175 - 0.1 * all);
        EXPECT_NEAR(values[1], expected, 1e-9) << power;
        const BatteryMomenta<double> now = b.evaluate(power, at);
        EXPECT_NEAR(now.current, all / expected, 1e-9);
        EXPECT_NEAR(350 * now.current, now.power + now.heat, 1e-6) << "what leaves the cells is used or heats them";
        EXPECT_NEAR(now.charge_rate, -now.current / 3600, 1e-12);
    }
}

TEST(Battery, CutsWhatItsLimitsDoNotAllow) {
    const Battery<double> b = battery();
    EXPECT_EQ(b.shares(10e3, 0, 0.5).driving, 1);
    EXPECT_NEAR(b.shares(100e3, 0, 0.5).driving, (50e3 - 400) / 100e3, 1e-12);
    EXPECT_NEAR(b.shares(100e3, 30e3, 0.5).driving, (50e3 - 400 + 30e3) / 100e3, 1e-12)
        << "what one motor gives back another may use";
    EXPECT_NEAR(b.shares(0, 80e3, 0.5).braking, (20e3 + 400) / 80e3, 1e-12);
    EXPECT_EQ(b.shares(10e3, 0, 0).driving, 0) << "empty";
    EXPECT_NEAR(b.shares(0, 80e3, 1).braking, 400 / 80e3, 1e-12) << "full: what is on board uses the rest";
}

// A motor of 100 N m at a wheel, through a ratio of 5, told by pedals and controllers.
struct Told {
    double pedal = 0, brake = 0, added = 0, let = 1, gear = 1;  // brake: that the pedal asks for, at the wheel [N m]
};
PowerUnit<double>::Demand demand(const Told& told, double spin) {
    VehicleDescription d;
    d.suspensions.resize(1);
    d.suspensions[0].wheels.resize(1);
    d.suspensions[0].wheels[0].wheel = {.center = {}, .spin_axis = {0, 1, 0}, .spin_inertia = 1};
    PowerUnitDescription one{
        .name = "motor",
        .source =
            MotorDescription{
                .max_torque = 100, .max_power = 1e6, .max_speed = 1000, .brake_regeneration = 0.8, .efficiency = 0.9},
        .inertia = 0.02};
    one.stiffness = 1000, one.gearbox = {.ratios = {5}}, one.output = {.wheel = true, .number = 0};
    d.power_units = {one};
    PowerUnit<double> unit = make_powertrain<double>(d).units[0];
    unit.place = 0, unit.command = 0;
    const std::vector<double> commands{1, 0, told.added, told.let};
    std::vector<double> values{0.02 * spin, 0, 0, 0};
    return unit.demand({told.pedal, 0, told.gear, commands.data()},
                       unit.state(static_cast<const double*>(values.data())), spin / 5, Vec3<double>::Zero(), 0,
                       told.brake);
}

TEST(MotorDemand, AddsWhatControllersWantWithinWhatItHas) {
    EXPECT_NEAR(demand({.pedal = 0.5}, 300).torque, 50, 1e-12);
    EXPECT_NEAR(demand({.pedal = 0.5, .added = 0.3}, 300).torque, 80, 1e-12);
    EXPECT_NEAR(demand({.pedal = 0.5, .added = 0.9}, 300).torque, 100, 1e-12);
    EXPECT_EQ(demand({.pedal = 0.5, .added = 0.9}, 300).regenerated, 0) << "a torque that it lacks is no braking";
    EXPECT_NEAR(demand({.pedal = 0.5, .added = -1}, 300).torque, -50, 1e-12);
    EXPECT_NEAR(demand({.added = 0.3}, 300).power, 30 * 300 / 0.9, 1e-9);
}

TEST(MotorDemand, BrakesInPlaceOfFrictionAsFarAsItGoes) {
    const auto some = demand({.brake = 200}, 300);
    EXPECT_NEAR(some.torque, -40, 1e-12) << "200 N m through a ratio of 5";
    EXPECT_NEAR(some.regenerated, 40, 1e-12);
    EXPECT_NEAR(some.power, -40 * 300 * 0.9, 1e-9);
    EXPECT_NEAR(demand({.brake = 1000}, 300).torque, -80, 1e-12) << "its share";
    EXPECT_NEAR(demand({.brake = 1000, .let = 0.5}, 300).torque, -40, 1e-12) << "that controllers let";
    EXPECT_NEAR(demand({.brake = 1000, .added = -0.5}, 300).torque, -100, 1e-12) << "all that it has";
    EXPECT_NEAR(demand({.brake = 1000, .added = -0.5}, 300).regenerated, 50, 1e-12);
    EXPECT_NEAR(demand({.brake = 200}, 10).torque, -20, 1e-12) << "it fades below 2 percent of the top speed";
    EXPECT_NEAR(demand({.brake = 200}, -300).torque, 40, 1e-12) << "backward too";
    EXPECT_EQ(demand({.brake = 200, .gear = 0}, 300).regenerated, 0) << "neutral";
}

Shafts<double> shafts(double half_play) {
    return {.present = 1,
            .inertia = 0.01,
            .inverse_inertia = 100,
            .stiffness = {500, 0, 1000},
            .damping = {1, 0, 2},
            .half_play = {half_play, 0, half_play}};
}

TEST(Shafts, WithoutPlayAreASpringAndADamper) {
    const auto out = shafts(0).evaluate(1, 1, 3, -0.02);
    EXPECT_NEAR(out.torque, -0.02 * 1000 + 3 * 2, 1e-12);
    EXPECT_EQ(out.windup_rate, 3);
}

TEST(Shafts, PassNothingWithinTheirPlayAndNeverPull) {
    const Shafts<double> s = shafts(0.01);
    EXPECT_EQ(s.evaluate(1, 1, 5, 0.009).torque, 0);
    EXPECT_NEAR(s.evaluate(1, 1, 0, 0.015).torque, 5, 1e-12);
    EXPECT_NEAR(s.evaluate(1, 1, 2, 0.015).torque, 9, 1e-12);
    EXPECT_EQ(s.evaluate(1, 1, -5, 0.015).torque, 0) << "damping alone would pull";
    EXPECT_NEAR(s.evaluate(1, 1, -2, -0.015).torque, -9, 1e-12);
    EXPECT_EQ(s.evaluate(0, 0, 5, 0.015).torque, 0) << "neutral";
    EXPECT_LT(s.evaluate(0, 0, 5, 0.015).windup_rate, 0) << "there they unwind";
}

}  // namespace
}  // namespace hamilcar
