// FMVSS 126: the steering wheel's path, the evaluation against histories made by hand, the angle A against linear theory.
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/dwell_run.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"
#include "hamilcar/math/signal.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

const Maneuver maneuver = sine_with_dwell();

double figure(const Outcome& outcome, const std::string& name) {
    for (const Figure& one : outcome.figures) {
        if (one.name == name) return one.value;
    }
    ADD_FAILURE() << "no figure " << name;
    return 0;
}

Outcome outcome_of(const VehicleDescription& car, const Settings& chosen) {
    ManeuverOptions options;
    options.keep_runs = false;
    return maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
}

TEST(SineWithDwell, TheWheelPausesAtItsSecondPeak) {
    const Signal wheel(dwell::sine(2));
    const double period = 1 / 0.7;
    EXPECT_NEAR(wheel.at(1).value, 0, 1e-12);
    EXPECT_NEAR(wheel.at(1 + 0.25 * period).value, 2, 1e-3);
    EXPECT_NEAR(wheel.at(1 + 0.6 * period).value, 2 * std::sin(1.2 * std::numbers::pi), 1e-3);
    for (const double t : {0.0, 0.2, 0.5}) EXPECT_NEAR(wheel.at(1 + 0.75 * period + t).value, -2, 1e-12);
    EXPECT_NEAR(wheel.at(1 + 0.9 * period + 0.5).value, 2 * std::sin(1.8 * std::numbers::pi), 1e-3);
    EXPECT_NEAR(wheel.at(dwell::end).value, 0, 1e-12);
}

// A yaw rate that dies away as exp(-t / T) from its peak at the completion of steer on, and a constant lateral acceleration
// whose double integral is a t^2 / 2.
TEST(SineWithDwell, EvaluatesAsTheStandardSays) {
    const double fading = 0.8, acceleration = 3;
    History h;
    for (int i = 0; i <= 1100; ++i) {
        const double t = 0.005 * i;
        h.time.push_back(t);
        h.x.push_back(20 * t), h.y.push_back(0), h.speed.push_back(20), h.lateral_velocity.push_back(0);
        h.yaw_rate.push_back(t < dwell::end ? (t < 1.8 ? 0.3 : -0.5) : -0.5 * std::exp(-(t - dwell::end) / fading));
        h.lateral_acceleration.push_back(acceleration);
    }
    dwell::Run run{.amplitude = 100 * degree, .factor = 5};
    dwell::evaluate(h, run);
    // Smoothing overshoots by an eighth where the made yaw rate jumps.
    EXPECT_NEAR(run.early * run.peak, 100 * 0.5 * std::exp(-1 / fading), 0.1);
    EXPECT_NEAR(run.late * run.peak, 100 * 0.5 * std::exp(-1.75 / fading), 0.1);
    EXPECT_NEAR(run.peak, 0.5, 0.07);
    EXPECT_NEAR(run.displacement, 0.5 * acceleration * 1.07 * 1.07, 0.02);
}

TEST(SlowSteer, FindsTheAngleThatLinearTheoryGivesForSmallOnes) {
    const VehicleDescription car = test::shipped_car();
    ManeuverOptions options;
    Outcome outcome;
    const double speed = 80 / 3.6;
    const SlowSteer test = slow_steer(car, options, speed, 0, 1, outcome);
    ASSERT_FALSE(test.failed);
    const double linear = angle_for(car, speed, 0.3 * standard_gravity);
    EXPECT_NEAR(test.angle, linear, 0.15 * linear);  // tires give a little less than in proportion
    EXPECT_GT(test.r_squared, 0.99);
}

// Without stability control a car of 1983 answers quickly, and spins with the wheel turned far.
TEST(SineWithDwell, TheCarAnswersAndSpins) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"amplitudes", 2}});
    ASSERT_EQ(outcome.verdicts.size(), 3u);
    EXPECT_TRUE(outcome.verdicts[2].passed) << outcome.verdicts[2].found;
    EXPECT_GT(figure(outcome, "lateral displacement"), 1.83);
    EXPECT_FALSE(outcome.verdicts[0].passed) << outcome.verdicts[0].found;
}

TEST(SineWithDwell, ACarOnSlipperyTiresDoesNotAnswer) {
    ManeuverOptions options;
    options.keep_runs = false;
    options.road.friction = 0.35;
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, {{"amplitudes", 1}}), options);
    EXPECT_FALSE(outcome.passed());
}

TEST(SineWithDwell, SaysWhichSettingIsWrong) {
    EXPECT_THROW(outcome_of(test::shipped_car(), {{"amplitudes", -1}}), io::Error);
}

}  // namespace
}  // namespace hamilcar
