// Steering and pedals: for any controls the rack motion is continuous, within limits and symmetric.
#include "hamilcar/live/control_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "support/fleet.hpp"

namespace hamilcar::live {
namespace {

constexpr double degree = std::numbers::pi / 180, step = 1e-3;
constexpr double rack_per_angle = 0.0058;  // [m/rad]
const DrivenCar car = [] {
    DrivenCar driven;
    driven.lock = 720 * degree;
    driven.wheels_per_angle = 1 / 20.0;
    driven.wheelbase = 2.57;
    driven.mass = 1150;
    driven.wheel_radius = 0.3;
    return driven;
}();

Column column(double per_angle = rack_per_angle) {
    return Column({.rack_per_revolution = 2 * std::numbers::pi * per_angle});
}

ControlFilter filter_for(const DrivenCar& driven, double h = step) {
    return ControlFilter(driven, column(), 0, h);
}

// Inputs of consecutive steps at constant measured speeds.
std::vector<Input<double>> drive(ControlFilter& filter, int steps, const std::function<Controls(int)>& controls,
                                 MeasuredSpeeds speeds = {}, double h = step) {
    std::vector<Input<double>> inputs;
    for (int i = 0; i < steps; ++i) inputs.push_back(filter.next(controls(i), speeds, h * i));
    return inputs;
}

std::function<Controls(int)> constant(const Controls& controls) {
    return [controls](int) { return controls; };
}

// Random keys and axes.
std::function<Controls(int)> random_controls(unsigned seed, double sign = 1) {
    auto random = std::make_shared<std::mt19937>(seed);
    auto controls = std::make_shared<Controls>();
    return [=](int i) {
        std::uniform_real_distribution<double> any(-1, 1);
        if (i % 37 == 0) {
            *controls = {any(*random) > 0 ? Device::keys : Device::axes, 0, std::abs(any(*random)),
                         std::abs(any(*random)), any(*random) > 0 ? Selector::reverse : Selector::drive};
            controls->steer = sign * (any(*random) > 0 ? any(*random) : std::copysign(1.0, any(*random)));
        }
        return *controls;
    };
}

TEST(ControlFilter, RackMotionIsContinuous) {
    for (const double h : {1e-3, 1e-2}) {
        ControlFilter filter = filter_for(car, h);
        const auto inputs = drive(filter, 20000, random_controls(1), {.speed = 5}, h);
        for (std::size_t i = 1; i < inputs.size(); ++i) {
            const RackMotion<double>&a = inputs[i - 1].rack, &b = inputs[i].rack;
            ASSERT_NEAR(b.displacement, a.displacement + h * a.rate + h * h / 2 * a.acceleration, 1e-15) << i;
            ASSERT_NEAR(b.rate, a.rate + h * a.acceleration, 1e-13) << i;
        }
    }
}

TEST(ControlFilter, StaysWithinLimits) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        for (const double h : {1e-4, 1e-3, 1e-2}) {
            ControlFilter filter = filter_for(car, h);
            for (const Input<double>& input : drive(filter, 5000, random_controls(seed), {.speed = 5}, h)) {
                ASSERT_LE(std::abs(input.rack.displacement / rack_per_angle), car.lock * (1 + 1e-9));
                ASSERT_LE(std::abs(input.rack.rate / rack_per_angle), 1500 * degree * (1 + 1e-9));
                ASSERT_GE(input.brake, 0);
                ASSERT_LE(input.brake, 1);
            }
        }
    }
}

TEST(ControlFilter, ReachesTargetWithoutOvershootAndReturns) {
    for (const Device device : {Device::keys, Device::axes}) {
        ControlFilter filter = filter_for(car);
        double most = 0;
        for (const auto& input : drive(filter, 4000, constant({.device = device, .steer = 0.25}))) {
            most = std::max(most, input.rack.displacement);
        }
        EXPECT_NEAR(most, 0.25 * car.lock * rack_per_angle, 1e-6);
        const auto back = drive(filter, 4000, constant({.device = device}));
        EXPECT_NEAR(back.back().rack.displacement, 0, 1e-6);
        EXPECT_GT(back.back().rack.displacement, -1e-6);
    }
}

TEST(ControlFilter, IsSymmetric) {
    ControlFilter left = filter_for(car), right = filter_for(car);
    const auto a = drive(left, 5000, random_controls(7, 1), {.speed = 8}),
               b = drive(right, 5000, random_controls(7, -1), {.speed = 8});
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].rack.displacement, -b[i].rack.displacement);
}

TEST(ControlFilter, KeysLimitAngleWithSpeed) {
    double before = car.lock * rack_per_angle * (1 + 1e-9);
    for (const double speed : {0.0, 5.0, 10.0, 20.0, 40.0}) {
        ControlFilter keys = filter_for(car), axes = filter_for(car);
        const MeasuredSpeeds speeds{.speed = speed};
        const double there = drive(keys, 5000, constant({.steer = 1}), speeds).back().rack.displacement;
        EXPECT_LE(there, before);
        before = there;
        const double steer = there / rack_per_angle * car.wheels_per_angle;  // of the wheels
        EXPECT_LE(speed * speed * steer / car.wheelbase, 0.81 * 9.81) << speed;
        const auto full = drive(axes, 5000, constant({.device = Device::axes, .steer = 1}), speeds);
        EXPECT_NEAR(full.back().rack.displacement, car.lock * rack_per_angle, 1e-6);
    }
}

TEST(PedalInput, IsRateLimited) {
    ControlFilter filter = filter_for(car);
    const auto down = drive(filter, 1000, constant({.throttle = 1, .brake = 1}));
    for (std::size_t i = 1; i < down.size(); ++i) ASSERT_LE(down[i].brake - down[i - 1].brake, 2.5 * step + 1e-12);
    EXPECT_NEAR(down.back().brake, 1, 1e-3);
    EXPECT_NEAR(down.back().drive_torque, 4 * car.mass * car.wheel_radius, 10);
    const auto up = drive(filter, 1000, constant({}));
    EXPECT_NEAR(up.back().brake, 0, 1e-3);
    EXPECT_NEAR(up.back().drive_torque, 0, 5);
}

TEST(PedalInput, DriveTorqueIsLimitedByPowerAndSpeed) {
    const auto torque = [](const MeasuredSpeeds& speeds, bool reverse) {
        ControlFilter filter = filter_for(car);
        const Selector selector = reverse ? Selector::reverse : Selector::drive;
        drive(filter, 10, constant({.selector = selector}));  // into gear
        return drive(filter, 2000, constant({.throttle = 1, .selector = selector}), speeds).back().drive_torque;
    };
    const MeasuredSpeeds fast{.speed = 40, .spin = 40 / car.wheel_radius};
    EXPECT_NEAR(torque(fast, false) * fast.spin, 45 * car.mass, 200);
    EXPECT_EQ(torque({.speed = 0, .spin = 71 / car.wheel_radius}, false), 0);  // wheels that spin freely
    EXPECT_LT(torque({}, true), -1000);
    EXPECT_EQ(torque({.speed = -9, .spin = -9 / car.wheel_radius}, true), 0);  // 32 km/h
}

TEST(PedalInput, DoesNotReverseAtSpeed) {
    ControlFilter filter = filter_for(car);
    const auto inputs =
        drive(filter, 2000, constant({.throttle = 1, .selector = Selector::reverse}), {.speed = 10, .spin = 30});
    for (const auto& input : inputs) ASSERT_EQ(input.drive_torque, 0);
    EXPECT_LT(drive(filter, 500, constant({.throttle = 1, .selector = Selector::reverse})).back().drive_torque, -100);
}

TEST(ControlFilter, IsZeroWithoutSteeringOrDrive) {
    DrivenCar trolley;
    trolley.mass = 1000;
    ControlFilter filter(trolley, Column(), 0, step);
    for (const auto& input : drive(filter, 1000, random_controls(3))) {
        ASSERT_EQ(input.rack.displacement, 0);
        ASSERT_EQ(input.drive_torque, 0);
    }
}

// With a variable ratio or a reversed rack the motion is still continuous and to the same side.
TEST(ControlFilter, FollowsVariableSteeringRatio) {
    SteeringDescription steering{.rack_per_revolution = 0.04, .rack_travel = 0.08};
    steering.angle = {0, 2, 5, 12}, steering.rack = {0, 0.012, 0.035, 0.1};
    const Column varying(steering);
    DrivenCar other = car;
    other.wheels_per_angle = -car.wheels_per_angle;
    for (const DrivenCar& driven : {car, other}) {
        ControlFilter filter(driven, varying, 0, step);
        const auto inputs = drive(filter, 8000, random_controls(5), {.speed = 3});
        for (std::size_t i = 1; i < inputs.size(); ++i) {
            const RackMotion<double>&a = inputs[i - 1].rack, &b = inputs[i].rack;
            ASSERT_NEAR(b.displacement, a.displacement + step * (a.rate + step / 2 * a.acceleration), 1e-6) << i;
            ASSERT_NEAR(b.rate, a.rate + step * a.acceleration, 1e-3) << i;
        }
        filter.reset();
        const double left =
            drive(filter, 4000, constant({.device = Device::axes, .steer = 0.5})).back().rack.displacement;
        EXPECT_NEAR(std::abs(left), varying.rack(0.5 * car.lock).displacement, 1e-6);
        EXPECT_EQ(left > 0, driven.wheels_per_angle > 0);
    }
}

// Ratios derived from the linkages of every shipped car are realistic.
TEST(ControlFilter, ShippedCarsHavePlausibleData) {
    for (const std::string& name : test::fleet()) {
        const Simulation simulation(test::shipped(name), test::scenario(1));
        const DrivenCar& driven = simulation.driven_car();
        const double ratio = 1 / std::abs(driven.wheels_per_angle);
        EXPECT_GT(ratio, 3) << name;
        EXPECT_LT(ratio, 30) << name;
        EXPECT_GT(driven.wheelbase, 1.5) << name;
        EXPECT_LT(driven.wheelbase, 6) << name;
        EXPECT_GT(driven.lock, 90 * degree) << name;
        EXPECT_GT(driven.mass, 200) << name;
        EXPECT_GT(driven.wheel_radius, 0.2) << name;
    }
}

}  // namespace
}  // namespace hamilcar::live
