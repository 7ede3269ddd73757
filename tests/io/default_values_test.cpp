// What a vehicle file may leave out, against what the shipped vehicles say, and shipped tires by their names.
#include "hamilcar/io/default_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "files.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "support/fleet.hpp"

namespace hamilcar::io {
namespace {

using testing::HasSubstr;

// A vehicle's file without the lines of some keys, under its own name, so that what it names is found.
std::string without(const std::string& vehicle, const std::string& keys) {
    const std::string text = read_file(test::source_path("vehicles/" + vehicle + ".toml"));
    return std::regex_replace(text, std::regex("(^|\n)(brake\\.)?(" + keys + ") = [^\n]*"), "$1");
}

VehicleDescription read_in(const TemporaryFolder& folder, const std::string& text) {
    std::string absolute = text;
    const std::string tires = test::source_path("vehicles/tires/"), base = test::source_path("vehicles/");
    absolute = std::regex_replace(absolute, std::regex("\"tires/"), "\"" + tires);
    absolute = std::regex_replace(absolute, std::regex("base = \""), "base = \"" + base);
    return read_vehicle(folder.write("vehicle.toml", absolute));
}

void expect_factor(double value, double shipped, double factor, const std::string& what) {
    EXPECT_LT(value, shipped * factor) << what;
    EXPECT_GT(value, shipped / factor) << what;
}

class DefaultValues : public testing::TestWithParam<std::string> {
protected:
    TemporaryFolder folder_;
    VehicleDescription shipped_ = test::shipped(GetParam());
};

TEST_P(DefaultValues, OfTheBrakesAreWithinAFactorOfTwo) {
    const VehicleDescription car =
        read_in(folder_, without(GetParam(), "windup_stiffness_N_m_per_rad|windup_damping_N_m_s_per_rad"));
    for (std::size_t i = 0; i < car.suspensions.size(); ++i) {
        for (std::size_t j = 0; j < car.suspensions[i].wheels.size(); ++j) {
            const auto& brake = car.suspensions[i].wheels[j].brake;
            const auto& other = shipped_.suspensions[i].wheels[j].brake;
            expect_factor(brake.windup_stiffness, other.windup_stiffness, 2, "stiffness");
            expect_factor(brake.windup_damping, other.windup_damping, 2, "damping");
        }
    }
}

TEST_P(DefaultValues, OfTheDrivelineAreWithinAFactorOfThree) {
    const VehicleDescription car =
        read_in(folder_, without(GetParam(), "shaft_stiffness_N_m_per_rad|stiffness_N_m_per_rad|overrun_N_m"));
    ASSERT_EQ(car.differentials.size(), shipped_.differentials.size());
    for (std::size_t i = 0; i < car.differentials.size(); ++i) {
        expect_factor(car.differentials[i].shaft_stiffness, shipped_.differentials[i].shaft_stiffness, 3, "shaft");
    }
    for (std::size_t i = 0; i < car.power_units.size(); ++i) {
        expect_factor(car.power_units[i].stiffness, shipped_.power_units[i].stiffness, 2, "power unit");
        const auto* engine = std::get_if<EngineDescription>(&car.power_units[i].source);
        if (!engine) continue;
        const auto& other = std::get<EngineDescription>(shipped_.power_units[i].source);
        ASSERT_EQ(engine->torque[0].speed, other.torque[0].speed);
        for (std::size_t k = 0; k < engine->torque[0].torque.size(); ++k) {
            expect_factor(-engine->torque[0].torque[k], -other.torque[0].torque[k], 1.6, "overrun");
        }
    }
}

// The rotor's inertia is the one key of that name behind the first power unit.
TEST_P(DefaultValues, OfTheRotorsAreWithinAFactorOfTwoAndAHalf) {
    const std::string text = read_file(test::source_path("vehicles/" + GetParam() + ".toml"));
    const std::size_t units = std::min(text.find("[[power_unit]]"), text.size());
    const VehicleDescription car = read_in(
        folder_, text.substr(0, units) +
                     std::regex_replace(text.substr(units), std::regex("\ninertia_kg_m2 = [0-9.]+[^\n]*"), "\n"));
    for (std::size_t i = 0; i < car.power_units.size(); ++i) {
        expect_factor(car.power_units[i].inertia, shipped_.power_units[i].inertia, 2.5, "rotor");
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, DefaultValues, testing::ValuesIn(test::fleet()),
                         [](const auto& run) { return run.param; });

TEST(DefaultAir, IsThatOfTheShippedVehicles) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_in(folder, without("hatchback", "air_density_kg_per_m3")).aerodynamics.air_density,
              test::shipped("hatchback").aerodynamics.air_density);
}

// A straight line in the file's own speeds: 5 percent of the largest torque at rest, 2.5 more for 1000 rpm.
TEST(DefaultOverrun, GrowsWithTheSpeed) {
    using units::rpm;
    EXPECT_THAT(default_overrun({0, 1000 * rpm, 6000 * rpm}, 200),
                testing::ElementsAre(testing::DoubleEq(-10), testing::DoubleEq(-15), testing::DoubleEq(-40)));
}

TEST(ShippedTire, IsFoundByItsName) {
    const TemporaryFolder folder;
    const auto car_on = [&](const std::string& file) {
        return read_vehicle(folder.write("car.toml", changed(read_file(test::source_path("vehicles/bmw_323i.toml")),
                                                             "tires/pacejka_205_60_r15.tir", file)));
    };
    const VehicleDescription other = test::shipped("bmw_323i");
    const auto& expected = std::get<MagicFormulaDescription>(other.suspensions[0].wheels[0].tire);
    for (const char* name : {"pacejka_205_60_r15", "pacejka_205_60_r15.tir"}) {
        const VehicleDescription car = car_on(name);
        EXPECT_EQ(std::get<MagicFormulaDescription>(car.suspensions[0].wheels[0].tire).coefficients,
                  expected.coefficients);
    }
    try {
        car_on("pacejka_205");
        ADD_FAILURE() << "no such tire";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("file' = \"pacejka_205\": expected a file that is there ("));
        EXPECT_THAT(error.what(), HasSubstr("or a shipped tire: 'pacejka_205_60_r15'"));
    }
}

}  // namespace
}  // namespace hamilcar::io
