// NHTSA's fishhook: lift found in loads made by hand, a low car that stays on its wheels, and the same car with its weight on
// the roof.

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/fishhook_run.hpp"
#include "lateral_tests.hpp"
#include "support/recording.hpp"

namespace hamilcar {
namespace {

const Maneuver maneuver = fishhook();

using test::figure;

Outcome outcome_of(const VehicleDescription& car, const Settings& chosen) {
    return test::driven(maneuver, car, chosen);
}

// Loads of the four wheels over 1 s; `left` of the left ones in the middle, for 0.3 s.
Drive made(
    double front_left, double rear_left, const std::function<double(double)>& acceleration = [](double) { return 0; }) {
    std::vector<std::string> channels{channel::roll, channel::lateral_acceleration};
    for (const std::string& wheel : wheel_names(test::shipped_car())) channels.push_back(channel::wheel_load(wheel));
    Drive drive;
    drive.recording = test::recorded(channels, test::instants(200, 201), [&](double time) {
        const bool middle = time > 0.4475 && time < 0.7475;
        return std::vector<double>{0,    acceleration(time),        middle ? front_left : 3000,
                                   3000, middle ? rear_left : 3000, 3000};
    });
    return drive;
}

TEST(Fishhook, TwoWheelLiftIsBothWheelsOfASide) {
    const VehicleDescription car = test::shipped_car();
    ASSERT_GT(car.suspensions[0].wheels[0].wheel.center[1], 0);
    ASSERT_GT(car.suspensions[2].wheels[0].wheel.center[1], 0);
    fishhook_run::Run one{.speed = 56, .side = 1}, both = one;
    fishhook_run::evaluate(car, made(0, 500), one);
    EXPECT_FALSE(one.tips);
    EXPECT_NEAR(one.lightest, 500.0 / 6000, 1e-12);
    fishhook_run::evaluate(car, made(0, 0), both);
    EXPECT_TRUE(both.tips);
    EXPECT_NEAR(both.lifted, 0.3, 1e-9);
}

// Roll a (1 - exp(-t / T)) has the rate a / T exp(-t / T).
TEST(Fishhook, WaitsUntilTheRollRateHasDiedAway) {
    const double reached = 1.2, settling = 0.3, roll = 5;  // [s], [s], [deg]
    const auto rolled = [&](auto&& angle) {
        return test::recorded({channel::roll}, test::instants(200, 601),
                              [&](double time) { return std::vector<double>{angle(time)}; });
    };
    const auto settled = [&](double side) {
        return rolled([&](double t) { return side * roll * (t < 1 ? 0 : 1 - std::exp(-(t - 1) / settling)); });
    };
    const double expected = 1 - reached + settling * std::log(roll / settling / 1.5);
    ASSERT_GT(expected, 0.3);
    for (const double side : {1.0, -1.0}) {
        EXPECT_NEAR(fishhook_run::calm_after(settled(side), reached), expected, 0.006);
    }
    EXPECT_EQ(fishhook_run::calm_after(rolled([](double t) { return 2 * t; }), reached), 1.5);  // without an end
}

// A spike of one row is the instrument's, not the vehicle's; what lasts is.
TEST(Fishhook, LateralAccelerationIsSmoothed) {
    const VehicleDescription car = test::shipped_car();
    const Drive drive = made(3000, 3000, [](double time) { return std::abs(time - 0.5) < 1e-3 ? 60 : 6; });
    fishhook_run::Run run{.speed = 56, .side = 1};
    fishhook_run::evaluate(car, drive, run);
    EXPECT_GT(run.lateral_acceleration, 6);
    EXPECT_LT(run.lateral_acceleration, 10);
}

// Counter-steer begins where the car's roll rate has died away, and not before.
TEST(Fishhook, FeedbackIsWhatTheWheelFollows) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"speed", 56}});
    const double dwell = figure(outcome, "dwell");
    EXPECT_GT(std::abs(dwell - fishhook_run::fixed_dwell), 0.01);
    const auto curve = [&](const std::string& title) {
        return std::ranges::find(outcome.charts, "Last run, 56 km/h: " + title, &io::Chart::title)->curves.at(0);
    };
    const io::Curve wheel = curve("steering wheel"), roll = curve("roll");
    const double held = 0.999 * figure(outcome, "steering wheel angle");
    std::size_t first = 0, last = 0;  // rows at the first angle
    for (std::size_t i = 0; i < wheel.x.size() && wheel.x[i] < 1 + 2.5; ++i) {
        if (std::abs(wheel.y[i]) < held || wheel.y[i] * wheel.y[first > 0 ? first : i] < 0) continue;
        first = first > 0 ? first : i, last = i;
    }
    EXPECT_NEAR(wheel.x[last] - wheel.x[first], dwell, 0.02);
    const auto rate = [&](std::size_t i) {
        return (std::abs(roll.y[i]) - std::abs(roll.y[i - 1])) / (roll.x[i] - roll.x[i - 1]);
    };
    EXPECT_LT(rate(last), 1.7);
    for (std::size_t i = first + 2; i + 3 < last; ++i) EXPECT_GT(rate(i), 1.5) << roll.x[i];
}

TEST(Fishhook, HeavyVehiclesAreDrivenWithANote) {
    const auto noted = [](double more) {
        VehicleDescription car = test::shipped_car();
        car.chassis.mass += more;
        const Outcome outcome = outcome_of(car, {{"speed", 20}, {"least_speed", 20}, {"feedback", 0}});
        return std::ranges::any_of(outcome.notes,
                                   [](const std::string& note) { return note.find("4536") != std::string::npos; });
    };
    EXPECT_FALSE(noted(0));
    EXPECT_TRUE(noted(3600));
}

TEST(Fishhook, TheLowCarStaysOnItsWheels) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"step", 24}});
    EXPECT_TRUE(outcome.passed()) << outcome.verdicts.at(0).found;
    EXPECT_EQ(figure(outcome, "highest speed without tip-up"), 80);
    EXPECT_LT(figure(outcome, "longest two-wheel lift"), 0.25);
    EXPECT_LT(figure(outcome, "largest roll angle"), 15);
    EXPECT_LT(std::abs(outcome.energy.residual()), 1e-3 * outcome.energy.exchanged);
}

// g t / (2 h) below what tires hold: it tips before it slides.
TEST(Fishhook, TheCarWithItsWeightOnTheRoofTips) {
    VehicleDescription car = test::shipped_car();
    car.chassis.center_of_mass[2] = 1.3;
    const Outcome outcome = outcome_of(car, {{"step", 24}, {"feedback", 0}});
    EXPECT_FALSE(outcome.passed());
    EXPECT_LE(figure(outcome, "lowest speed with tip-up"), 80);
}

TEST(Fishhook, SaysWhichSettingIsWrong) {
    EXPECT_THROW(outcome_of(test::shipped_car(), {{"speed", 40}, {"least_speed", 60}}), io::Error);
    EXPECT_THROW(outcome_of(test::shipped_car(), {{"feedback", 3}}), io::Error);
}

}  // namespace
}  // namespace hamilcar
