// Speed over ground from what a car measures: wheels whose tires transmit little force roll with the ground, and between such
// moments the accelerometer carries on. Anti-lock system, traction control and stability control each keep a copy in their memory.
//
//     ReferenceSpeed reference;                         // part of a controller's memory, plain numbers
//     update_speed(reference, car, measured);           // once a decision
//     wheel_slip(reference, car, measured, wheel);      // -1 where a wheel is locked
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

#include "hamilcar/control/controller.hpp"

namespace hamilcar {

// A struct of numbers in a controller's memory: how many it takes, and copies of it from and to a place there. Zeros are what a
// run begins with.
template <class T>
constexpr std::size_t numbers_of() {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0);
    return sizeof(T) / sizeof(double);
}

template <class T>
T read_memory(std::span<const double> memory, std::size_t first = 0) {
    T value;
    std::memcpy(static_cast<void*>(&value), memory.subspan(first, numbers_of<T>()).data(), sizeof(T));
    return value;
}

template <class T>
void write_memory(const T& value, std::span<double> memory, std::size_t first = 0) {
    std::memcpy(memory.subspan(first, numbers_of<T>()).data(), &value, sizeof(T));
}

// All zero: nothing is known yet, the first update takes the wheels' word.
struct ReferenceSpeed {
    double known = 0;         // 1 after the first update
    double speed = 0;         // of the motor vehicle's center of mass along its x axis, at least 0 [m/s]
    double acceleration = 0;  // its rate, by the accelerometer less `grade` [m/s^2]
    double grade = 0;         // of what is measured, that is weight, g sin(slope), or the sensor's offset [m/s^2]
    double unseen = 0;        // time since a wheel last confirmed the speed [s]
};

// One decision.
void update_speed(ReferenceSpeed& reference, const ControlledCar& car, const Measured& measured);

// Of the ground under a wheel, along the wheel's heading, with the car's yaw rate and the steering angle [m/s].
double ground_speed(const ReferenceSpeed& reference, const ControlledCar& car, const Measured& measured,
                    std::size_t wheel);

// Of a tire's tread about its axis [m/s].
double tread_speed(const ControlledCar& car, const Measured& measured, std::size_t wheel);

// (tread - ground) / max(ground, 1 m/s): negative while it brakes, -1 locked.
double wheel_slip(const ReferenceSpeed& reference, const ControlledCar& car, const Measured& measured,
                  std::size_t wheel);

// How a wheel's tread speeds up, smoothed. All zero: nothing is known yet.
struct TreadMotion {
    double known = 0;         // 1 after the first update
    double speed = 0;         // at the last decision [m/s]
    double acceleration = 0;  // [m/s^2]
};
void update_motion(TreadMotion& motion, const ControlledCar& car, const Measured& measured, std::size_t wheel);

// Whether two wheels of one unit are beside each other; dual and tandem axles are axles of their own.
bool on_one_axle(const ControlledWheel& a, const ControlledWheel& b);

}  // namespace hamilcar
