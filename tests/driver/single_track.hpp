// A single-track car for tests of the driver, with the axles of a typical car rather than those of the driver's internal model.
#pragma once

#include <cmath>

#include "hamilcar/driver/path_follower.hpp"

namespace hamilcar::test {

struct SingleTrack {
    double mass = 1500, inertia = 2600;                     // [kg], [kg m^2]
    double front = 1.2, rear = 1.5;                         // axles' distances from the center of mass [m]
    double front_stiffness = 80e3, rear_stiffness = 105e3;  // [N/rad]
    double friction = 0;                                    // 0: the tires stay linear [1]
    double x = 0, y = 0, yaw = 0, speed = 20, lateral_velocity = 0, yaw_rate = 0;
    double rack = 0, rack_rate = 0;  // [m], [m/s]
    double acceleration = 0;         // lateral, of the last step [m/s^2]

    static constexpr double rack_per_revolution = 0.05, wheels_per_angle = 0.06;

    double force(double stiffness, double slip, double other) const {
        if (friction == 0) return stiffness * slip;
        const double most = friction * mass * 9.81 * other / (front + rear);
        return most * std::tanh(stiffness * slip / most);
    }
    // With constant rack acceleration.
    void step(double rack_acceleration, double h) {
        rack += h * rack_rate + 0.5 * h * h * rack_acceleration;
        rack_rate += h * rack_acceleration;
        const double steer = wheels_per_angle * rack / (rack_per_revolution / (2 * M_PI)), u = std::max(speed, 0.5);
        const double at_front =
            force(front_stiffness, steer - std::atan((lateral_velocity + front * yaw_rate) / u), rear);
        const double at_rear = force(rear_stiffness, -std::atan((lateral_velocity - rear * yaw_rate) / u), front);
        acceleration = (at_front + at_rear) / mass;
        lateral_velocity += h * (acceleration - speed * yaw_rate);
        yaw_rate += h * (front * at_front - rear * at_rear) / inertia;
        yaw += h * yaw_rate;
        x += h * (speed * std::cos(yaw) - lateral_velocity * std::sin(yaw));
        y += h * (speed * std::sin(yaw) + lateral_velocity * std::cos(yaw));
    }
    Observation observation(double time) const {
        return {.time = time,
                .x = x,
                .y = y,
                .yaw = std::remainder(yaw, 2 * M_PI),
                .speed = speed,
                .lateral_velocity = lateral_velocity,
                .yaw_rate = yaw_rate};
    }
    DrivenCar known() const {
        return {.mass = mass,
                .wheelbase = front + rear,
                .center_behind = front,
                .lock = 8,
                .wheels_per_angle = wheels_per_angle};
    }
    static Column column() {
        SteeringDescription steering;
        steering.rack_per_revolution = rack_per_revolution;
        return Column(steering);
    }
};

}  // namespace hamilcar::test
