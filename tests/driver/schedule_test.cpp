// Inputs over time: they interpolate the table without overshoot, rate and acceleration are derivatives of the value, and steering
// wheel angles become rack displacements.
#include <gtest/gtest.h>

#include <numbers>

#include "hamilcar/driver/schedule.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

// Rises, rests, falls steeply, turns back; uneven spacing.
const SignalDescription smooth{{0.5, 1.0, 1.2, 3.0, 3.1, 5.0, 5.5}, {0, 0.4, 1.0, 1.0, -2.0, -2.5, 0.3}};
const SignalDescription straight{smooth.time, smooth.value, Interpolation::linear};
const SignalDescription smoother{smooth.time, smooth.value, Interpolation::smoother};

TEST(Signal, PassesThroughItsPoints) {
    for (const auto& description : {smooth, smoother, straight}) {
        const Signal signal(description);
        for (std::size_t i = 0; i < description.time.size(); ++i) {
            EXPECT_NEAR(signal.at(description.time[i]).value, description.value[i], 1e-15);
        }
    }
}

// Also where both ends of a piece are as steep as a slope may be: a staircase of short steps and long flights.
TEST(Signal, IsMonotoneBetweenPoints) {
    const std::vector<double> steps{0, 0.01, 1.01, 1.02, 2.02, 2.03}, flights{0, 1, 2, 3, 4, 5};
    const std::vector<SignalDescription> all{
        smooth, smoother, {steps, flights, Interpolation::smooth}, {steps, flights, Interpolation::smoother}};
    for (const SignalDescription& d : all) {
        const Signal signal(d);
        for (std::size_t i = 0; i + 1 < d.time.size(); ++i) {
            const double rise = d.value[i + 1] - d.value[i];
            double before = d.value[i];
            for (int k = 1; k <= 1000; ++k) {
                const double time = d.time[i] + (d.time[i + 1] - d.time[i]) * k / 1000;
                const double value = signal.at(time).value;
                EXPECT_GE((value - before) * (rise < 0 ? -1 : 1), -1e-14) << "turned back at " << time;
                EXPECT_TRUE(rise != 0 || value == d.value[i]) << "must rest at " << time;
                before = value;
            }
            EXPECT_NEAR(before, d.value[i + 1], 1e-14);
        }
    }
}

TEST(Signal, RateAndAccelerationAreDerivatives) {
    for (const auto& description : {smooth, smoother, straight}) {
        const Signal signal(description);
        for (std::size_t i = 0; i + 1 < description.time.size(); ++i) {
            const double h = description.time[i + 1] - description.time[i];
            for (const double share : {0.1, 0.37, 0.5, 0.8}) {  // cubic inside a piece: differences leave round-off
                const double time = description.time[i] + share * h;
                const auto at = signal.at(time);
                const auto value = [&](double t) { return signal.at(t).value; };
                const auto rate = [&](double t) { return signal.at(t).rate; };
                EXPECT_NEAR(at.rate, test::derivative(value, time, 1e-3), 1e-10);
                EXPECT_NEAR(at.acceleration, test::derivative(rate, time, 1e-3), 1e-8);
            }
        }
    }
}

TEST(Signal, RateIsContinuousWhenSmooth) {
    const Signal signal(smooth);
    for (const double time : smooth.time) {
        EXPECT_NEAR(signal.at(time - 1e-9).rate, signal.at(time + 1e-9).rate, 1e-5)
            << "accelerations up to 2000 over 2 ns";
    }
    EXPECT_EQ(signal.at(0.5).rate, 0) << "joins the constant outside";
    EXPECT_EQ(signal.at(5.5).rate, 0);
}

TEST(Signal, AccelerationIsContinuousWhenSmoother) {
    const Signal signal(smoother);
    for (std::size_t i = 0; i + 1 < smoother.time.size(); ++i) {
        for (const double share : {0.0, 1.0 / 3, 2.0 / 3, 1.0}) {
            const double time = smoother.time[i] + share * (smoother.time[i + 1] - smoother.time[i]);
            const auto before = signal.at(time - 1e-9), after = signal.at(time + 1e-9);
            EXPECT_NEAR(before.rate, after.rate, 1e-4);
            EXPECT_NEAR(before.acceleration, after.acceleration, 2e-3) << "jerks up to 1e6 over 2 ns";
        }
    }
    EXPECT_EQ(signal.at(0.5).acceleration, 0) << "joins the constant outside";
    EXPECT_NEAR(signal.at(5.5 - 1e-12).acceleration, 0, 1e-8);
}

TEST(Signal, IsStraightBetweenPointsWhenLinear) {
    const Signal signal(straight);
    EXPECT_NEAR(signal.at(0.75).value, 0.2, 1e-15);
    EXPECT_NEAR(signal.at(3.05).value, -0.5, 1e-12);
    EXPECT_NEAR(signal.at(3.05).rate, -30, 1e-12);
    EXPECT_EQ(signal.at(3.05).acceleration, 0);
}

TEST(Signal, IsConstantOutsideItsTable) {
    for (const auto& description : {smooth, smoother, straight}) {
        const Signal signal(description);
        for (const auto& [time, value] : {std::pair{-10.0, 0.0}, {0.49, 0.0}, {5.51, 0.3}, {1e6, 0.3}}) {
            EXPECT_EQ(signal.at(time).value, value);
            EXPECT_EQ(signal.at(time).rate, 0);
            EXPECT_EQ(signal.at(time).acceleration, 0);
        }
    }
}

TEST(Signal, IsConstantForOnePointAndZeroForNone) {
    for (const double time : {-1.0, 2.0, 7.0}) {
        EXPECT_EQ(Signal(SignalDescription{{2}, {0.7}}).at(time).value, 0.7);
        EXPECT_EQ(Signal(SignalDescription{{2}, {0.7}}).at(time).rate, 0);
        EXPECT_EQ(Signal().at(time).value, 0);
        EXPECT_EQ(Signal(SignalDescription{}).at(time).value, 0);
    }
}

TEST(Signal, ScalesValueRateAndAcceleration) {
    const Signal plain(smooth), scaled(smooth, -3);
    for (const double time : {0.0, 0.7, 1.1, 4.0, 9.0}) {
        const auto a = plain.at(time), b = scaled.at(time);
        EXPECT_NEAR(b.value, -3 * a.value, 1e-13);
        EXPECT_NEAR(b.rate, -3 * a.rate, 1e-12);
        EXPECT_NEAR(b.acceleration, -3 * a.acceleration, 1e-11);
    }
}

ScenarioDescription steered(SteeringInput input) {
    ScenarioDescription scenario;
    scenario.steering_input = input;
    scenario.steering = {{0, 2}, {0, std::numbers::pi}};
    scenario.drive = {{0, 1}, {0, 600}, Interpolation::linear};
    scenario.brake = {{1, 2}, {0, 0.8}, Interpolation::linear};
    return scenario;
}
const SteeringDescription steering{.rack_per_revolution = 0.0365, .rack_travel = 0.073};

TEST(Schedule, ConvertsSteeringWheelAnglesToRackDisplacements) {
    const Schedule schedule(steered(SteeringInput::steering_wheel), steering);
    EXPECT_NEAR(schedule(3).rack.displacement, 0.0365 / 2, 1e-15) << "half a turn";
    const Input<double> middle = schedule(1);  // smooth from rest to rest: 3 s^2 - 2 s^3 over two seconds
    EXPECT_NEAR(middle.rack.displacement, 0.0365 / 4, 1e-15);
    EXPECT_NEAR(middle.rack.rate, 1.5 * 0.0365 / 2 / 2, 1e-15);
    EXPECT_NEAR(schedule(0.5).rack.acceleration, (6 - 12 * 0.25) * 0.0365 / 2 / 4, 1e-15);
}

TEST(Schedule, UsesRackDisplacementsUnchanged) {
    const Schedule schedule(steered(SteeringInput::rack), steering);
    EXPECT_EQ(schedule(3).rack.displacement, std::numbers::pi);
}

TEST(Schedule, KeepsTheRackCenteredWithoutSteering) {
    const Schedule schedule(steered(SteeringInput::none), steering);
    for (const double time : {0.0, 1.0, 3.0}) {
        EXPECT_EQ(schedule(time).rack.displacement, 0);
        EXPECT_EQ(schedule(time).rack.rate, 0);
    }
}

TEST(Schedule, PassesDriveAndBrakeThrough) {
    const Schedule schedule(steered(SteeringInput::rack), steering);
    EXPECT_NEAR(schedule(0.5).drive_torque, 300, 1e-12);
    EXPECT_EQ(schedule(0.5).brake, 0);
    EXPECT_NEAR(schedule(1.5).brake, 0.4, 1e-15);
    EXPECT_EQ(schedule(5).drive_torque, 600);
}

TEST(Schedule, KeepsEachGearUntilTheNext) {
    ScenarioDescription s;
    s.gear = {{0, 1, 2}, {1, 2, 3}, Interpolation::steps};
    s.wind_x = {{0, 2}, {0, 10}, Interpolation::linear};
    const Schedule schedule(s, {});
    EXPECT_EQ(schedule(-1).gear, 1);
    EXPECT_EQ(schedule(0.999).gear, 1);
    EXPECT_EQ(schedule(1).gear, 2);
    EXPECT_EQ(schedule(50).gear, 3);
    EXPECT_NEAR(schedule(1).wind_x, 5, 1e-12);
    EXPECT_TRUE(schedule.powered() && schedule.windy());
}

TEST(Schedule, RestoresOverriddenControls) {
    Schedule schedule(steered(SteeringInput::rack), steering), other(steered(SteeringInput::rack), steering);
    schedule.follow(Control::rack, 2, {0.01, -0.2, 3}, 1e-3);
    Schedule::Memory memory;
    schedule.save(memory);
    other.restore(memory);
    EXPECT_EQ(other(2.003).rack.displacement, schedule(2.003).rack.displacement);
    EXPECT_EQ(other(0.5).drive_torque, schedule(0.5).drive_torque) << "other controls keep their tables";
}

// A control set by a driver follows its Taylor series, for any time scale.
TEST(Schedule, FollowsADriverFromStepToStep) {
    Schedule schedule({}, {});
    for (const double step : {1e-3, 0.02}) {
        schedule.follow(Control::rack, 2, {0.01, -0.2, 3}, step);
        schedule.follow(Control::drive_torque, 2, {150}, step);
        schedule.follow(Control::brake, 2, {0.25}, step);
        for (const double after : {0.0, 1e-3, 0.5}) {
            const Input<double> input = schedule(2 + after);
            EXPECT_NEAR(input.rack.displacement, 0.01 - 0.2 * after + 1.5 * after * after, 1e-15);
            EXPECT_NEAR(input.rack.rate, -0.2 + 3 * after, 1e-14);
            EXPECT_NEAR(input.rack.acceleration, 3, 1e-13);
            EXPECT_EQ(input.drive_torque, 150);
            EXPECT_EQ(input.brake, 0.25);
        }
    }
}

}  // namespace
}  // namespace hamilcar
