// Adjustable dampers and active anti-roll bars: what a file says becomes what a description holds, and every mistake is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "support/fleet.hpp"

namespace hamilcar::io {
namespace {

constexpr const char* adjustable = R"([axle.damper.adjustable]
soft = 0.45
firm = 2.5
response_time_s = 0.015
)";
constexpr const char* actuator = R"([axle.anti_roll_bar.actuator]
max_force_N = 3500
response_time_s = 0.04
)";
constexpr const char* controllers = R"(
[[controller]]
kind = "skyhook"
rate_hz = 500
sky_damping = 2

[[controller]]
kind = "active_anti_roll"
front_share = 0.55
)";

// The shipped car with these of its front axle.
std::string car_with(const std::string& damper, const std::string& bar, const std::string& more = "") {
    std::string text = shipped_car_text();
    text = changed(text, "[axle.bump_stop]", damper + "\n[axle.bump_stop]");
    return changed(text, "[axle.brake]", bar + "\n[axle.brake]") + more;
}
VehicleDescription read_text(const std::string& text) {
    const TemporaryFolder folder;
    return read_vehicle(folder.write("car.toml", text));
}
const DamperDescription& damper(const VehicleDescription& car, std::size_t suspension, std::size_t number = 0) {
    return car.suspensions[suspension].dampers[number].damper;
}
void expect_adjustment(const DamperDescription& of, double soft, double firm, double response_time) {
    EXPECT_TRUE(of.is_adjustable());
    EXPECT_EQ(of.soft, soft);
    EXPECT_EQ(of.firm, firm);
    EXPECT_EQ(of.response_time, response_time);
}

TEST(ActuatorsFile, ACarWithoutThemHasNone) {
    const VehicleDescription car = read_text(car_with("", ""));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_FALSE(damper(car, i).is_adjustable());
        EXPECT_EQ(damper(car, i).soft, 1);
        EXPECT_EQ(damper(car, i).firm, 1);
    }
    for (const AntiRollBarDescription& bar : car.anti_roll_bars) EXPECT_EQ(bar.max_force, 0);
}

TEST(ActuatorsFile, AreAsWrittenOnTheAxleThatHasThem) {
    const VehicleDescription plain = read_text(car_with("", ""));
    const VehicleDescription car = read_text(car_with(adjustable, actuator));
    for (const std::size_t side : {0u, 1u}) {
        expect_adjustment(damper(car, side), 0.45, 2.5, 0.015);
        EXPECT_EQ(damper(car, side).force, damper(plain, side).force);
        EXPECT_FALSE(damper(car, side + 2).is_adjustable());
    }
    ASSERT_EQ(car.anti_roll_bars.size(), 2u);
    EXPECT_EQ(car.anti_roll_bars[0].max_force, 3500);
    EXPECT_EQ(car.anti_roll_bars[0].response_time, 0.04);
    EXPECT_EQ(car.anti_roll_bars[0].rate, plain.anti_roll_bars[0].rate);
    EXPECT_EQ(car.anti_roll_bars[1].max_force, 0);
}

TEST(ActuatorsFile, LagsMayBeLeftOut) {
    const VehicleDescription car = read_text(
        car_with(changed(adjustable, "response_time_s = 0.015", ""), changed(actuator, "response_time_s = 0.04", "")));
    expect_adjustment(damper(car, 0), 0.45, 2.5, 0.01);
    EXPECT_EQ(car.anti_roll_bars[0].response_time, 0.03);
}

TEST(ActuatorsFile, ARightSideMayHaveItsOwnDamper) {
    const VehicleDescription car = test::shipped_with(
        "bmw_323i", "front",
        "damper.adjustable = {soft = 0.5, firm = 2}\nright.damper.adjustable = {soft = 0.6, firm = 3}\n"
        "anti_roll_bar.actuator.max_force_N = 2000");
    expect_adjustment(damper(car, 0), 0.5, 2, 0.01);
    expect_adjustment(damper(car, 1), 0.6, 3, 0.01);
    EXPECT_EQ(car.anti_roll_bars[0].max_force, 2000);
}

TEST(ActuatorsFile, AxlesThatHoldBothWheelsHaveThemToo) {
    const VehicleDescription car = test::shipped_with(
        "offroader", "rear", "damper.adjustable = {soft = 0.5, firm = 2}\nanti_roll_bar.actuator.max_force_N = 2000");
    ASSERT_EQ(car.suspensions[1].dampers.size(), 2u);
    expect_adjustment(damper(car, 1, 0), 0.5, 2, 0.01);
    expect_adjustment(damper(car, 1, 1), 0.5, 2, 0.01);
    EXPECT_FALSE(damper(car, 0, 0).is_adjustable());
    EXPECT_EQ(car.anti_roll_bars[1].max_force, 2000);
}

TEST(ActuatorsFile, TheirControllersAreReadWithTheirKeys) {
    const VehicleDescription car = read_text(car_with(adjustable, actuator, controllers));
    ASSERT_EQ(car.controllers.size(), 2u);
    EXPECT_EQ(car.controllers[0].kind, "skyhook");
    EXPECT_EQ(car.controllers[0].rate, 500);
    EXPECT_THAT(car.controllers[0].settings, testing::ElementsAre(testing::Pair("sky_damping", 2)));
    EXPECT_EQ(car.controllers[1].kind, "active_anti_roll");
    EXPECT_THAT(car.controllers[1].settings, testing::ElementsAre(testing::Pair("front_share", 0.55)));
}

TEST(ActuatorsFile, ControllersWantThem) {
    expect_error([] { read_text(car_with("", actuator, controllers)); }, ExitCode::bad_file,
                 {"'controller[0].kind' = \"skyhook\": expected an [axle.damper.adjustable]"});
    expect_error([] { read_text(car_with(adjustable, "", controllers)); }, ExitCode::bad_file,
                 {"'controller[1].kind' = \"active_anti_roll\": expected an [axle.anti_roll_bar.actuator]"});
}

// Of a bar with arms of its own no energy account would be kept.
TEST(ActuatorsFile, ABarWithArmsHasNoActuator) {
    constexpr const char* arms =
        "anti_roll_bar = {rate_N_m_per_rad = 600, pivot_m = [-2.6, 0.4, 0.35], arm_end_m = [-2.75, 0.5, 0.35], "
        "link_m = [-2.75, 0.5, 0.25]%}";
    const auto read = [&](const std::string& more) {
        return test::shipped_with("bmw_e90_330i", "rear", changed(arms, "%", more));
    };
    const VehicleDescription car = read("");
    EXPECT_TRUE(car.suspensions[2].wheels[0].bar_arm);
    expect_error([&] { read(", actuator = {max_force_N = 1000}"); }, ExitCode::bad_file,
                 {"'axle[rear].anti_roll_bar.actuator'", "is unknown"});
}

TEST(ActuatorsFile, ABarHasOneActuatorForBothSides) {
    expect_error(
        [] {
            test::shipped_with(
                "bmw_323i", "front",
                "anti_roll_bar.actuator.max_force_N = 3000\nright.anti_roll_bar.actuator.max_force_N = 9");
        },
        ExitCode::bad_file, {"'axle[front].right.anti_roll_bar.actuator'", "is unknown"});
}

class BadActuator : public testing::TestWithParam<BadInput> {};

TEST_P(BadActuator, IsToldWithPlaceKeyValueAndExpectation) {
    expect_refused(car_with(adjustable, actuator, controllers), GetParam(),
                   [](const std::string& path) { read_vehicle(path); });
}

const std::vector<BadInput> bad_actuators{
    {"NoSoft", "soft = 0.45", "", "[axle.damper.adjustable]", {"'axle[front].damper.adjustable.soft' is missing"}},
    {"NoFirm", "firm = 2.5", "", "[axle.damper.adjustable]", {"'axle[front].damper.adjustable.firm' is missing"}},
    {"SoftBelowZero",
     "soft = 0.45",
     "soft = -0.45",
     "-0.45",
     {"'axle[front].damper.adjustable.soft' = -0.45: expected"}},
    {"FirmSofterThanSoft",
     "firm = 2.5",
     "firm = 0.45",
     "0.45\nresponse",
     {"'axle[front].damper.adjustable.firm' = 0.45: expected"}},
    {"DamperAtOnce",
     "response_time_s = 0.015",
     "response_time_s = 0.001",
     "0.001",
     {"'axle[front].damper.adjustable.response_time_s' = 0.001: expected a number not below 0.002 [s]"}},
    {"UnknownKey",
     "firm = 2.5",
     "firm = 2.5\nhard = 3",
     "hard = 3",
     {"'axle[front].damper.adjustable.hard' = 3 is unknown: expected 'soft', 'firm' or 'response_time_s'"}},
    {"NoForce",
     "max_force_N = 3500",
     "",
     "[axle.anti_roll_bar.actuator]",
     {"'axle[front].anti_roll_bar.actuator.max_force_N' is missing: expected a positive number [N]"}},
    {"ForceOfZero",
     "max_force_N = 3500",
     "max_force_N = 0",
     "0\nresponse_time_s = 0.04",
     {"'axle[front].anti_roll_bar.actuator.max_force_N' = 0: expected a positive number [N]"}},
    {"BarAtOnce",
     "response_time_s = 0.04",
     "response_time_s = 0.004",
     "0.004\n\n[axle.brake]",
     {"'axle[front].anti_roll_bar.actuator.response_time_s' = 0.004: expected a number not below 0.005 [s]"}},
    {"Misspelled",
     "max_force_N = 3500",
     "max_forces_N = 3500",
     "max_forces_N",
     {"is unknown: did you mean 'max_force_N'"}},
    {"SkyBelowZero",
     "sky_damping = 2",
     "sky_damping = -2",
     "-2\n\n[[controller]]",
     {"'controller[0].sky_damping' = -2: expected"}},
    {"ShareAboveOne",
     "front_share = 0.55",
     "front_share = 1.55",
     "1.55",
     {"'controller[1].front_share' = 1.55: expected a number from 0 to 1"}},
    {"KeyOfTheOther",
     "front_share = 0.55",
     "sky_damping = 1",
     "sky_damping = 1",
     {"'controller[1].sky_damping' = 1 is unknown"}},
};

INSTANTIATE_TEST_SUITE_P(Files, BadActuator, testing::ValuesIn(bad_actuators),
                         [](const auto& run) { return run.param.name; });

}  // namespace
}  // namespace hamilcar::io
