// Scenario files: defaults, every key, paths, and mistakes told with place, key, value and expectation.
#include "hamilcar/io/scenario_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;

constexpr double degree = M_PI / 180;

const std::string minimal = "name = 'rest'\nvehicle = '../vehicles/car.toml'\nduration_s = 2\n";

const std::string complete = R"(name = "everything"
vehicle = "car.toml"
duration_s = 10.0
[solver]
step_s = 2e-3
integrator = "abm4"
tolerance = 1e-6
constraints = "stabilized"
stabilization_gain_per_s = 400
chart = "bryant"
[initial]
settle = false
position_m = [1, 2]
height_m = 0.1
yaw_deg = 90
roll_deg = 1
pitch_deg = -1
velocity_m_per_s = [20, 1, 0]
angular_velocity_deg_per_s = [0, 0, 180]
[road]
grade_percent = 15
bank_percent = -2
friction = 0.3
[inputs.steering_wheel]
time_s = [0, 1, 2]
angle_deg = [0, 180, 0]
interpolation = "linear"
[inputs.drive]
torque_N_m = 120
[inputs.brake]
time_s = [3.0, 3.5]
command = [0.0, 1.0]
[output]
interval_s = 0.02
channels = ["chassis.*", "front_left.slip"]
csv = false
netcdf = true
)";

TEST(ScenarioFile, WhatIsNotSaidHasItsDefault) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scenarios");
    const auto scenario = read_scenario(folder.write("scenarios/rest.toml", minimal));
    const ScenarioDescription usual;
    EXPECT_EQ(scenario.name, "rest");
    EXPECT_EQ(scenario.vehicle, folder / "vehicles/car.toml");
    EXPECT_EQ(scenario.duration, 2);
    EXPECT_EQ(scenario.solver.step, usual.solver.step);
    EXPECT_EQ(scenario.solver.integrator, "ab3");
    EXPECT_EQ(scenario.solver.constraints, ConstraintMode::exact);
    EXPECT_TRUE(scenario.initial.settle);
    EXPECT_EQ(scenario.road.friction, 1);
    EXPECT_EQ(scenario.steering_input, SteeringInput::none);
    EXPECT_TRUE(scenario.drive.time.empty());
    EXPECT_TRUE(scenario.output.csv && scenario.output.netcdf);
}

TEST(ScenarioFile, EveryKeyIsReadInItsUnit) {
    const TemporaryFolder folder;
    const auto scenario = read_scenario(folder.write("everything.toml", complete));
    EXPECT_EQ(scenario.solver.step, 2e-3);
    EXPECT_EQ(scenario.solver.integrator, "abm4");
    EXPECT_EQ(scenario.solver.tolerance, 1e-6);
    EXPECT_EQ(scenario.solver.constraints, ConstraintMode::stabilized);
    EXPECT_EQ(scenario.solver.stabilization, StabilizationRule::value);
    EXPECT_EQ(scenario.solver.stabilization_gain, 400);
    EXPECT_EQ(scenario.solver.chart, ChassisChart::bryant);
    EXPECT_FALSE(scenario.initial.settle);
    EXPECT_THAT(scenario.initial.position, ElementsAre(1, 2));
    EXPECT_EQ(scenario.initial.height, 0.1);
    EXPECT_DOUBLE_EQ(scenario.initial.yaw, 90 * degree);
    EXPECT_DOUBLE_EQ(scenario.initial.roll, degree);
    EXPECT_DOUBLE_EQ(scenario.initial.pitch, -degree);
    EXPECT_THAT(scenario.initial.velocity, ElementsAre(20, 1, 0));
    EXPECT_THAT(scenario.initial.angular_velocity, ElementsAre(0, 0, DoubleEq(M_PI)));
    EXPECT_DOUBLE_EQ(scenario.road.grade, 0.15);
    EXPECT_DOUBLE_EQ(scenario.road.bank, -0.02);
    EXPECT_EQ(scenario.road.friction, 0.3);
    EXPECT_EQ(scenario.steering_input, SteeringInput::steering_wheel);
    EXPECT_THAT(scenario.steering.time, ElementsAre(0, 1, 2));
    EXPECT_THAT(scenario.steering.value, ElementsAre(0, DoubleEq(M_PI), 0));
    EXPECT_EQ(scenario.steering.interpolation, Interpolation::linear);
    EXPECT_THAT(scenario.drive.time, ElementsAre(0));
    EXPECT_THAT(scenario.drive.value, ElementsAre(120));
    EXPECT_THAT(scenario.brake.value, ElementsAre(0, 1));
    EXPECT_EQ(scenario.brake.interpolation, Interpolation::smooth);
    EXPECT_EQ(scenario.output.interval, 0.02);
    EXPECT_THAT(scenario.output.channels, ElementsAre("chassis.*", "front_left.slip"));
    EXPECT_FALSE(scenario.output.csv);
}

TEST(ScenarioFile, SpeedAheadIsOneNumberAndTheRackIsAnInput) {
    const TemporaryFolder folder;
    const auto scenario = read_scenario(folder.write("s.toml", minimal + "[initial]\nvelocity_m_per_s = 20\n"
                                                                         "[inputs.rack]\ndisplacement_m = 0.01\n"
                                                                         "[solver]\nstabilization = 'limit'\n"));
    EXPECT_THAT(scenario.initial.velocity, ElementsAre(20, 0, 0));
    EXPECT_EQ(scenario.steering_input, SteeringInput::rack);
    EXPECT_THAT(scenario.steering.value, ElementsAre(0.01));
    EXPECT_EQ(scenario.solver.stabilization, StabilizationRule::limit);
}

TEST(ScenarioFile, ABaseIsOverriddenKeyByKey) {
    const TemporaryFolder folder;
    folder.write("everything.toml", complete);
    const auto scenario =
        read_scenario(folder.write("icy.toml",
                                   "base = 'everything.toml'\nroad.friction = 0.1\nsolver.stabilization = 'limit'\n"
                                   "inputs.rack.displacement_m = 0.02\noutput.channels = ['time']\n"));
    EXPECT_EQ(scenario.name, "everything");
    EXPECT_EQ(scenario.road.friction, 0.1);
    EXPECT_DOUBLE_EQ(scenario.road.grade, 0.15);
    EXPECT_EQ(scenario.solver.stabilization, StabilizationRule::limit);
    EXPECT_EQ(scenario.steering_input, SteeringInput::rack);
    EXPECT_THAT(scenario.output.channels, ElementsAre("time"));
}

TEST(Places, OfAKeyAreHereInABaseOrThoseOfItsNearestParent) {
    const TemporaryFolder folder;
    const std::string base =
        folder.write("base.toml",
                     "name = 'x'\nvehicle = 'v.toml'\nduration_s = 1\n[solver]\nstep_s = 1e-3\n[[road.wave]]\n"
                     "amplitude_m = 0.1\nwavelength_m = 2\n");
    const std::string derived = folder.write("derived.toml", "base = 'base.toml'\n\nroad.friction = 0.5\n");
    const auto places = read_scenario(derived).places;
    ASSERT_TRUE(places);
    EXPECT_EQ(places->of("road.friction"), derived + ":3:17");
    EXPECT_EQ(places->of("solver.step_s"), base + ":5:10");
    EXPECT_EQ(places->of("road.wave[0].wavelength_m"), base + ":8:16");
    EXPECT_EQ(places->of("road.wave[0].length_m"), base + ":6:1");
    EXPECT_EQ(places->of("output.channels"), derived);
    EXPECT_EQ(places->of(""), derived);
    EXPECT_EQ(at_key(places, "road.friction"), derived + ":3:17: ");
    EXPECT_EQ(at_key(nullptr, "road.friction"), "");
}

TEST(Places, OfAVehicleGoByTheNamesOfItsAxles) {
    const std::string path = repository_path("vehicles/bmw_323i.toml");
    const auto places = read_vehicle(path).places;
    ASSERT_TRUE(places);
    EXPECT_EQ(places->file, path);
    EXPECT_TRUE(places->keys.contains("axle[front].spring.rate_N_per_m"));
    EXPECT_TRUE(places->of("axle[front].spring.rate_N_per_m").starts_with(path + ":"));
}

TEST(ShippedScenarios, AreReadAndNameAVehicleThatExists) {
    for (const auto& entry : std::filesystem::directory_iterator(repository_path("scenarios"))) {
        if (entry.path().extension() != ".toml") continue;
        const auto scenario = read_scenario(entry.path().string());
        EXPECT_TRUE(std::filesystem::exists(scenario.vehicle)) << entry.path();
    }
}

TEST(ShippedScenarios, DoWhatTheirNamesSay) {
    const auto step = read_scenario(repository_path("scenarios/step_steer.toml"));
    EXPECT_EQ(step.initial.velocity[0], 20);
    EXPECT_DOUBLE_EQ(step.steering.value.back(), 30 * degree);
    EXPECT_DOUBLE_EQ(step.steering.time[1] - step.steering.time[0], 0.2);
    const auto hill = read_scenario(repository_path("scenarios/hill_hold.toml"));
    EXPECT_DOUBLE_EQ(hill.road.grade, 0.15);
    EXPECT_EQ(hill.brake.value.front(), 0.3);
    EXPECT_EQ(hill.duration, 60);
    const auto stop = read_scenario(repository_path("scenarios/brake_to_stop.toml"));
    EXPECT_EQ(stop.brake.value.back(), 0.6);
    EXPECT_EQ(stop.brake.time.front(), 1);
}

class BadScenarioFile : public testing::TestWithParam<BadInput> {};

TEST_P(BadScenarioFile, IsToldWithPlaceKeyValueAndExpectation) {
    expect_refused(complete, GetParam(), [](const std::string& path) { read_scenario(path); });
}

const std::vector<BadInput> bad_scenarios{
    {"NoDuration",
     "duration_s = 10.0",
     "duration_s = 0",
     "0\n[solver]",
     {"key 'duration_s' = 0: expected a positive number [s]"}},
    {"NegativeStep",
     "step_s = 2e-3",
     "step_s = -2e-3",
     "-2e-3",
     {"'solver.step_s' = -2e-3", "a number from 1e-6 to 0.1 [s]"}},
    {"StepOfAges",
     "step_s = 2e-3",
     "step_s = 1e30",
     "1e30",
     {"'solver.step_s' = 1e30: expected a number from 1e-6 to 0.1 [s]"}},
    {"StepOfNothing",
     "step_s = 2e-3",
     "step_s = 5e-324",
     "5e-324",
     {"'solver.step_s' = 5e-324: expected a number from"}},
    {"RowEveryAge",
     "interval_s = 0.02",
     "interval_s = 1e30",
     "1e30",
     {"'output.interval_s' = 1e30: expected a number from 0 to 1e6 [s]"}},
    {"FartherThanNumbersReach",
     "position_m = [1, 2]",
     "position_m = [1e300, 2]",
     "[1e300, 2]",
     {"'initial.position_m' = [1e300, 2]: expected a place within 1e7 m of the origin [m]"}},
    {"FasterThanAnything",
     "[20, 1, 0]",
     "[1e154, 0, 0]",
     "[1e154, 0, 0]",
     {"'initial.velocity_m_per_s' = [1e154, 0, 0]: expected a speed of 1000 m/s at most"}},
    {"TurnedBeyondSense",
     "yaw_deg = 90",
     "yaw_deg = 1e300",
     "1e300",
     {"'initial.yaw_deg' = 1e300: expected a number from"}},
    {"HalfAnObstacle",
     "[initial]",
     "[[road.obstacle]]\nstart_m = 1\nlength_m = 1\nheight_m = 0.1\ncount = 2.5\n[initial]",
     "2.5",
     {"count' = 2.5: expected a whole number from 1 to 10000"}},
    {"HalfASeed",
     "[initial]",
     "[[road.random]]\nclass = \"C\"\nlength_m = 100\nseed = 0.25\n[initial]",
     "0.25",
     {"seed' = 0.25: expected a whole number from 0 to 1e15"}},
    {"TooManySteps",
     "duration_s = 10.0",
     "duration_s = 1e300",
     "1e300",
     {"'duration_s' = 1e300: expected fewer than 1e9 steps of 0.002 [s]"}},
    {"StepAboveDuration",
     "duration_s = 10.0",
     "duration_s = 1e-3",
     "1e-3",
     {"'duration_s' = 1e-3", "one step of 0.002 [s]"}},
    {"GainBeyondTheLimit",
     "stabilization_gain_per_s = 400",
     "stabilization_gain_per_s = 900",
     "900",
     {"'solver.stabilization_gain_per_s' = 900", "less than 642.4", "a step below 0.00143 s", "[1/s]"}},
    {"UnknownIntegrator",
     "\"abm4\"",
     "\"abm44\"",
     "\"abm44\"",
     {"'solver.integrator' = \"abm44\"", "'ab1'", "'dopri5'", "did you mean 'abm4'?"}},
    {"UnknownConstraints",
     "\"stabilized\"",
     "\"loose\"",
     "\"loose\"",
     {"'solver.constraints' = \"loose\"", "one of 'exact' or 'stabilized'"}},
    {"TwoStabilizations",
     "chart = \"bryant\"",
     "stabilization = \"paper\"",
     "400",
     {"'solver.stabilization_gain_per_s' = 400: expected either this or 'stabilization', not both"}},
    {"TimesDoNotIncrease",
     "time_s = [0, 1, 2]",
     "time_s = [0, 2, 2]",
     "2]\nangle",
     {"'inputs.steering_wheel.time_s[2]' = 2: expected a number above the one before, 2 [s]"}},
    {"LengthMismatch",
     "time_s = [0, 1, 2]",
     "time_s = [0, 1]",
     "[0, 180, 0]",
     {"'inputs.steering_wheel.angle_deg' = [0, 180, 0]: expected 2 numbers, one for each of 'time_s' [deg]"}},
    {"EmptyTable", "time_s = [0, 1, 2]", "time_s = []", "[]", {"'inputs.steering_wheel.time_s' = []", "at least one"}},
    {"NotANumberInATable",
     "angle_deg = [0, 180, 0]",
     "angle_deg = [0, nan, 0]",
     "nan",
     {"'inputs.steering_wheel.angle_deg[1]' = nan: expected a finite number [deg]"}},
    {"InfiniteTime", "time_s = [0, 1, 2]", "time_s = [0, 1, inf]", "inf", {"time_s[2]' = inf", "finite number [s]"}},
    {"NoTimes", "time_s = [3.0, 3.5]", "", "[inputs.brake]", {"'inputs.brake.time_s' is missing", "[s]"}},
    {"BrakeAboveOne",
     "command = [0.0, 1.0]",
     "command = [0.0, 1.2]",
     "1.2",
     {"'inputs.brake.command[1]' = 1.2: expected a number from 0 to 1"}},
    {"WheelAndRack",
     "[inputs.drive]",
     "[inputs.rack]\ndisplacement_m = 0\n[inputs.drive]",
     "[inputs.rack]",
     {"'inputs.rack'", "either this or 'steering_wheel', not both"}},
    {"UnknownInput", "[inputs.brake]", "[inputs.breake]", "breake", {"'inputs.breake'", "did you mean 'brake'?"}},
    {"NegativeInterval",
     "interval_s = 0.02",
     "interval_s = -1",
     "-1\nchannels",
     {"'output.interval_s' = -1: expected a number from 0 to 1e6 [s]"}},
    {"ChannelIsNoText", "\"front_left.slip\"", "7", "7]", {"'output.channels[1]' = 7: expected a text in quotes"}},
    {"SettledAtAHeight", "settle = false", "settle = true", "0.1", {"'initial.height_m' = 0.1", "'settle = false'"}},
    {"VelocityOfTwoNumbers",
     "[20, 1, 0]",
     "[20, 1]",
     "[20, 1]",
     {"velocity_m_per_s' = [20, 1]: expected 3 numbers [m/s]"}},
    {"NoFriction", "friction = 0.3", "friction = 0", "0\n[inputs", {"'road.friction' = 0: expected a positive number"}},
    {"BooleanAsNumber", "csv = false", "csv = 0", "0\nnetcdf", {"'output.csv' = 0: expected true or false"}},
    {"NoVehicle", "vehicle = \"car.toml\"", "vehicle = \"\"", "\"\"", {"'vehicle' = \"\"", "a text in quotes"}},
    {"UnknownTable", "[road]", "[roads]", "roads", {"key 'roads'", "did you mean 'road'?"}},
};

INSTANTIATE_TEST_SUITE_P(EveryMistake, BadScenarioFile, testing::ValuesIn(bad_scenarios),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace hamilcar::io
