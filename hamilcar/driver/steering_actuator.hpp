// Turns a steering wheel to a target angle: a critically damped second-order system with bounded rate and acceleration, so that
// the rack's rate never jumps. Over each interval the acceleration is constant.
#pragma once

namespace hamilcar {

struct SteeringActuator {
    double lock;                                             // of the steering wheel, in each direction [rad]
    double max_rate;                                         // in each direction [rad/s]
    double max_acceleration = natural_frequency * max_rate;  // in each direction [rad/s^2]

    static constexpr double natural_frequency = 30;  // [1/s]

    // Acceleration over the next interval, given the present angle and rate [rad/s^2]. A wheel that starts within the lock never
    // turns past it.
    double acceleration(double angle, double rate, double wanted, double interval) const;
};

}  // namespace hamilcar
