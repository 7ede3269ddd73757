// Every shipped vehicle is plausible; one mistake in a file, as people make them, is told with its cause.
#include "hamilcar/analysis/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "io/files.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

std::string told(const VehicleDescription& car) {
    std::vector<Oddity> all = odd_geometry(car);
    const Linearizer linearizer(car);
    const OperatingPoint rest = linearizer.operating_point({});
    if (rest.found) {
        const std::vector<AxleReport> axles = kinematics(car, {.steps = 8});
        const std::vector<Oddity> more = odd_figures(car, vehicle_figures(linearizer, rest, axles), axles);
        all.insert(all.end(), more.begin(), more.end());
    }
    std::string out;
    for (const Oddity& one : all) out += one.where + ": " + one.what + ": " + one.cause + "\n";
    return out;
}

TEST(Plausibility, ShippedVehiclesAreNotOdd) {
    for (const auto& entry : std::filesystem::directory_iterator(test::source_path("vehicles"))) {
        if (entry.path().extension() != ".toml") continue;
        EXPECT_EQ(told(io::read_vehicle(entry.path())), "") << entry.path();
    }
}

struct Slip {
    std::string name, pattern, text, expected;
};

class Slips : public testing::TestWithParam<Slip> {};

void PrintTo(const Slip& slip, std::ostream* out) {
    *out << slip.name;
}

TEST_P(Slips, AreToldWithTheirCause) {
    const io::TemporaryFolder folder;
    const std::string pickup = io::read_file(test::source_path("vehicles/pickup.toml"));
    const std::string slipped = std::regex_replace(pickup, std::regex(GetParam().pattern), GetParam().text,
                                                   std::regex_constants::format_first_only);
    ASSERT_NE(slipped, pickup);
    EXPECT_THAT(told(io::read_vehicle(folder.write("car.toml", slipped))), HasSubstr(GetParam().expected));
}

INSTANTIATE_TEST_SUITE_P(
    Pickup, Slips,
    testing::Values(Slip{"PointInMillimeters", R"(lower_ball_m = \[0\.0074, 0\.8000, 0\.2550\])",
                         "lower_ball_m = [7.4, 800.0, 255.0]", "from the wheel: millimeters where meters are wanted?"},
                    Slip{"BallJointsExchanged", R"((lower_ball_m = )(\[.*?\])([^]*?)(upper_ball_m = )(\[.*?\]))",
                         "$1$5$3$4$2", "the height of the roll center is"},
                    Slip{"TieRodExchanged", R"((tie_rod_body_m = )(\[.*?\])([^]*?)(tie_rod_outer_m = )(\[.*?\]))",
                         "$1$5$3$4$2", "the tie rod's end on the body is 420 mm farther out than that on the wheel"},
                    Slip{"WrongSide", R"(upper_ball_m = \[-0\.0129, )", "upper_ball_m = [-0.0129, -",
                         "inner and outer point exchanged?"},
                    Slip{"RackTheOtherWay", R"(rack_axis = \[0\.0, 1\.0)", "rack_axis = [0.0, -1.0",
                         "a steering wheel turned to the left turns the wheels to the right"},
                    Slip{"SpringInNewtonsPerMillimeter", "rate_N_per_m = 95e3", "rate_N_per_m = 95.0",
                         "the wheel rate of its springs is"},
                    Slip{"NoPreload", R"(force_at_design_N = 10257\.5)", "force_at_design_N = 0.0",
                         "mm below where it was designed, on its stops: force_at_design_N"},
                    Slip{"RackInMillimeters", R"(rack_m_per_revolution = [0-9.]+)", "rack_m_per_revolution = 45.0",
                         "steering: the ratio is 0.0"},
                    Slip{"CenterOfMassBehind", R"(center_of_mass_m = \[-[0-9.]+)", "center_of_mass_m = [-3.5",
                         "above where it was designed, on its stops"}),
    [](const auto& vehicle) { return vehicle.param.name; });

TEST(Plausibility, WeakBrakesAreTold) {
    VehicleDescription car = test::shipped_car();
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionWheelDescription& wheel : suspension.wheels) wheel.brake.max_torque *= 1e-3;
    }
    EXPECT_THAT(told(car), HasSubstr("brakes: the deceleration that all of them are able to is 0.015"));
}

}  // namespace
}  // namespace hamilcar
