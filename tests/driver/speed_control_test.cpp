// Speed control with the pedals, by an engine and by a torque at the wheels, uphill and downhill; unattainable speeds are reported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "driver/powered_car.hpp"

namespace hamilcar {
namespace {

using test::PoweredCar;
using test::PoweredDrive;

DriverDescription holding(const SignalDescription& speed, bool may_brake = true) {
    return {.speed = SpeedControlDescription{.speed = speed, .may_brake = may_brake},
            .shifting = ShiftingDescription{.gear = 3}};
}

// A mass with resistance and brakes, and a torque at its wheels.
struct Mass {
    double speed = 20, grade = 0;
    static constexpr double mass = 1500, radius = 0.3, full_brake_force = 15e3;
    double drive_torque = 0, brake = 0;

    void go(const DriverDescription& description, double duration) {
        const DrivenCar known{.mass = mass, .wheel_radius = radius, .full_brake_force = full_brake_force};
        Schedule schedule({}, {});
        driver = Driver(description, known, Column());
        driver.begin(schedule);
        for (int i = 0; i < duration * 1000; ++i) {
            const double time = i * 1e-3;
            if (i % 5 == 0) driver.act({.time = time, .speed = speed}, schedule);
            drive_torque = schedule.signal(Control::drive_torque).at(time).value;
            brake = schedule.signal(Control::brake).at(time).value;
            both += drive_torque > 0 && brake > 0, most_brake = std::max(most_brake, brake);
            const double resistance = 0.2 + 3e-4 * speed * speed;
            speed += 1e-3 * ((drive_torque / radius - brake * full_brake_force * std::tanh(speed / 0.02)) / mass -
                             resistance * std::tanh(speed / 0.02) - 9.81 * grade);
            fastest = std::max(fastest, speed), slowest = std::min(slowest, speed);
        }
    }
    Driver driver;
    double fastest = 0, slowest = 1e9, most_brake = 0;
    int both = 0;  // steps with both pedals pressed
};

TEST(SpeedControl, HoldsASpeedWithoutAnError) {
    for (const double grade : {-0.08, -0.03, 0.0, 0.03, 0.08}) {
        Mass car{.grade = grade};
        car.go({.speed = SpeedControlDescription{.speed = {{0}, {20}}}}, 40);
        EXPECT_NEAR(car.speed, 20, 0.01) << grade;
        EXPECT_LT(car.fastest - car.slowest, 0.6) << grade;
        EXPECT_LT(car.both, 200) << grade;
    }
}

TEST(SpeedControl, StartsAtItsSpeedWithHardlyADip) {
    PoweredCar car;
    car.speed = 20;
    PoweredDrive drive(car, holding({{0}, {20}}));
    double least = 20, most = 20;
    drive.go(15, [&] { least = std::min(least, drive.car.speed), most = std::max(most, drive.car.speed); });
    EXPECT_GT(least, 19.8);
    EXPECT_LT(most, 20.2);
    EXPECT_NEAR(drive.car.speed, 20, 0.01);
    EXPECT_TRUE(drive.driver.warnings().empty());
}

TEST(SpeedControl, FollowsASpeedThatRises) {
    PoweredCar car;
    car.speed = 15;
    PoweredDrive drive(car, holding({{2, 22}, {15, 25}, Interpolation::linear}));
    double worst = 0;
    drive.go(22, [&] {
        if (drive.time() > 6) worst = std::max(worst, std::abs(drive.car.speed - 15 - 0.5 * (drive.time() - 2)));
    });
    EXPECT_LT(worst, 0.15);
}

// Two steps of the target, up and down: within the acceleration limit, and almost without overshoot.
TEST(SpeedControl, KeepsTheAccelerationLimit) {
    Mass up{.speed = 10}, down{.speed = 30};
    DriverDescription description{.speed = SpeedControlDescription{.speed = {{0}, {20}}, .largest_acceleration = 2}};
    up.go(description, 4);
    EXPECT_NEAR(up.speed, 18, 0.7);
    down.go(description, 4);
    EXPECT_NEAR(down.speed, 22, 0.7);
    up.go(description, 30);
    down.go(description, 30);
    EXPECT_NEAR(up.speed, 20, 0.02);
    EXPECT_NEAR(down.speed, 20, 0.02);
    EXPECT_LT(up.fastest, 20.5);
    EXPECT_GT(down.slowest, 19.5);
    EXPECT_EQ(up.most_brake, 0);
    EXPECT_GT(down.most_brake, 0.1);
}

TEST(SpeedControl, OnlyReleasesTheThrottleIfItMayNotBrake) {
    Mass car{.speed = 30};
    car.go({.speed = SpeedControlDescription{.speed = {{0}, {20}}, .may_brake = false}}, 10);
    EXPECT_EQ(car.most_brake, 0);
    EXPECT_EQ(car.drive_torque, 0);
    EXPECT_GT(car.speed, 24);
}

// On a grade that engine drag nearly balances, the pedals do not alternate.
TEST(SpeedControl, DoesNotChatterBetweenThePedals) {
    for (double grade = -0.12; grade < 0.001; grade += 0.01) {
        PoweredCar car;
        car.speed = 20, car.grade = grade;
        PoweredDrive drive(car, holding({{0}, {20}}));
        int changes = 0;
        bool braking = false, both = false;
        drive.go(40, [&] {
            const bool now = drive.value(Control::brake) > 0;
            changes += now != braking, braking = now;
            both |= drive.value(Control::throttle) > 0.1 && drive.value(Control::brake) > 0.05;
        });
        EXPECT_LE(changes, 3) << grade;
        EXPECT_FALSE(both) << grade;
        EXPECT_NEAR(drive.car.speed, 20, 0.1) << grade;
    }
}

TEST(SpeedControl, StopsAndHoldsTheCar) {
    Mass car{.speed = 8, .grade = 0.0};
    car.go({.speed = SpeedControlDescription{.speed = {{0}, {0}}}}, 12);
    EXPECT_NEAR(car.speed, 0, 0.02);
    EXPECT_GT(car.brake, 0.05);
    EXPECT_EQ(car.drive_torque, 0);
}

// From rest and from motion, uphill and downhill; weak brakes are fully applied.
TEST(SpeedControl, HoldsTheCarOnSlopes) {
    for (const double grade : {-0.2, -0.1, 0.1, 0.2}) {
        for (const double start : {-1.0, 0.0, 6.0}) {
            Mass car{.speed = start, .grade = grade};
            car.go({.speed = SpeedControlDescription{.speed = {{0}, {0}}}}, 15);
            EXPECT_NEAR(car.speed, 0, 0.02) << grade << ' ' << start;
            EXPECT_GT(car.brake * Mass::full_brake_force, Mass::mass * 9.81 * std::abs(grade)) << grade << ' ' << start;
            EXPECT_EQ(car.drive_torque, 0);
            EXPECT_GT(car.slowest, std::min(start, 0.0) - 0.2) << "it hardly rolls back";
            EXPECT_LT(car.fastest, std::max(start, 0.0) + 0.2);
        }
    }
}

TEST(SpeedControl, ReleasesTheBrakeToDriveOn) {
    Mass car{.speed = 0, .grade = -0.1};
    car.go({.speed = SpeedControlDescription{.speed = {{0, 5, 10}, {0, 0, 8}}}}, 40);
    EXPECT_NEAR(car.speed, 8, 0.02);
}

// In neutral, and where the clutch slips permanently.
TEST(SpeedControl, ReportsThatTheCarDoesNotMove) {
    for (const int gear : {-1, 0, 5}) {
        PoweredCar car;
        car.grade = gear == 5 ? 0.25 : 0;
        PoweredDrive drive(car, {.speed = SpeedControlDescription{.speed = {{0}, {5}}},
                                 .shifting = ShiftingDescription{.gear = gear}});
        drive.go(6);
        ASSERT_EQ(drive.driver.warnings().size(), 1u) << gear;
        EXPECT_THAT(drive.driver.warnings()[0], testing::HasSubstr("the target speed of 5 m/s was ")) << gear;
    }
}

TEST(SpeedControl, ReportsLostSpeedInNeutral) {
    PoweredCar car;
    car.speed = 10;
    PoweredDrive drive(
        car, {.speed = SpeedControlDescription{.speed = {{0}, {10}}}, .shifting = ShiftingDescription{.gear = 0}});
    drive.go(8);
    ASSERT_EQ(drive.driver.warnings().size(), 1u);
    EXPECT_THAT(drive.driver.warnings()[0], testing::HasSubstr("10 m/s was out of reach"));
}

TEST(SpeedControl, ReportsAnUnattainableSpeed) {
    PoweredCar car;
    car.speed = 30;
    PoweredDrive drive(
        car, {.speed = SpeedControlDescription{.speed = {{0}, {80}}}, .shifting = ShiftingDescription{.gear = 5}});
    drive.go(5);
    EXPECT_THAT(drive.driver.warnings(), testing::ElementsAre(testing::HasSubstr("80 m/s was not reached in time")));
    drive.go(100);
    ASSERT_EQ(drive.driver.warnings().size(), 1u);
    EXPECT_THAT(drive.driver.warnings()[0], testing::HasSubstr("80 m/s was out of reach: the car reached "));
    EXPECT_EQ(drive.value(Control::throttle), 1);
}

// The integral has not wound up after a long time at full throttle.
TEST(SpeedControl, DoesNotWindUp) {
    PoweredCar car;
    car.speed = 30, car.grade = 0.25;
    PoweredDrive drive(car, holding({{0, 20, 20.1}, {30, 30, 20}, Interpolation::linear}));
    drive.go(20);
    EXPECT_LT(drive.car.speed, 29);
    drive.car.speed = 22, drive.car.grade = 0;
    double slowest = 30;
    drive.go(20, [&] { slowest = std::min(slowest, drive.car.speed); });
    EXPECT_NEAR(drive.car.speed, 20, 0.05);
    EXPECT_GT(slowest, 19);
}

}  // namespace
}  // namespace hamilcar
