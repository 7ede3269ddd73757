// A run from the outside: channels, rows, ends, and the paper's stabilization against the measured violation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/run/stabilization_sweep.hpp"
#include "support/allocation_guard.hpp"
#include "support/fleet.hpp"
#include "support/paths.hpp"

namespace hamilcar {
namespace {

TEST(Channels, HaveUniqueNamesUnitsAndMeanings) {
    for (const std::string& vehicle : test::fleet()) {
        const VehicleDescription car = test::shipped(vehicle);
        const Simulation simulation(car, test::scenario(1, 5));
        const Sample sample = simulation.sample();
        std::set<std::string> names;
        for (const Channel& channel : all_channels(car)) {
            EXPECT_TRUE(names.insert(channel.column.name).second) << vehicle << ": " << channel.column.name;
            EXPECT_FALSE(channel.column.unit.empty()) << channel.column.name;
            EXPECT_FALSE(channel.column.description.empty()) << channel.column.name;
            EXPECT_TRUE(std::isfinite(channel.read(sample))) << vehicle << ": " << channel.column.name;
        }
    }
}

TEST(Channels, AreChosenByNameOrPrefix) {
    const auto all = all_channels(test::paper_car());
    EXPECT_EQ(select_channels(all, {"chassis.position.x"}).size(), 1u);
    EXPECT_EQ(select_channels(all, {"chassis.position.*"}).size(), 3u);
    EXPECT_GT(select_channels(all, {}).size(), 10u);
    EXPECT_THROW(select_channels(all, {"nonesuch.*"}), io::Error);
}

// Dropped without stops, wheels pass the reach of their linkage: the end names the wheel, its travel and the joint.
TEST(Ends, PastTheReachOfALinkageTellWheelTravelAndJoint) {
    for (const char* name : {"formula", "bmw_e90_330i"}) {
        VehicleDescription car = io::read_vehicle(test::source_path("vehicles/" + std::string(name) + ".toml"));
        for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].bump = corner.wheels[0].rebound = {};
        for (SuspensionDescription& suspension : car.suspensions) {
            for (SuspensionWheelDescription& wheel : suspension.wheels) wheel.bump = wheel.rebound = {};
        }
        ScenarioDescription s = test::scenario(3);
        s.initial.settle = false, s.initial.height = 4;
        Simulation simulation(car, s);
        std::optional<End> end;
        while (!simulation.finished() && !end) end = simulation.advance();
        ASSERT_TRUE(end.has_value()) << name;
        EXPECT_THAT(end->message, testing::HasSubstr("wheel travel ")) << name;
        EXPECT_THAT(end->message, testing::ContainsRegex("'[a-z0-9 ]+'")) << name;
        EXPECT_THAT(end->message, testing::ContainsRegex("(front|rear)_(left|right)")) << name;
        EXPECT_THAT(end->message, testing::HasSubstr("the results end at t = ")) << name;
        std::printf("%s\n", end->message.c_str());
    }
}

// Velocities are the rates of positions, accelerations those of velocities: central differences of the channels.
TEST(Channels, VelocitiesAreTheRatesOfPositions) {
    ScenarioDescription s = test::scenario(2, 15);
    s.solver.integrator = "rk4";
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0.2, 1, 2}, {0, 0.005, 0.005});
    Simulation simulation(test::paper_car(), s);
    const auto channels =
        select_channels(all_channels(test::paper_car()),
                        {"chassis.position.y", "chassis.velocity.y", "chassis.angle.yaw", "chassis.rate.yaw",
                         "front_left.wheel.travel", "front_left.spring.length", "front_left.damper.velocity"});
    std::vector<std::vector<double>> rows;
    record(
        simulation, channels, 0.001, [&](const Sample&, const std::vector<double>& row) { rows.push_back(row); },
        [](double, const RunSummary&) { return true; });
    ASSERT_EQ(rows.size(), 2001u);
    for (const std::size_t i : {500u, 900u, 1500u}) {
        const auto slope = [&](std::size_t channel) { return (rows[i + 1][channel] - rows[i - 1][channel]) / 0.002; };
        EXPECT_NEAR(slope(0), rows[i][1], 1e-4);
        EXPECT_NEAR(slope(2), rows[i][3], 0.1);  // the body's yaw rate is not quite the rate of the yaw angle
        EXPECT_NEAR(slope(5), rows[i][6], 1e-4);
    }
}

// Locked wheels turn motion to heat under the tires and nowhere else, but for what pitch and heave take.
TEST(Channels, FrictionPowerIsWhatALockedStopTakes) {
    VehicleDescription car = test::paper_car();
    for (SuspensionDescription& suspension : car.suspensions) suspension.wheels[0].brake.max_torque = 20e3;
    ScenarioDescription s = test::scenario(2, 20);
    s.brake = test::table({0, 0.05}, {0, 1});
    Simulation simulation(car, s);
    std::vector<std::string> names{"chassis.speed"};
    for (const char* wheel : {"front_left", "front_right", "rear_left", "rear_right"}) {
        names.push_back(wheel + std::string(".tire.friction_power"));
    }
    const auto channels = select_channels(all_channels(car), names);
    ASSERT_EQ(channels[0].column.name, names[0]);
    constexpr double interval = 0.001;
    double heat = 0, start = 0, end = 0;
    record(
        simulation, channels, interval,
        [&](const Sample& sample, const std::vector<double>& row) {
            (sample.time == 0 ? start : end) = row[0];
            for (std::size_t i = 1; i < 5; ++i) heat += row[i] * interval;
        },
        [](double, const RunSummary&) { return true; });
    EXPECT_LT(end, 5) << "most of the speed is gone";
    const double lost = 0.5 * total_mass(car) * (start * start - end * end);
    std::printf("of %.0f kJ that the car lost, %.1f kJ are heat under its tires\n", lost / 1e3, heat / 1e3);
    EXPECT_NEAR(heat, lost, 0.03 * lost);
}

TEST(Record, WritesTheStartEveryIntervalAndTheLastState) {
    ScenarioDescription s = test::scenario(0.026);
    Simulation simulation(test::paper_car(), s);
    std::vector<double> times;
    const RunSummary summary = record(
        simulation, {}, 0.01, [&](const Sample& sample, const std::vector<double>&) { times.push_back(sample.time); },
        [](double, const RunSummary&) { return true; });
    EXPECT_THAT(times,
                testing::ElementsAre(0, testing::DoubleEq(0.01), testing::DoubleEq(0.02), testing::DoubleEq(0.026)));
    EXPECT_EQ(summary.steps, 26);
    EXPECT_FALSE(summary.ended_early);
}

TEST(Simulation, RefusesAGainBeyondTheLimitAndTheRackBeyondItsStops) {
    ScenarioDescription s = test::scenario(1);
    s.solver.constraints = ConstraintMode::stabilized;
    s.solver.stabilization = StabilizationRule::value;
    s.solver.stabilization_gain = 546;
    EXPECT_THROW(Simulation(test::paper_car(), s), io::Error);
    s.solver.stabilization_gain = 545;
    EXPECT_NO_THROW(Simulation(test::paper_car(), s));
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0, 1}, {0, 0.08});
    EXPECT_THROW(Simulation(test::paper_car(), s), io::Error);
}

// (57) and (58) undo each other: the velocities asked for at the start are those that come out, in both charts, with the
// rack already moving.
TEST(Simulation, StartsWithTheVelocitiesItWasGiven) {
    for (const ChassisChart chart : {ChassisChart::quaternion, ChassisChart::bryant}) {
        ScenarioDescription s = test::scenario(1);
        s.initial.velocity = {12, 3, -0.5};
        s.initial.angular_velocity = {0.2, -0.1, 0.6};
        s.initial.yaw = 0.8;
        s.solver.chart = chart;
        s.steering_input = SteeringInput::rack;
        s.steering = {{-1, 1}, {-0.01, 0.01}, Interpolation::linear};
        const Simulation simulation(test::paper_car(), s);
        const Sample start = simulation.sample();
        EXPECT_EQ(start.input.rack.rate, 0.01);
        Spatial<double> expected;
        expected << 12, 3, -0.5, 0.2, -0.1, 0.6;
        EXPECT_LT((start.velocity.chassis - expected).norm(), 1e-12);
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(start.velocity.suspensions[static_cast<std::size_t>(i)].own.V_rate[0], 0, 1e-12);
    }
}

TEST(Channels, AreNotDoubledByOverlappingPatterns) {
    const auto all = all_channels(test::paper_car());
    EXPECT_EQ(select_channels(all, {"chassis.position.*", "chassis.position.x"}).size(), 3u);
}

TEST(AdaptiveMethod, GivesUpInsteadOfHangingWhereNothingIsFinite) {
    VehicleDescription car = test::paper_car();
    for (SuspensionDescription& corner : car.suspensions)
        std::get<LinearTireDescription>(corner.wheels[0].tire).vertical_stiffness = 1e30;
    ScenarioDescription s = test::scenario(1, 20);
    s.initial.settle = false;
    s.initial.height = -0.01;
    s.solver.integrator = "dopri5";
    s.solver.step = 0.1;
    Simulation simulation(car, s);
    std::optional<End> end;
    while (!simulation.finished() && !end) end = simulation.advance();
    EXPECT_TRUE(end.has_value());
}

// Back by 100 ms and forward again: every bit as before, from the first steps of a method on, and after a detour with
// another driver.
TEST(Snapshot, ReplaysTheSameBits) {
    for (const char* integrator : {"ab3", "abm4", "rk4", "dopri5"}) {
        ScenarioDescription s = test::scenario(5, 20);
        s.solver.integrator = integrator;
        s.steering_input = SteeringInput::rack;
        s.steering = test::table({0, 0.2, 0.5}, {0, 0.006, -0.002});
        ScenarioDescription detour = s;
        detour.steering = test::table({0, 0.3}, {0, -0.008});
        Simulation simulation(test::paper_car(), s);
        const Schedule own = simulation.schedule(), other(detour, simulation.vehicle().steering);
        const auto advance = [&] {
            for (int i = 0; i < 100; ++i) ASSERT_FALSE(simulation.advance());
        };
        for (const int steps_before : {0, 1, 500}) {
            while (simulation.steps_taken() < steps_before) ASSERT_FALSE(simulation.advance());
            Snapshot here;
            simulation.save(here);
            advance();
            const State<double> expected = simulation.state();
            simulation.restore(here);
            EXPECT_EQ(simulation.steps_taken(), steps_before);
            simulation.set_schedule(other);
            advance();
            EXPECT_NE(simulation.state().values, expected.values) << integrator;
            simulation.set_schedule(own);
            simulation.restore(here);
            advance();
            EXPECT_EQ(simulation.state().values, expected.values) << integrator << " after " << steps_before;
            simulation.restore(here);
        }
    }
}

TEST(Snapshot, AllocatesNothing) {
    Simulation simulation(test::paper_car(), test::scenario(1, 20));
    for (int i = 0; i < 20; ++i) simulation.advance();
    Snapshot here;
    const test::AllocationGuard guard;
    simulation.save(here);
    simulation.restore(here);
    EXPECT_EQ(guard.allocations(), 0);
}

TEST(EnergyBalance, IsSaidToBeMissingWhereItIsNotKept) {
    ScenarioDescription s = test::scenario(0.1, 20);
    Simulation with(test::paper_car(), s);
    s.solver.energy_balance = false;
    Simulation without(test::paper_car(), s);
    test::run_to_end(with), test::run_to_end(without);
    EXPECT_TRUE(std::isnan(without.sample().energy.balance()));
    State<double> same = with.state();
    same.work() = without.state().work();
    EXPECT_EQ(same.values, without.state().values);
}

// Fig. 9 on a short, hard maneuver: the violation is least inside the stable range, and beyond 6/11 the run is lost.
TEST(StabilizationSweep, HasItsLeastViolationInsideTheStableRange) {
    ScenarioDescription s = test::scenario(4, 15);
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0.5, 1, 2, 3}, {0, 0.006, -0.006, 0});
    const auto runs = stabilization_sweep(test::paper_car(), s, {20, 250, 500, 560, 800}, 0.001);
    EXPECT_LT(runs[1].rms_norm, runs[0].rms_norm);
    EXPECT_LT(runs[1].rms_norm, runs[2].rms_norm);
    EXPECT_FALSE(runs[2].blew_up);
    EXPECT_TRUE(runs[3].blew_up);
    EXPECT_TRUE(runs[4].blew_up);
    EXPECT_LT(runs[4].ended, runs[3].ended);
}

// A jump of the rack's acceleration leaves an error that a gain of about 0.2 / h forgets sooner than one of 0.4 / h; without jumps
// there is the truncation error alone, which falls with the gain.
TEST(StabilizationSweep, JumpsOfTheAccelerationDecideTheBestGain) {
    ScenarioDescription s = io::read_scenario(test::source_path("scenarios/paper.toml"));
    s.steering.interpolation = Interpolation::smooth;
    const auto jumping = stabilization_sweep(test::paper_car(), s, {200, 400}, 0.01);
    s.steering.interpolation = Interpolation::smoother;
    const auto continuous = stabilization_sweep(test::paper_car(), s, {200, 400, 450}, 0.01);
    EXPECT_GT(jumping[1].rms_norm, 5 * jumping[0].rms_norm);
    EXPECT_LT(continuous[1].rms_norm, continuous[0].rms_norm);
    EXPECT_LT(continuous[1].rms_norm, 1.1 * continuous[2].rms_norm);
    EXPECT_LT(continuous[1].max_norm, 0.2 * jumping[1].max_norm);
}

}  // namespace
}  // namespace hamilcar
