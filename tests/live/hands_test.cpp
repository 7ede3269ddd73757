// Hands and feet: whatever is held, the rack moves as one piece, within bounds, the same to either side.
#include "hamilcar/live/hands.hpp"

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

Hands hands_of(const DrivenCar& driven, double h = step) {
    return Hands(driven, column(), 0, h);
}

// Inputs of consecutive steps, with the speed felt all the time.
std::vector<Input<double>> drive(Hands& hands, int steps, const std::function<Controls(int)>& held, Felt felt = {},
                                 double h = step) {
    std::vector<Input<double>> inputs;
    for (int i = 0; i < steps; ++i) inputs.push_back(hands.next(held(i), felt, h * i));
    return inputs;
}

std::function<Controls(int)> always(const Controls& controls) {
    return [controls](int) { return controls; };
}

// Keys and axes thrown about at random.
std::function<Controls(int)> wild(unsigned seed, double sign = 1) {
    auto random = std::make_shared<std::mt19937>(seed);
    auto held = std::make_shared<Controls>();
    return [=](int i) {
        std::uniform_real_distribution<double> any(-1, 1);
        if (i % 37 == 0) {
            *held = {any(*random) > 0 ? Device::keys : Device::axes, 0, std::abs(any(*random)), std::abs(any(*random)),
                     any(*random) > 0 ? Selector::reverse : Selector::drive};
            held->steer = sign * (any(*random) > 0 ? any(*random) : std::copysign(1.0, any(*random)));
        }
        return *held;
    };
}

TEST(Hands, EveryStepContinuesTheLast) {
    for (const double h : {1e-3, 1e-2}) {
        Hands hands = hands_of(car, h);
        const auto inputs = drive(hands, 20000, wild(1), {.speed = 5}, h);
        for (std::size_t i = 1; i < inputs.size(); ++i) {
            const RackMotion<double>&a = inputs[i - 1].rack, &b = inputs[i].rack;
            ASSERT_NEAR(b.displacement, a.displacement + h * a.rate + h * h / 2 * a.acceleration, 1e-15) << i;
            ASSERT_NEAR(b.rate, a.rate + h * a.acceleration, 1e-13) << i;
        }
    }
}

TEST(Hands, StayWithinTheirBounds) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        for (const double h : {1e-4, 1e-3, 1e-2}) {
            Hands hands = hands_of(car, h);
            for (const Input<double>& input : drive(hands, 5000, wild(seed), {.speed = 5}, h)) {
                ASSERT_LE(std::abs(input.rack.displacement / rack_per_angle), car.lock * (1 + 1e-9));
                ASSERT_LE(std::abs(input.rack.rate / rack_per_angle), 1500 * degree * (1 + 1e-9));
                ASSERT_GE(input.brake, 0);
                ASSERT_LE(input.brake, 1);
            }
        }
    }
}

TEST(Hands, GoToWhereTheyAreWantedWithoutOvershootAndReturn) {
    for (const Device device : {Device::keys, Device::axes}) {
        Hands hands = hands_of(car);
        double most = 0;
        for (const auto& input : drive(hands, 4000, always({.device = device, .steer = 0.25}))) {
            most = std::max(most, input.rack.displacement);
        }
        EXPECT_NEAR(most, 0.25 * car.lock * rack_per_angle, 1e-6);
        const auto back = drive(hands, 4000, always({.device = device}));
        EXPECT_NEAR(back.back().rack.displacement, 0, 1e-6);
        EXPECT_GT(back.back().rack.displacement, -1e-6);
    }
}

TEST(Hands, AreTheSameToEitherSide) {
    Hands left = hands_of(car), right = hands_of(car);
    const auto a = drive(left, 5000, wild(7, 1), {.speed = 8}), b = drive(right, 5000, wild(7, -1), {.speed = 8});
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i].rack.displacement, -b[i].rack.displacement);
}

TEST(Hands, OnKeysReachLessFarTheFasterTheCarIs) {
    double before = car.lock * rack_per_angle * (1 + 1e-9);
    for (const double speed : {0.0, 5.0, 10.0, 20.0, 40.0}) {
        Hands keys = hands_of(car), axes = hands_of(car);
        const Felt felt{.speed = speed};
        const double there = drive(keys, 5000, always({.steer = 1}), felt).back().rack.displacement;
        EXPECT_LE(there, before);
        before = there;
        const double steer = there / rack_per_angle * car.wheels_per_angle;  // of the wheels
        EXPECT_LE(speed * speed * steer / car.wheelbase, 0.81 * 9.81) << speed;
        const auto full = drive(axes, 5000, always({.device = Device::axes, .steer = 1}), felt);
        EXPECT_NEAR(full.back().rack.displacement, car.lock * rack_per_angle, 1e-6);
    }
}

TEST(Feet, PressAndLiftAtBoundedRates) {
    Hands hands = hands_of(car);
    const auto down = drive(hands, 1000, always({.throttle = 1, .brake = 1}));
    for (std::size_t i = 1; i < down.size(); ++i) ASSERT_LE(down[i].brake - down[i - 1].brake, 2.5 * step + 1e-12);
    EXPECT_NEAR(down.back().brake, 1, 1e-3);
    EXPECT_NEAR(down.back().drive_torque, 4 * car.mass * car.wheel_radius, 10);
    const auto up = drive(hands, 1000, always({}));
    EXPECT_NEAR(up.back().brake, 0, 1e-3);
    EXPECT_NEAR(up.back().drive_torque, 0, 5);
}

TEST(Feet, HaveAnEngineOfBoundedPowerAndSpeed) {
    const auto torque = [](const Felt& felt, bool reverse) {
        Hands hands = hands_of(car);
        const Selector selector = reverse ? Selector::reverse : Selector::drive;
        drive(hands, 10, always({.selector = selector}));  // into gear
        return drive(hands, 2000, always({.throttle = 1, .selector = selector}), felt).back().drive_torque;
    };
    const Felt fast{.speed = 40, .spin = 40 / car.wheel_radius};
    EXPECT_NEAR(torque(fast, false) * fast.spin, 45 * car.mass, 200);
    EXPECT_EQ(torque({.speed = 0, .spin = 71 / car.wheel_radius}, false), 0);  // wheels that spin freely
    EXPECT_LT(torque({}, true), -1000);
    EXPECT_EQ(torque({.speed = -9, .spin = -9 / car.wheel_radius}, true), 0);  // 32 km/h
}

TEST(Feet, DoNotShiftIntoReverseAtSpeed) {
    Hands hands = hands_of(car);
    const auto inputs =
        drive(hands, 2000, always({.throttle = 1, .selector = Selector::reverse}), {.speed = 10, .spin = 30});
    for (const auto& input : inputs) ASSERT_EQ(input.drive_torque, 0);
    EXPECT_LT(drive(hands, 500, always({.throttle = 1, .selector = Selector::reverse})).back().drive_torque, -100);
}

TEST(Hands, OfACarWithoutSteeringOrEngineRest) {
    DrivenCar trolley;
    trolley.mass = 1000;
    Hands hands(trolley, Column(), 0, step);
    for (const auto& input : drive(hands, 1000, wild(3))) {
        ASSERT_EQ(input.rack.displacement, 0);
        ASSERT_EQ(input.drive_torque, 0);
    }
}

// A ratio that varies, or a rack that works the other way round: still one motion, to the left.
TEST(Hands, TurnTheRackThroughItsColumn) {
    SteeringDescription steering{.rack_per_revolution = 0.04, .rack_travel = 0.08};
    steering.angle = {0, 2, 5, 12}, steering.rack = {0, 0.012, 0.035, 0.1};
    const Column varying(steering);
    DrivenCar other = car;
    other.wheels_per_angle = -car.wheels_per_angle;
    for (const DrivenCar& driven : {car, other}) {
        Hands hands(driven, varying, 0, step);
        const auto inputs = drive(hands, 8000, wild(5), {.speed = 3});
        for (std::size_t i = 1; i < inputs.size(); ++i) {
            const RackMotion<double>&a = inputs[i - 1].rack, &b = inputs[i].rack;
            ASSERT_NEAR(b.displacement, a.displacement + step * (a.rate + step / 2 * a.acceleration), 1e-6) << i;
            ASSERT_NEAR(b.rate, a.rate + step * a.acceleration, 1e-3) << i;
        }
        hands.let_go();
        const double left = drive(hands, 4000, always({.device = Device::axes, .steer = 0.5})).back().rack.displacement;
        EXPECT_NEAR(std::abs(left), varying.rack(0.5 * car.lock).displacement, 1e-6);
        EXPECT_EQ(left > 0, driven.wheels_per_angle > 0);
    }
}

// By the linkages of every shipped car: ratios are those of cars.
TEST(Hands, KnowEveryShippedCar) {
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
