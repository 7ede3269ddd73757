// FMVSS 126: the steering wheel's path, the evaluation against histories made by hand, the angle A against linear theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/dwell.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"
#include "hamilcar/math/signal.hpp"
#include "support/car.hpp"
#include "support/recording.hpp"

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

// A yaw rate that dies away as exp(-t / T) from its peak at the completion of steer on, and a lateral acceleration that grows
// as k (t - 1 s) from when the wheel begins to turn: from the beginning of steer at 1 s + b on its double integral over T is
// k (b T^2 / 2 + T^3 / 6).
Recording made(double fading, double growth) {
    const std::vector<std::string> channels{channel::y,        channel::speed,    channel::lateral_speed,
                                            channel::sideslip, channel::yaw_rate, channel::lateral_acceleration};
    return test::recorded(channels, test::instants(200, 1101), [&](double t) {
        const double fade = std::exp(-(t - dwell::end) / fading);
        const double yaw_rate = t >= dwell::end ? -0.5 * fade : t < 1.8 ? 0.3 : -0.5;  // [rad/s]
        return std::vector<double>{0, 20, 0, 0, yaw_rate / degree, growth * (t - 1)};
    });
}

TEST(SineWithDwell, EvaluatesAsTheStandardSays) {
    const double fading = 0.8, growth = 5;
    const dwell::Run run = dwell::evaluated(made(fading, growth), 100, 5);
    // Smoothing overshoots by an eighth where the made yaw rate jumps.
    EXPECT_NEAR(run.early * run.peak * degree, 100 * 0.5 * std::exp(-1 / fading), 0.1);
    EXPECT_NEAR(run.late * run.peak * degree, 100 * 0.5 * std::exp(-1.75 / fading), 0.1);
    EXPECT_NEAR(run.peak * degree, 0.5, 0.07);
    EXPECT_EQ(run.last_speed, 20);
    for (const double amplitude : {10.0, 30.0, 100.0}) {  // of which 5 deg are the beginning of steer
        const double begun = std::asin(5 / amplitude) / (2 * std::numbers::pi * 0.7), T = 1.07;
        EXPECT_NEAR(dwell::evaluated(made(fading, growth), amplitude, 5).displacement,
                    growth * (begun * T * T / 2 + T * T * T / 6), 0.02)
            << amplitude;
    }
}

// A run that passes everything.
dwell::Run passing() {
    dwell::Run out{.amplitude = 200, .factor = 5};
    out.early = 10, out.late = 5, out.displacement = 3, out.last_speed = 15;
    return out;
}

Outcome judged(const VehicleDescription& car, const std::vector<dwell::Run>& runs) {
    TestRun test(maneuver, car, {}, {});
    dwell::add_verdicts(test, runs);
    return test.outcome;
}

std::vector<bool> passed(const VehicleDescription& car, const std::vector<dwell::Run>& runs) {
    std::vector<bool> out;
    for (const Verdict& verdict : judged(car, runs).verdicts) out.push_back(verdict.passed);
    return out;
}

TEST(SineWithDwell, VerdictsTurnAtTheStandardsLimits) {
    const VehicleDescription car = test::shipped_car();
    const auto changed = [&](auto&& change) {  // one of three runs
        std::vector<dwell::Run> runs(3, passing());
        change(runs[1]);
        return runs;
    };
    using Passed = std::vector<bool>;
    const auto with = [&](double dwell::Run::*what, double value) {
        return passed(car, changed([&](dwell::Run& run) { run.*what = value; }));
    };
    EXPECT_EQ(with(&dwell::Run::early, 34.9), (Passed{true, true, true}));
    EXPECT_EQ(with(&dwell::Run::early, 35.1), (Passed{false, true, true}));
    EXPECT_EQ(with(&dwell::Run::late, 19.9), (Passed{true, true, true}));
    EXPECT_EQ(with(&dwell::Run::late, 20.1), (Passed{true, false, true}));
    EXPECT_EQ(with(&dwell::Run::displacement, 1.84), (Passed{true, true, true}));
    EXPECT_EQ(with(&dwell::Run::displacement, 1.82), (Passed{true, true, false}));
    EXPECT_EQ(with(&dwell::Run::late, not_shown), (Passed{true, false, true}));  // it fell over before
    EXPECT_EQ(with(&dwell::Run::last_speed, 3.1), (Passed{true, true, true}));
    EXPECT_EQ(with(&dwell::Run::last_speed, 2.9), (Passed{true, false, true}));  // it spun, and stands
    const auto small = changed([](dwell::Run& run) { run.displacement = 0.5, run.factor = 4.5; });
    EXPECT_EQ(passed(car, small), (Passed{true, true, true}));  // below 5 A it counts for nothing
}

// Beyond 3.5 t less displacement is enough, and beyond 10 000 lb the standard does not ask for any.
TEST(SineWithDwell, HeavyVehiclesAreJudgedMoreMildly) {
    VehicleDescription car = test::shipped_car();
    std::vector<dwell::Run> runs{passing()};
    car.chassis.mass += 3000;
    for (const auto& [displacement, enough] : {std::pair{1.51, false}, std::pair{1.53, true}}) {
        runs[0].displacement = displacement;
        EXPECT_EQ(passed(car, runs).at(2), enough) << displacement;
    }
    const Outcome lighter = judged(car, runs);
    car.chassis.mass += 1000;
    const Outcome heavier = judged(car, runs);
    EXPECT_TRUE(lighter.notes.empty());
    ASSERT_EQ(heavier.notes.size(), 1u);
    EXPECT_NE(heavier.notes[0].find("4536 kg"), std::string::npos);
}

TEST(SlowSteer, FindsTheAngleThatLinearTheoryGivesForSmallOnes) {
    const VehicleDescription car = test::shipped_car();
    const double speed = 80 / 3.6;
    TestRun test(maneuver, car, {}, {.keep_runs = false});
    const auto found = slow_steer(test, speed, {});
    ASSERT_TRUE(found) << test.outcome.failed.value_or("");
    const double linear = angle_for(car, speed, 0.3 * standard_gravity) / degree;
    EXPECT_NEAR(found->angle, linear, 0.15 * linear);  // tires give a little less than in proportion
    EXPECT_GT(found->r_squared, 0.99);
}

// Without stability control a car of 1983 answers quickly, and spins with the wheel turned far.
TEST(SineWithDwell, TheCarAnswersAndSpins) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"amplitudes", 2}});
    ASSERT_EQ(outcome.verdicts.size(), 3u);
    EXPECT_TRUE(outcome.verdicts[2].passed) << outcome.verdicts[2].found;
    EXPECT_GT(figure(outcome, "lateral displacement"), 1.83);
    EXPECT_FALSE(outcome.verdicts[0].passed) << outcome.verdicts[0].found;
    for (const std::string title : {"Lateral acceleration below 6 Hz", "Lateral displacement of the path"}) {
        const auto chart = std::ranges::find(outcome.charts, title + ", largest amplitude", &io::Chart::title);
        ASSERT_NE(chart, outcome.charts.end()) << title;
        EXPECT_EQ(chart->curves.size(), 2u);
        ASSERT_EQ(chart->vertical_marks.size(), 2u);
        EXPECT_NEAR(chart->vertical_marks[1].first - chart->vertical_marks[0].first, 0.75, 1e-12);
    }
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
