// One run of braking in a turn: a steady circle, and what becomes of it while the pedal is held and the steering wheel too.
#pragma once

#include <limits>

#include "hamilcar/maneuver/runs.hpp"

namespace hamilcar::circle_braking {

inline constexpr double settling = 10;  // on the circle before the pedal is pressed [s]
inline constexpr double observed = 1;   // after it, where ISO 7975 takes its values [s]
inline constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

// To the left about (0, radius), from the origin on [m].
std::vector<std::array<double, 2>> circle(double radius);

// A driver leads the vehicle round and holds its speed [m/s] until it has settled.
ScenarioDescription on_circle(const VehicleDescription& vehicle, const ManeuverOptions& options, double radius,
                              double speed);

// The same with the steering wheel as it was then, held from `settling` on, the foot off the throttle and the brake's pedal
// at `pedal` [1].
ScenarioDescription braking(const ScenarioDescription& steady, const History& settled, double speed, double pedal);

// What ISO 7975 evaluates, at one second after the beginning of braking; NaN where the vehicle stood or fell before. The
// reference is the vehicle that stays on its circle: yaw rate v / R and lateral acceleration v^2 / R of its present speed.
struct Run {
    double pedal = 0;                           // [1]
    double deceleration = nowhere;              // mean over the second [m/s^2]
    double yaw_rate_ratio = nowhere;            // to the reference [1]
    double acceleration_ratio = nowhere;        // lateral, to the reference [1]
    double deviation = nowhere;                 // of the center of mass from the circle, inward positive [m]
    double sideslip_change = nowhere;           // [rad]
    double largest_sideslip_change = nowhere;   // in magnitude, until the vehicle is slow [rad]
    double largest_yaw_acceleration = nowhere;  // in magnitude within the second [rad/s^2]
    int locked = 0;                             // wheels that locked within the second
};
Run evaluated(const History& history);

// Yaw rate of the reference over time [rad/s].
std::vector<double> reference_yaw_rate(const History& history);

// Of the steady part: speed [m/s], radius [m], and how much the yaw rate changes over its last second [1].
struct Steady {
    double speed, radius, unrest, steering_wheel;
};
Steady steady(const History& history);

}  // namespace hamilcar::circle_braking
