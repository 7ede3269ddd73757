// Controllers and sensors: what a file says becomes what a description holds, kinds that a program adds included, and every mistake is
// told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "files.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/control/kinds.hpp"
#include "hamilcar/io/key_schema.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

constexpr double degree = M_PI / 180;

constexpr const char* controlled = R"(
[brakes]
pedal_force_N = 300
pedal_ratio = 3.5
booster_gain = 5
master_cylinder_diameter_mm = 23.8

[brakes.modulator]
pump_flow_cm3_per_s = 8
pump_pressure_bar = 180

[[controller]]
kind = "abs"
rate_hz = 200

[[controller]]
kind = "esc"
)";

constexpr const char* sensors = R"(
[sensors]
seed = 7

[sensors.wheel_speed]
rate_hz = 100
delay_s = 0.005
resolution_rpm = 3
noise_rpm = 6

[sensors.angular_rate]
resolution_deg_per_s = 0.1
noise_deg_per_s = 0.2

[sensors.acceleration]
resolution_m_per_s2 = 0.05
noise_m_per_s2 = 0.03

[sensors.pressure]
resolution_bar = 0.5
noise_bar = 0.25

[sensors.steering_wheel]
delay_s = 0.1
resolution_deg = 1.5
noise_deg = 0.4
)";

std::string car_with(const std::string& more) {
    return shipped_car_text() + more;
}

VehicleDescription read_text(const std::string& text) {
    const TemporaryFolder folder;
    return read_vehicle(folder.write("car.toml", text));
}

std::vector<std::string> kinds_of(const VehicleDescription& car) {
    std::vector<std::string> kinds;
    for (const ControllerDescription& controller : car.controllers) kinds.push_back(controller.kind);
    return kinds;
}

TEST(ControlFile, ACarWithoutControllersHasNone) {
    const VehicleDescription car = read_text(car_with(""));
    EXPECT_TRUE(car.controllers.empty());
    EXPECT_EQ(car.sensors.seed, 1u);
    EXPECT_EQ(car.sensors.pressure.noise, 0);
}

TEST(ControlFile, ControllersStandInTheOrderInWhichTheyDecide) {
    const VehicleDescription car = read_text(car_with(controlled));
    EXPECT_THAT(kinds_of(car), ElementsAre("abs", "esc"));
    EXPECT_EQ(car.controllers[0].rate, 200);
    EXPECT_EQ(car.controllers[1].rate, 100);
    EXPECT_THAT(car.controllers[0].settings, ElementsAre());
}

// Every key of every kind, at its least.
TEST(ControlFile, EveryKindIsReadWithItsKeys) {
    for (const ControllerKind* kind : controller_kinds()) {
        if (!kind->lacks(read_text(car_with(controlled))).empty())
            continue;  // kinds of dampers and bars: actuators_file_test
        const std::string body = controlled;
        std::string text = body.substr(0, body.find("[[controller]]")) + "[[controller]]\nkind = \"" +
                           std::string(kind->keyword) + "\"\n";
        for (const ControllerKey& key : kind->keys) text += std::string(key.key) + " = " + number_text(key.min) + "\n";
        const VehicleDescription car = read_text(car_with(text));
        ASSERT_EQ(car.controllers.size(), 1u) << kind->keyword;
        EXPECT_EQ(car.controllers[0].settings.size(), kind->keys.size()) << kind->keyword;
    }
}

ControllerKind pretender() {
    return {.keyword = "pretender",
            .meaning = "does nothing",
            .keys = {{"pretense_deg_per_s", "of the yaw rate", 4, 1, 20},
                     {"gain_bar_per_deg", "pressure per angle", 2, 0, 10},
                     {"share", "of something", 0.5, 0, 1},
                     {"limit_bar", "of a pressure", 50, 0, INFINITY}},
            .lacks = [](const VehicleDescription& car) -> std::string {
                return car.brakes.exists ? "" : "a [brakes] in this file";
            },
            .make = nullptr};
}

// The list of kinds is the program's: a kind is added in a process of its own.
void with_pretender(const std::function<void()>& check) {
    EXPECT_EXIT(
        {
            add_controller_kind(pretender());
            check();
            std::exit(testing::Test::HasFailure() ? 1 : 0);
        },
        testing::ExitedWithCode(0), "");
}

std::string car_with_pretender(const std::string& keys) {
    return car_with(changed(controlled, "kind = \"esc\"\n", "kind = \"pretender\"\n" + keys));
}

TEST(ControlFile, AKindThatAProgramAddsIsReadInSi) {
    with_pretender([] {
        const VehicleDescription car =
            read_text(car_with_pretender("limit_bar = 80\npretense_deg_per_s = 6\ngain_bar_per_deg = 3\n"));
        const auto& settings = car.controllers[1].settings;
        ASSERT_EQ(settings.size(), 3u) << "those that the file states";
        EXPECT_THAT(settings[0], Pair("pretense_deg_per_s", testing::DoubleEq(6 * degree)));
        EXPECT_THAT(settings[1], Pair("gain_bar_per_deg", testing::DoubleEq(3e5 / degree)));
        EXPECT_THAT(settings[2], Pair("limit_bar", testing::DoubleEq(80e5)));
    });
}

TEST(ControlFile, AKindThatAProgramAddsIsChecked) {
    with_pretender([] {
        const auto refused = [](const std::string& keys, const std::vector<std::string>& pieces) {
            expect_error([&] { read_text(car_with_pretender(keys)); }, ExitCode::bad_file, pieces);
        };
        refused("share = 2\n", {"'controller[1].share' = 2: expected a number from 0 to 1"});
        refused("pretense_deg_per_s = 30\n", {"= 30: expected a number from 1 to 20 [deg/s]"});
        refused("limit_bar = -1\n", {"= -1: expected a number not below 0 [bar]"});
        refused("pretence_deg_per_s = 4\n", {"'controller[1].pretence_deg_per_s'", "mean 'pretense_deg_per_s'?"});
        expect_error([] { read_text(car_with("\n[[controller]]\nkind = \"pretender\"\n")); }, ExitCode::bad_file,
                     {"'controller[0].kind' = \"pretender\": expected a [brakes] in this file"});
    });
}

TEST(ControlFile, TheSchemaTellsWhatAKeyOfAKindMeans) {
    with_pretender([] {
        const TableRecord file = record_keys([](const TableReader& table) { read_vehicle(table); });
        const Json keys = table_schema(file)["properties"]["controller"]["items"]["properties"];
        const Json& threshold = keys["pretense_deg_per_s"];
        EXPECT_DOUBLE_EQ(threshold["default"].get<double>(), 4);
        EXPECT_EQ(threshold["maximum"], 20);
        EXPECT_EQ(threshold["description"], "pretender: of the yaw rate; a number from 1 to 20 [deg/s]");
        EXPECT_THAT(keys["kind"]["enum"].dump(), HasSubstr("\"pretender\""));
        EXPECT_THAT(requirements(file).dump(), HasSubstr(R"({"const":"pretender"})"));
    });
}

TEST(ControlFile, AnotherFileMayDoWithoutControllers) {
    const TemporaryFolder folder;
    folder.write("base.toml", car_with(controlled));
    const VehicleDescription car =
        read_vehicle(folder.write("car.toml", "base = \"base.toml\"\ncontrollers = false\n"));
    EXPECT_TRUE(car.controllers.empty());
    EXPECT_TRUE(car.brakes.modulated);
}

TEST(ControlFile, AnotherFilesControllersReplaceThoseOfTheBase) {
    const TemporaryFolder folder;
    folder.write("base.toml", car_with(controlled));
    const VehicleDescription car =
        read_vehicle(folder.write("car.toml", "base = \"base.toml\"\n[[controller]]\nkind = \"abs\"\n"));
    EXPECT_THAT(kinds_of(car), ElementsAre("abs"));
    EXPECT_EQ(car.controllers[0].rate, 100);
}

TEST(ControlFile, SensorsAreReadInSi) {
    const SensorsDescription read = read_text(car_with(sensors)).sensors;
    EXPECT_EQ(read.seed, 7u);
    EXPECT_DOUBLE_EQ(read.wheel_speed.interval, 0.01);
    EXPECT_EQ(read.wheel_speed.delay, 0.005);
    EXPECT_DOUBLE_EQ(read.wheel_speed.resolution, 2 * M_PI / 20);
    EXPECT_DOUBLE_EQ(read.wheel_speed.noise, 2 * M_PI / 10);
    EXPECT_EQ(read.angular_rate.interval, 0);
    EXPECT_DOUBLE_EQ(read.angular_rate.resolution, 0.1 * degree);
    EXPECT_DOUBLE_EQ(read.angular_rate.noise, 0.2 * degree);
    EXPECT_EQ(read.acceleration.resolution, 0.05);
    EXPECT_EQ(read.acceleration.noise, 0.03);
    EXPECT_DOUBLE_EQ(read.pressure.resolution, 0.5e5);
    EXPECT_DOUBLE_EQ(read.pressure.noise, 0.25e5);
    EXPECT_EQ(read.steering_wheel.delay, 0.1);
    EXPECT_DOUBLE_EQ(read.steering_wheel.resolution, 1.5 * degree);
    EXPECT_DOUBLE_EQ(read.steering_wheel.noise, 0.4 * degree);
}

ScenarioDescription read_scenario_with(const std::string& more) {
    const TemporaryFolder folder;
    return read_scenario(folder.write("run.toml", "name = \"run\"\nvehicle = \"car.toml\"\nduration_s = 1\n" + more));
}

TEST(ControlFile, AScenarioMayDoWithoutSomeControllers) {
    EXPECT_TRUE(read_scenario_with("").controllers_off.empty());
    EXPECT_THAT(read_scenario_with("controllers_off = [\"esc\", \"abs\"]").controllers_off, ElementsAre("esc", "abs"));
    EXPECT_THAT(read_scenario_with("controllers_off = [\"all\"]").controllers_off, ElementsAre("all"));
    const auto refused = [](const std::string& value, const std::vector<std::string>& pieces) {
        expect_error([&] { read_scenario_with("controllers_off = " + value); }, ExitCode::bad_file, pieces);
    };
    refused("[\"abs\", \"esp\"]", {"run.toml:4:19: key 'controllers_off' = [\"abs\", \"esp\"]: expected a list of ",
                                   " or 'all', which 'esp' is not; did you mean 'esc'?"});
    refused("\"esc\"", {"'controllers_off' = \"esc\": expected a list of texts in quotes"});
}

class BadControl : public testing::TestWithParam<BadInput> {};

TEST_P(BadControl, IsToldWithPlaceKeyValueAndExpectation) {
    expect_refused(car_with(std::string(controlled) + sensors), GetParam(),
                   [](const std::string& path) { read_vehicle(path); });
}

const std::vector<BadInput> bad_controls{
    {"UnknownKind", "\"esc\"", "\"esp\"", "\"esp\"", {"'controller[1].kind' = \"esp\"", "one of ", "mean 'esc'?"}},
    {"NoKind",
     "kind = \"esc\"",
     "",
     "[[controller]]\n\n",
     {"'controller[1].kind' is missing: expected one of ", "'abs'"}},
    {"KindTwice",
     "\"esc\"",
     "\"abs\"",
     "\"abs\"\n\n[sensors]",
     {"'controller[1].kind' = \"abs\": expected a kind that no other controller has"}},
    {"KeyOfNoKind",
     "rate_hz = 200",
     "wish = 200",
     "wish",
     {"'controller[0].wish' = 200 is unknown: expected 'kind', "}},
    {"NoValves",
     "[brakes.modulator]\npump_flow_cm3_per_s = 8\npump_pressure_bar = 180",
     "",
     "\"abs\"",
     {"'controller[0].kind' = \"abs\": expected a"}},
    {"TooSlow", "rate_hz = 200", "rate_hz = 0.5", "0.5\n\n[[con", {"= 0.5: expected a number from 1 to 10000 [Hz]"}},
    {"NoSwitch",
     "[chassis]",
     "controllers = 0\n\n[chassis]",
     "0\n\n[chassis]",
     {"'controllers' = 0: expected true or false"}},
    {"FractionOfASeed",
     "seed = 7",
     "seed = 7.75",
     "7.75",
     {"'sensors.seed' = 7.75: expected a whole number from 0 to 1e15"}},
    {"LateSensor", "delay_s = 0.005", "delay_s = 0.5", "0.5\nresolution_rpm", {"a number from 0 to 0.1 [s]"}},
    {"SlowSensor", "rate_hz = 100", "rate_hz = 0", "0\ndelay", {"'sensors.wheel_speed.rate_hz' = 0", "[Hz]"}},
    {"NoiseBelowZero",
     "noise_bar = 0.25",
     "noise_bar = -1",
     "-1\n\n[sensors",
     {"= -1: expected a number not below zero [bar]"}},
    {"NoiseInAnotherUnit",
     "noise_bar = 0.25",
     "noise_Pa = 25000",
     "noise_Pa",
     {"'sensors.pressure.noise_Pa' = 25000 is unknown: did you mean 'noise_bar'?"}},
    {"UnknownSensor", "[sensors.pressure]", "[sensors.presure]", "presure", {"did you mean 'pressure'?"}},
};

INSTANTIATE_TEST_SUITE_P(Files, BadControl, testing::ValuesIn(bad_controls),
                         [](const auto& run) { return run.param.name; });

}  // namespace
}  // namespace hamilcar::io
