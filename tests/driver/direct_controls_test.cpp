// Controls as numbers: they arrive where and when they are told to, without a jump that would hit the car.
#include "hamilcar/driver/direct_controls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "hamilcar/driver/driver.hpp"
#include "powered_car.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

struct Controlled {
    VehicleDescription vehicle = test::shipped_car();
    ScenarioDescription scenario = test::scenario(5);
    Schedule schedule{scenario, vehicle.steering};
    DirectControls controls{vehicle, scenario, schedule};

    explicit Controlled(const ScenarioDescription& of = test::scenario(5)) : scenario(of) {
        schedule = Schedule(scenario, vehicle.steering);
        controls = DirectControls(vehicle, scenario, schedule);
    }
    std::vector<std::string> names() const {
        std::vector<std::string> out;
        for (const auto& one : controls.list()) out.emplace_back(one.name);
        return out;
    }
    std::size_t place(std::string_view name) const {
        std::size_t i = 0;
        while (controls.list()[i].name != name) ++i;
        return i;
    }
    SignalValue<double> rack(double time) const { return schedule.signal(Control::rack).at(time); }
};

TEST(DirectControls, AreWhatTheCarListensTo) {
    EXPECT_THAT(Controlled().names(), testing::ElementsAre("steering_wheel", "drive_torque", "brake"));
    ScenarioDescription powered = test::scenario(5);
    powered.throttle = {{0}, {0}};
    EXPECT_THAT(Controlled(powered).names(),
                testing::ElementsAre("steering_wheel", "throttle", "brake", "clutch", "gear"));
    powered.driver.shifting.emplace();
    EXPECT_THAT(Controlled(powered).names(), testing::ElementsAre("steering_wheel", "throttle", "brake"));
    powered.driver.speed.emplace();
    EXPECT_THAT(Controlled(powered).names(), testing::ElementsAre("steering_wheel"));
    ScenarioDescription windy = test::scenario(5);
    windy.wind_x = {{0}, {1}};
    EXPECT_THAT(Controlled(windy).names(), testing::Contains("wind_y"));
}

TEST(DirectControls, TurnTheSteeringFromRestToRest) {
    Controlled car;
    const std::size_t wheel = car.place("steering_wheel");
    const double per_angle = car.vehicle.steering.rack_per_revolution / (2 * std::numbers::pi);
    car.controls.move(wheel, 0.5, {1.0, 20, 1e-3}, car.schedule, nullptr);
    EXPECT_NEAR(car.rack(1.0).value, 0, 1e-15);
    EXPECT_NEAR(car.rack(1.0).rate, 0, 1e-15);
    EXPECT_NEAR(car.rack(1.01).value, 0.25 * per_angle, 1e-12);
    EXPECT_NEAR(car.rack(1.01).rate, 1.5 * 0.5 * per_angle / 0.02, 1e-9);
    EXPECT_NEAR(car.rack(1.02).value, 0.5 * per_angle, 1e-12);
    EXPECT_NEAR(car.rack(1.02).rate, 0, 1e-9);
    car.controls.hold(wheel, 0.5, 1.02, car.schedule, nullptr);
    for (const double time : {1.02, 1.03, 50.0}) EXPECT_EQ(car.controls.value(wheel, time, car.schedule), 0.5) << time;
    car.controls.move(wheel, -0.5, {1.02, 20, 1e-3}, car.schedule, nullptr);
    EXPECT_NEAR(car.rack(1.02).value, 0.5 * per_angle, 1e-15);
    EXPECT_NEAR(car.controls.value(wheel, 1.03, car.schedule), 0, 1e-12);
}

TEST(DirectControls, TurnTheSteeringEvenlyFromStepToStep) {
    Controlled car;
    const std::size_t wheel = car.place("steering_wheel");
    const double per_angle = car.vehicle.steering.rack_per_revolution / (2 * std::numbers::pi);
    for (int i = 0; i < 10; ++i) {
        const double time = 1e-3 * i;
        car.controls.move(wheel, 0.01 * (i + 1), {time, 1, 1e-3}, car.schedule, nullptr);
        EXPECT_NEAR(car.rack(time).rate, 10 * per_angle, 1e-9);
        EXPECT_NEAR(car.rack(time).value, 0.01 * i * per_angle, 1e-12);
        car.controls.hold(wheel, 0.01 * (i + 1), time + 1e-3, car.schedule, nullptr);
    }
}

TEST(DirectControls, MovePedalsEvenlyAndGearsAtOnce) {
    ScenarioDescription powered = test::scenario(5);
    powered.throttle = {{0}, {0}};
    Controlled car(powered);
    car.controls.move(car.place("throttle"), 0.8, {2, 100, 1e-3}, car.schedule, nullptr);
    car.controls.move(car.place("gear"), 3, {2, 100, 1e-3}, car.schedule, nullptr);
    EXPECT_NEAR(car.schedule(2.025).throttle, 0.2, 1e-12);
    EXPECT_NEAR(car.schedule(2.1).throttle, 0.8, 1e-12);
    EXPECT_EQ(car.schedule(2).gear, 3);
    const auto& gear = car.controls.list()[car.place("gear")];
    EXPECT_EQ(gear.min, -1);
    EXPECT_EQ(gear.max, 5);
}

TEST(DirectControls, KeepWithinTheRacksStops) {
    const Controlled car;
    const DirectControls::Entry& wheel = car.controls.list()[car.place("steering_wheel")];
    const double turns = car.vehicle.steering.rack_travel / car.vehicle.steering.rack_per_revolution;
    EXPECT_NEAR(wheel.max, 2 * std::numbers::pi * turns, 1e-9);
    EXPECT_EQ(wheel.min, -wheel.max);
}

// The driver who shifts gives as much throttle as is asked for, and takes it away while a gear changes.
TEST(DirectControls, AskTheDriverWhoShiftsForTheThrottle) {
    ScenarioDescription scenario;
    scenario.throttle = {{0}, {0}};
    scenario.driver.shifting.emplace();
    test::PoweredDrive drive(test::PoweredCar{}, scenario.driver, scenario);
    drive.go(1);
    EXPECT_EQ(drive.value(Control::throttle), 0);
    const DirectControls controls(test::shipped_car(), scenario, drive.schedule);
    const std::size_t throttle = 1;
    ASSERT_EQ(controls.list()[throttle].name, "throttle");
    bool cut = false;
    for (int i = 0; i < 600; ++i) {  // asked again and again, as by a controller: a gear change goes on all the same
        controls.move(throttle, 0.6, {drive.time(), 20, 1e-3}, drive.schedule, &drive.driver);
        drive.go(0.02, [&] { cut = cut || drive.value(Control::throttle) < 0.1; });
        controls.hold(throttle, 0.6, drive.time(), drive.schedule, &drive.driver);
        if (i == 50) cut = false;  // the start
    }
    EXPECT_NEAR(drive.value(Control::throttle), 0.6, 1e-9);
    EXPECT_GT(drive.value(Control::gear), 1);
    EXPECT_GT(drive.car.speed, 10);
    EXPECT_TRUE(cut);
}

}  // namespace
}  // namespace hamilcar
