// The complete driver: every end condition with its reason, a complete memory, no allocation, continuous controls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "driver/powered_car.hpp"
#include "driver/single_track.hpp"
#include "support/allocation_guard.hpp"

namespace hamilcar {
namespace {

using test::PoweredCar;
using test::PoweredDrive;
using test::SingleTrack;

const PathDescription bend{.points = {{0, 0}, {40, 0}, {80, 10}, {120, 40}, {150, 90}}};

// All functions together: a path, a varying speed, gears.
struct WholeDrive {
    PoweredCar powered;
    SingleTrack track;
    Schedule schedule{{}, {}};
    Driver driver;
    int step = 0;

    WholeDrive() : driver(description(), known(), SingleTrack::column()) {
        powered.speed = 4;
        driver.begin(schedule);
    }
    static DriverDescription description() {
        return {.steering = PathFollowerDescription{.path = bend},
                .speed = SpeedControlDescription{.speed = {{0, 8, 9, 14}, {4, 22, 22, 6}}},
                .shifting = ShiftingDescription{},
                .ending = {.path_offset = 5.0}};
    }
    DrivenCar known() const {
        DrivenCar car = powered.known();
        const DrivenCar steered = track.known();
        car.wheelbase = steered.wheelbase, car.center_behind = steered.center_behind, car.lock = steered.lock;
        car.wheels_per_angle = steered.wheels_per_angle;
        return car;
    }
    Observation observation() const {
        const double time = step * PoweredDrive::h;
        Observation out = powered.observation(schedule, time), beside = track.observation(time);
        out.x = beside.x, out.y = beside.y, out.yaw = beside.yaw;
        out.lateral_velocity = beside.lateral_velocity, out.yaw_rate = beside.yaw_rate;
        return out;
    }
    // Calls `after_step` after every step.
    template <class AfterStep>
    void go(int steps, AfterStep&& after_step) {
        for (const int end = step + steps; step < end; ++step) {
            if (step % PoweredDrive::interval == 0) driver.act(observation(), schedule);
            const double time = step * PoweredDrive::h;
            const SignalValue<double> rack = schedule.signal(Control::rack).at(time);
            track.rack = rack.value, track.rack_rate = rack.rate, track.speed = powered.speed;
            track.step(rack.acceleration, PoweredDrive::h);
            powered.step(schedule, time, PoweredDrive::h);
            after_step();
        }
    }
};

TEST(Driver, DrivesAlongABendThroughTheGears) {
    WholeDrive drive;
    int highest = 0;
    drive.go(55000, [&] {
        highest = std::max(highest, static_cast<int>(drive.schedule.signal(Control::gear).at(drive.step * 2e-4).value));
    });
    EXPECT_GE(highest, 3);
    EXPECT_GT(drive.driver.place().station, 100);
    EXPECT_THAT(drive.driver.warnings(), testing::IsEmpty());
    EXPECT_EQ(drive.driver.end_reason(), std::nullopt);
}

TEST(Driver, MovesAllControlsContinuously) {
    WholeDrive drive;
    drive.go(1, [] {});
    const std::array controls{Control::rack, Control::throttle, Control::brake, Control::clutch};
    std::array<double, 4> before{};
    double rack_rate = 0, worst = 0, rate_jump = 0;
    drive.go(60000, [&] {
        const double time = (drive.step + 1) * 2e-4;  // end of the step, which still belongs to the last decision
        for (std::size_t i = 0; i < controls.size(); ++i) {
            const double start = drive.schedule.signal(controls[i]).at(time - 2e-4).value;
            if (drive.step % PoweredDrive::interval == 0) worst = std::max(worst, std::abs(start - before[i]));
            before[i] = drive.schedule.signal(controls[i]).at(time).value;
        }
        const double start = drive.schedule.signal(Control::rack).at(time - 2e-4).rate;
        if (drive.step % PoweredDrive::interval == 0 && drive.step > 25)
            rate_jump = std::max(rate_jump, std::abs(start - rack_rate));
        rack_rate = drive.schedule.signal(Control::rack).at(time).rate;
    });
    EXPECT_LT(worst, 1e-11);
    EXPECT_LT(rate_jump, 1e-11);
}

// A driver resumed from its memory and controls continues bit for bit; a memory from another time does not.
TEST(Driver, RemembersEverything) {
    for (const int stop : {1, 777, 10012, 25003, 45001}) {
        WholeDrive whole;
        whole.go(stop, [] {});
        const DriverMemory memory = whole.driver.memory();
        Schedule::Memory controls{};
        whole.schedule.save(controls);
        WholeDrive rest;
        rest.powered = whole.powered, rest.track = whole.track, rest.step = whole.step;
        rest.driver.restore(memory), rest.schedule.restore(controls);
        whole.go(8000, [] {}), rest.go(8000, [] {});
        EXPECT_EQ(whole.powered.speed, rest.powered.speed) << stop;
        EXPECT_EQ(whole.powered.rotor, rest.powered.rotor) << stop;
        EXPECT_EQ(whole.track.y, rest.track.y) << stop;
        EXPECT_EQ(whole.track.rack, rest.track.rack) << stop;
        EXPECT_EQ(whole.driver.memory().speed.integral, rest.driver.memory().speed.integral) << stop;
    }
}

TEST(Driver, AllocatesNothing) {
    WholeDrive drive;
    drive.go(1, [] {});
    const test::AllocationGuard guard;
    drive.go(20000, [] {});
    EXPECT_EQ(guard.allocations(), 0);
}

std::string end(const EndingDescription& ending, const Observation& last, const Observation& first = {.speed = 20}) {
    const DriverDescription description{.steering = PathFollowerDescription{.path = bend}, .ending = ending};
    Driver driver(description, SingleTrack().known(), SingleTrack::column());
    Schedule schedule({}, {});
    driver.begin(schedule);
    driver.act(first, schedule);
    for (int i = 1; i <= 200; ++i) {
        Observation now = last;
        now.time = 0.005 * i;
        now.x = first.x + (last.x - first.x) * i / 200, now.y = first.y + (last.y - first.y) * i / 200;
        driver.act(now, schedule);
    }
    return driver.end_reason().value_or("none");
}

TEST(Driver, ReportsWhyTheRunEnded) {
    const Observation still{.speed = 20};
    EXPECT_EQ(end({}, still), "none");
    EXPECT_EQ(end({.speed_below = 2}, {.speed = 1}), "speed fell below 2 m/s at 0.005 s");
    EXPECT_EQ(end({.speed_below = 2, .earliest = 0.5}, {.speed = 1}), "speed fell below 2 m/s at 0.5 s");
    EXPECT_EQ(end({.speed_above = 25}, {.speed = 26}), "speed reached 26 m/s at 0.005 s");
    EXPECT_EQ(end({.distance = 10}, {.x = 20, .speed = 20}), "distance reached 10 m at 0.5 s");
    EXPECT_EQ(end({.station = 15}, {.x = 20, .speed = 20}), "reached 15.1 m along the path at 0.755 s");
    EXPECT_THAT(end({.path_offset = 0.5}, {.y = -1, .speed = 20}), testing::HasSubstr("left the path by 0.5"));
    EXPECT_THAT(end({.lateral_acceleration = 8}, {.speed = 20, .yaw_rate = -0.5}),
                testing::HasSubstr("lateral acceleration reached 8."));
    EXPECT_EQ(end({.lateral_acceleration = 12}, {.speed = 20, .yaw_rate = -0.5}), "none");
    EXPECT_EQ(end({.roll = 0.5}, {.roll = -0.6, .speed = 20}), "roll angle reached 34.38 deg at 0.005 s");
}

TEST(Driver, WarnsAboutALargePathOffset) {
    Driver driver({.steering = PathFollowerDescription{.path = bend}}, SingleTrack().known(), SingleTrack::column());
    Schedule schedule({}, {});
    driver.act({.x = 10, .y = 2, .speed = 20}, schedule);
    EXPECT_THAT(driver.warnings(), testing::ElementsAre(testing::StartsWith("the car was up to 2")));
}

TEST(Driver, WithoutTasksLeavesTheScheduleUnchanged) {
    EXPECT_FALSE(Driver().is_active());
    EXPECT_FALSE(Driver({}, {}, Column()).is_active());
    EXPECT_THROW(Driver({.ending = {.station = 4.0}}, {}, Column()), std::invalid_argument);
    Driver driver({.ending = {.speed_below = 1.0}}, {}, Column());
    ScenarioDescription scenario;
    scenario.brake = {{0, 1}, {0, 0.5}};
    Schedule schedule(scenario, {});
    EXPECT_TRUE(driver.is_active());
    driver.begin(schedule);
    driver.act({.speed = 5}, schedule);
    EXPECT_EQ(schedule.signal(Control::brake).at(1).value, 0.5);
}

}  // namespace
}  // namespace hamilcar
