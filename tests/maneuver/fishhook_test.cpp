// NHTSA's fishhook: lift found in loads made by hand, a low car that stays on its wheels, and the same car with its weight on
// the roof.
#include <gtest/gtest.h>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/fishhook_run.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

const Maneuver maneuver = fishhook();

Outcome outcome_of(const VehicleDescription& car, const Settings& chosen) {
    ManeuverOptions options;
    options.keep_runs = false;
    return maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
}

double figure(const Outcome& outcome, const std::string& name) {
    for (const Figure& one : outcome.figures) {
        if (one.name == name) return one.value;
    }
    ADD_FAILURE() << "no figure " << name;
    return 0;
}

// Loads of the four wheels over 1 s; `left` of the left ones in the middle, for 0.3 s.
Trial made(double front_left, double rear_left) {
    Trial trial;
    History& h = trial.history;
    h.wheel_load.resize(4);
    for (int i = 0; i <= 200; ++i) {
        h.time.push_back(0.005 * i);
        const bool middle = i >= 90 && i < 150;
        h.wheel_load[0].push_back(middle ? front_left : 3000), h.wheel_load[1].push_back(3000);
        h.wheel_load[2].push_back(middle ? rear_left : 3000), h.wheel_load[3].push_back(3000);
        h.roll.push_back(0), h.lateral_acceleration.push_back(0);
    }
    return trial;
}

TEST(Fishhook, TwoWheelLiftIsBothWheelsOfASide) {
    const VehicleDescription car = test::shipped_car();
    ASSERT_GT(car.corners[0].wheel.center[1], 0);
    ASSERT_GT(car.corners[2].wheel.center[1], 0);
    fishhook_run::Run one{.speed = 56, .side = 1}, both = one;
    fishhook_run::evaluate(car, made(0, 500), one);
    EXPECT_FALSE(one.tips);
    EXPECT_NEAR(one.lightest, 500.0 / 6000, 1e-12);
    fishhook_run::evaluate(car, made(0, 0), both);
    EXPECT_TRUE(both.tips);
    EXPECT_NEAR(both.lifted, 0.3, 1e-9);
}

TEST(Fishhook, TheLowCarStaysOnItsWheels) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"step", 24}});
    EXPECT_TRUE(outcome.passed()) << outcome.verdicts.at(0).found;
    EXPECT_EQ(figure(outcome, "highest speed without tip-up"), 80);
    EXPECT_LT(figure(outcome, "longest two-wheel lift"), 0.25);
    EXPECT_LT(figure(outcome, "largest roll angle"), 15);
    EXPECT_LT(std::abs(outcome.energy.gap()), 1e-3 * outcome.energy.turnover);
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
