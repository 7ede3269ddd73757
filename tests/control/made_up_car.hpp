// A controller at a car that is made up: wheels turn as a test says, pressures follow the valves, nothing else moves. Rear-wheel drive,
// front wheels steer.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <concepts>

#include "hamilcar/control/kinds.hpp"

namespace hamilcar::test {

enum MadeUpWheel : std::size_t { front_left, front_right, rear_left, rear_right };

// With valves at all wheels and one power unit, for the layout of its commands.
inline VehicleDescription made_up_vehicle() {
    VehicleDescription car;
    car.brakes.exists = car.brakes.modulated = true;
    car.brakes.full_pressure = 1e7;
    car.controllers.emplace_back();
    for (const char* name : {"front_left", "front_right", "rear_left", "rear_right"}) {
        SuspensionDescription& suspension = car.suspensions.emplace_back();
        suspension.wheels.emplace_back().name = name;
        suspension.wheels.back().brake.max_torque = 1;
    }
    car.power_units.emplace_back().name = "engine";
    car.steering.rack_per_revolution = 0.05;
    return car;
}

inline ControlledCar made_up_car() {
    ControlledCar car{.mass = 1600,
                      .yaw_inertia = 2600,
                      .wheelbase = 2.7,
                      .center_behind = 1.3,
                      .wheels_per_angle = 1 / 16.0,
                      .full_pressure = 1e7,
                      .wheels = {},
                      .units = {{.name = "engine"}}};
    for (const bool front : {true, false}) {
        for (const bool left : {true, false}) {
            car.wheels.push_back({.name = std::string(front ? "front_" : "rear_") + (left ? "left" : "right"),
                                  .x = front ? 1.3 : -1.4,
                                  .y = left ? 0.75 : -0.75,
                                  .radius = 0.3,
                                  .spin_inertia = 1.2,
                                  .steered = front,
                                  .driven = !front,
                                  .brake_torque = front ? 2600.0 : 1300.0,
                                  .static_load = 1600 * 9.81 / 4});
        }
    }
    return car;
}

// What the car does at an instant; everything else follows.
struct Doing {
    double speed = 0;                  // [m/s]
    double acceleration = 0;           // forward [m/s^2]
    double yaw_rate = 0, lateral = 0;  // [rad/s], acceleration [m/s^2]
    double steering_wheel = 0;         // [rad]
    double brake = 0, throttle = 0;    // pedals
    double gear = 2;
    std::array<double, 4> slip{};  // of each wheel's tread against the speed of its ground, negative: slower [m/s]

    Doing mirrored() const {
        Doing out = *this;
        out.yaw_rate = -yaw_rate, out.lateral = -lateral, out.steering_wheel = -steering_wheel;
        out.slip = {slip[front_right], slip[front_left], slip[rear_right], slip[rear_left]};
        return out;
    }
};

class MadeUpCar {
public:
    explicit MadeUpCar(const char* kind, const std::vector<std::pair<std::string, double>>& settings = {},
                       double rate = 200)
        : interval_(1 / rate) {
        const ControllerKind& found = *find_controller_kind(kind);
        controller_ = found.make(ControllerSettings(found, {.kind = kind, .rate = rate, .settings = settings}), car_);
        memory_.assign(controller_->memory_size(), 0.0);
    }

    // Decisions for a time [s], each about `doing(time since this call)`.
    template <std::invocable<double> Course>
    void go(double duration, const Course& doing) {
        const long decisions = std::lround(duration / interval_);
        for (long i = 0; i < decisions; ++i) decide(doing(static_cast<double>(i) * interval_));
    }
    void go(double duration, const Doing& doing) {
        go(duration, [&](double) { return doing; });
    }

    BrakeValves valves(std::size_t wheel) { return Commands(layout_, commands_).valves(wheel); }
    bool rests(std::size_t wheel) {
        const BrakeValves at = valves(wheel);
        return at.inlet == 1 && at.outlet == 0 && at.pump == 0;
    }
    bool rests() { return commands_ == layout_.rest(); }
    double max_throttle() { return Commands(layout_, commands_).max_throttle(0); }
    double pressure(std::size_t wheel) const { return pressure_[wheel]; }
    double activity() const { return controller_->activity(memory_); }
    const std::vector<double>& commands() const { return commands_; }

private:
    void decide(const Doing& doing) {
        constexpr double response = 0.02, fill = 0.03, pump_time = 0.3;  // of pressures [s]
        const double full = car_.full_pressure;
        control_ += std::min(interval_ / response, 1.0) * (doing.brake * full - control_);
        for (std::size_t i = 0; i < 4; ++i) {
            const BrakeValves at = valves(i);
            const double in = at.inlet * (control_ - pressure_[i]) / fill, out = at.outlet * pressure_[i] / fill;
            pressure_[i] = std::max(pressure_[i] + interval_ * (in - out + at.pump * full / pump_time), 0.0);
            const ControlledWheel& wheel = car_.wheels[i];
            const double angle = wheel.steered ? doing.steering_wheel * car_.wheels_per_angle : 0;
            const double forward = doing.speed - doing.yaw_rate * wheel.y,
                         left = doing.yaw_rate * (wheel.x + car_.wheelbase - car_.center_behind);
            const double ground = forward * std::cos(angle) + left * std::sin(angle);
            speed_[i] = (ground + doing.slip[i]) / wheel.radius;
        }
        const double rotor[] = {100};
        const Measured measured{.time = time_,
                                .interval = interval_,
                                .steering_wheel = doing.steering_wheel,
                                .brake = doing.brake,
                                .throttle = doing.throttle,
                                .gear = doing.gear,
                                .angular_rate = {0, 0, doing.yaw_rate},
                                .acceleration = {doing.acceleration, doing.lateral, 9.81},
                                .control_pressure = control_,
                                .wheel_speed = speed_,
                                .brake_pressure = pressure_,
                                .rotor_speed = rotor};
        controller_->decide(measured, memory_, Commands(layout_, commands_));
        for (std::size_t i = 0; i < commands_.size(); ++i) {
            EXPECT_GE(commands_[i], layout_.commands()[i].min) << layout_.commands()[i].name;
            EXPECT_LE(commands_[i], layout_.commands()[i].max) << layout_.commands()[i].name;
        }
        time_ += interval_;
    }

    double interval_, time_ = 0, control_ = 0;
    ControlledCar car_ = made_up_car();
    CommandLayout layout_{made_up_vehicle()};
    std::unique_ptr<const Controller> controller_;
    std::vector<double> memory_, commands_ = layout_.rest();
    std::array<double, 4> pressure_{}, speed_{};
};

// A controller that drives through `doing`, and one through its mirror image: the same commands, left and right exchanged.
inline void expect_mirrored(const char* kind, const std::vector<std::pair<std::string, double>>& settings,
                            double duration, const std::function<Doing(double)>& doing) {
    MadeUpCar one(kind, settings), other(kind, settings);
    constexpr double piece = 0.05;  // [s]
    for (double begun = 0; begun < duration; begun += piece) {
        one.go(piece, [&](double t) { return doing(begun + t); });
        other.go(piece, [&](double t) { return doing(begun + t).mirrored(); });
        for (const auto& [left, right] : {std::pair{front_left, front_right}, {rear_left, rear_right}}) {
            for (const auto& [a, b] : {std::pair{left, right}, {right, left}}) {
                EXPECT_NEAR(one.valves(a).inlet, other.valves(b).inlet, 1e-9) << "at " << begun << ", wheel " << a;
                EXPECT_NEAR(one.valves(a).outlet, other.valves(b).outlet, 1e-9) << "at " << begun << ", wheel " << a;
                EXPECT_NEAR(one.valves(a).pump, other.valves(b).pump, 1e-9) << "at " << begun << ", wheel " << a;
            }
        }
        EXPECT_NEAR(one.max_throttle(), other.max_throttle(), 1e-9);
    }
}

}  // namespace hamilcar::test
