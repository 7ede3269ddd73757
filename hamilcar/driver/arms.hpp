// Arms that turn a steering wheel to a wanted angle: a critically damped spring at bounded rate and acceleration, so that the
// rack's rate never jumps. Over each interval the acceleration is constant.
#pragma once

namespace hamilcar {

struct Arms {
    double lock;                                // of the steering wheel, each way [rad]
    double largest_rate;                        // each way [rad/s]
    double hardest = quickness * largest_rate;  // acceleration, each way [rad/s^2]

    static constexpr double quickness = 30;  // natural frequency [1/s]

    // Acceleration over the coming interval, from an angle and a rate [rad/s^2]. With it the wheel never turns past the lock,
    // if it has not before.
    double acceleration(double angle, double rate, double wanted, double interval) const;
};

}  // namespace hamilcar
