// Gears and clutch: launches without stalling or overspeed, gears in sequence, no hunting.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "driver/powered_car.hpp"

namespace hamilcar {
namespace {

using test::PoweredCar;
using test::PoweredDrive;
using testing::ElementsAre;

ScenarioDescription with_throttle(double throttle) {
    ScenarioDescription scenario;
    scenario.throttle = {{0}, {throttle}};
    return scenario;
}

// Engaged gears in order.
std::vector<int> gears(PoweredDrive& drive, double duration) {
    std::vector<int> out;
    drive.go(duration, [&] {
        const double gear = drive.value(Control::gear);
        if (gear == std::round(gear) && (out.empty() || out.back() != gear)) out.push_back(static_cast<int>(gear));
    });
    return out;
}

TEST(Shifting, GoesThroughTheGearsAtFullThrottle) {
    for (const bool automatic : {false, true}) {
        PoweredCar car;
        car.gearbox.automatic = automatic;
        if (automatic) car.speed = 8;  // without a converter or a slipping clutch it cannot start from rest
        PoweredDrive drive(car, {.shifting = ShiftingDescription{}}, with_throttle(1));
        EXPECT_THAT(gears(drive, 30), ElementsAre(1, 2, 3, 4, 5)) << automatic;
        EXPECT_GT(drive.car.lowest_rotor, 0.9 * car.idle_speed) << automatic << ": stalled";
        EXPECT_LT(drive.car.highest_rotor, 1.05 * car.gearbox.upshift_speed) << automatic << ": overspeed";
        EXPECT_GT(drive.car.speed, 45) << automatic;
    }
}

// For any clutch capacity and throttle.
TEST(Shifting, LaunchesWithoutStallingOrOverspeed) {
    for (const double capacity : {250.0, 400.0, 1000.0}) {
        for (const double throttle : {0.2, 0.5, 1.0}) {
            PoweredCar car;
            car.clutch_capacity = capacity;
            PoweredDrive drive(car, {.shifting = ShiftingDescription{.gear = 1}}, with_throttle(throttle));
            double last = 0, backward = 0, synchronous = -1, fastest = 0;
            drive.go(6, [&] {
                backward = std::max(backward, last - drive.car.speed), last = drive.car.speed;
                const PowerUnitObservation unit = drive.car.observation(drive.schedule, drive.time()).units[0];
                if (synchronous < 0) fastest = std::max(fastest, unit.speed);
                if (synchronous < 0 && unit.speed - unit.shaft_speed < 5) synchronous = drive.time();
            });
            const std::string which = std::to_string(capacity) + " N m, throttle " + std::to_string(throttle);
            EXPECT_GT(drive.car.lowest_rotor, 0.9 * car.idle_speed) << which;
            EXPECT_LT(fastest, throttle < 1 ? 350 : 450) << which;
            EXPECT_LT(backward, 0.01) << which << ": the car jerks";
            EXPECT_LT(synchronous, 5) << which;
            EXPECT_GT(synchronous, 0.1) << which;
            EXPECT_LT(drive.value(Control::clutch), 1e-9) << which;
        }
    }
}

TEST(Shifting, LaunchesAtFullThrottleNearTheLaunchSpeed) {
    PoweredDrive drive({}, {.shifting = ShiftingDescription{}}, with_throttle(1));
    std::vector<double> slipping;
    drive.go(2, [&] {
        const PowerUnitObservation unit = drive.car.observation(drive.schedule, drive.time()).units[0];
        if (drive.time() > 0.4 && unit.speed - unit.shaft_speed > 30) slipping.push_back(unit.speed);
    });
    ASSERT_GT(slipping.size(), 20u);
    EXPECT_GT(*std::ranges::min_element(slipping), 0.4 * 600);
    EXPECT_LT(*std::ranges::max_element(slipping), 0.75 * 600);
}

TEST(Shifting, LaunchesInReverse) {
    PoweredDrive drive({}, {.shifting = ShiftingDescription{.gear = -1}}, with_throttle(0.3));
    drive.go(4);
    EXPECT_LT(drive.car.speed, -2);
    EXPECT_GT(drive.car.lowest_rotor, 75);
}

// Throttle, clutch, lever, clutch: within the shift time, and the lever moves only while the clutch is open.
TEST(Shifting, OperatesAManualGearbox) {
    PoweredCar car;
    car.speed = 10;
    PoweredDrive drive(car, {.shifting = ShiftingDescription{}}, with_throttle(1));
    double begun = -1, ended = -1, throttle_at_lever = 1, gear = 2;
    drive.go(6, [&] {
        const double clutch = drive.value(Control::clutch);
        if (drive.value(Control::throttle) < 1 && begun < 0) begun = drive.time();
        if (drive.value(Control::gear) != gear) {
            gear = drive.value(Control::gear);
            if (begun < 0) return;
            throttle_at_lever = drive.value(Control::throttle);
            EXPECT_GT(clutch, 0.999);
        }
        if (begun > 0 && ended < 0 && drive.time() > begun + 0.2 && clutch == 0 &&
            drive.value(Control::throttle) == 1) {
            ended = drive.time();
        }
    });
    EXPECT_EQ(throttle_at_lever, 0);
    EXPECT_NEAR(ended - begun, 0.5, 0.06);
}

TEST(Shifting, AutomaticGearboxChangesAtAConstantRate) {
    PoweredCar car;
    car.gearbox.automatic = true, car.speed = 14;
    PoweredDrive drive(car, {.shifting = ShiftingDescription{}}, with_throttle(1));
    double last = 0, fastest = 0;
    drive.go(8, [&] {
        const double gear = drive.value(Control::gear);
        if (last > 0) fastest = std::max(fastest, std::abs(gear - last) / 0.005);
        last = gear;
        EXPECT_EQ(drive.value(Control::clutch), 0);
        EXPECT_EQ(drive.value(Control::throttle), 1);
    });
    EXPECT_NEAR(fastest, 1 / car.gearbox.shift_time, 1e-6);
    EXPECT_EQ(last, std::round(last));
}

TEST(Shifting, BrakesDownToAStopInFirstGear) {
    PoweredCar car;
    car.speed = 30;
    ScenarioDescription scenario = with_throttle(0);
    scenario.brake = {{0}, {0.4}};
    PoweredDrive drive(car, {.shifting = ShiftingDescription{}}, scenario);
    const std::vector<int> seen = gears(drive, 12);
    EXPECT_EQ(seen.back(), 1);
    EXPECT_TRUE(std::is_sorted(seen.rbegin(), seen.rend()));
    EXPECT_NEAR(drive.car.speed, 0, 0.05);
    EXPECT_GT(drive.car.lowest_rotor, 0.85 * car.idle_speed);
    EXPECT_EQ(drive.value(Control::clutch), 1);
}

// Accelerating to a speed on various grades: no gear is left and chosen again.
TEST(Shifting, DoesNotHunt) {
    for (const bool automatic : {false, true}) {
        for (const double speed : {9.0, 14.0, 19.0, 24.0, 29.0, 34.0}) {
            for (const double grade : {0.0, 0.03, 0.06}) {
                PoweredCar car;
                car.gearbox.automatic = automatic, car.grade = grade, car.speed = automatic ? 7 : 0;
                DriverDescription description{.speed = SpeedControlDescription{.speed = {{0}, {speed}}},
                                              .shifting = ShiftingDescription{}};
                PoweredDrive drive(car, description);
                drive.go(40);
                const auto seen = gears(drive, 40);
                EXPECT_LE(seen.size(), 2u)
                    << automatic << " " << speed << " m/s, grade " << grade << ": " << testing::PrintToString(seen);
                EXPECT_NEAR(drive.car.speed, speed, 0.02 * speed) << automatic << " grade " << grade;
            }
        }
    }
}

TEST(Shifting, ShiftsDownUphill) {
    PoweredCar car;
    car.speed = 28;
    PoweredDrive drive(car,
                       {.speed = SpeedControlDescription{.speed = {{0}, {28}}}, .shifting = ShiftingDescription{}});
    drive.go(20);
    const double before = drive.value(Control::gear);
    drive.car.grade = 0.12;
    drive.go(20);
    EXPECT_LT(drive.value(Control::gear), before);
    EXPECT_LT(drive.car.highest_rotor, 620);
}

TEST(Shifting, StartsInASuitableGear) {
    const auto first = [](double speed) {
        PoweredCar car;
        car.speed = speed;
        PoweredDrive drive(car, {.shifting = ShiftingDescription{}}, with_throttle(0.2));
        drive.begin();
        return drive.value(Control::gear);
    };
    EXPECT_EQ(first(0), 1);
    EXPECT_EQ(first(5), 1);
    EXPECT_GE(first(15), 2);
    EXPECT_EQ(first(45), 5);
}

TEST(Shifting, DoesNotShiftDownForLockedWheels) {
    PoweredCar car;
    car.speed = 30;
    const Shifting shifting({}, car.known());
    ShiftMemory memory;
    Observation observation{.speed = 30, .gear = 4};
    observation.unit_count = 1;
    const double total = car.ratio(4) * car.final_ratio;
    observation.units[0] = {.speed = 378, .shaft_speed = 378, .wheel_ratio = total};
    for (int i = 0; i < 400; ++i) {
        shifting.decide(observation, 0, 0.005, memory);
        observation.units[0].speed = 85, observation.units[0].shaft_speed = 0;
    }
    EXPECT_GE(memory.gear, 4);
    EXPECT_TRUE(shifting.interrupts(memory)) << "but the clutch is open";
}

std::string mistake(const ShiftingDescription& description, PoweredCar car = {}) {
    try {
        const Shifting shifting(description, car.known());
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

TEST(Shifting, ListsTheExistingGearsInErrors) {
    EXPECT_EQ(mistake({.gear = 6}), "gear 6 does not exist: this vehicle has 5 forward gears and a reverse gear (-1)");
    PoweredCar single;
    single.gearbox.ratios = {1}, single.gearbox.reverse_ratio = 0;
    EXPECT_EQ(mistake({.gear = -1}, single),
              "gear -1 does not exist: this vehicle has one forward gear and no reverse gear");
    EXPECT_EQ(mistake({.gear = 0}, single), "none");
    EXPECT_EQ(mistake({.first_gear = 7}),
              "first gear 7 does not exist: this vehicle has 5 forward gears and a reverse gear (-1)");
    EXPECT_EQ(mistake({.first_gear = -1}), "the first gear must be a forward gear, found -1");
}

TEST(Shifting, IsInactiveWithoutGears) {
    EXPECT_FALSE(Shifting({.gear = 3}, {}).is_active());
    EXPECT_FALSE(Driver({.shifting = ShiftingDescription{}}, {}, Column()).is_active());
}

}  // namespace
}  // namespace hamilcar
