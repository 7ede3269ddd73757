// From a steady circle with the steering wheel held: what becomes of it when the throttle is released (ISO 9816) or the brake's
// pedal pressed as well (ISO 7975).
#pragma once

#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar::circle_braking {

inline constexpr double settling = 10;  // on the circle before the pedal is pressed [s]
inline constexpr double observed = 1;   // after it, where ISO 7975 takes its values [s]

// The settings "radius" and "lateral_acceleration", with defaults that the vehicle bears.
std::vector<Setting> circle_settings(const VehicleDescription& vehicle, double default_acceleration);

// A driver leads the vehicle round and holds its speed until it has settled.
ScenarioDescription on_circle(const TestRun& test);
// Drives that and takes it; a note where radius or lateral acceleration are off. Nothing, and the maneuver has failed, where the
// circle was not reached.
std::optional<Recording> settle(TestRun& test, double share);

// The same with the steering wheel as it was then, held from `settling` on, the foot off the throttle and the brake's pedal
// at `pedal` [1].
ScenarioDescription braking(const TestRun& test, const Recording& settled, double pedal);

// What both standards evaluate, some time after the beginning [s], by default a second; NaN where the vehicle stood or fell before. The
// reference is the vehicle that stays on its circle: yaw rate v / R and lateral acceleration v^2 / R of its present speed.
struct Run {
    double deceleration = not_shown;              // mean until then [m/s^2]
    double yaw_rate_ratio = not_shown;            // to the reference [1]
    double acceleration_ratio = not_shown;        // lateral, to the reference [1]
    double deviation = not_shown;                 // of the center of mass from the circle, inward positive [m]
    double sideslip_change = not_shown;           // [deg]
    double largest_sideslip_change = not_shown;   // in magnitude, until the vehicle is slow [deg]
    double largest_yaw_acceleration = not_shown;  // in magnitude until then [deg/s^2]
    int locked = 0;                               // wheels that locked until then
};
Run evaluated(const Recording& recording, const std::vector<std::string>& wheels, double after = observed);

// Yaw rates over time after the beginning, and paths, of drives by their labels, beside the circle.
using Drives = std::vector<std::pair<std::string, const Recording*>>;
void add_time_charts(TestRun& test, const std::string& while_what, const Drives& drives);

// Of the steady part: speed [m/s], radius [m], how much the yaw rate changes over its last second [1], steering wheel [deg].
struct Steady {
    double speed, radius, unrest, steering_wheel;
    double lateral_acceleration() const { return speed * speed / radius; }  // [m/s^2]
};
Steady steady(const Recording& recording);
void add_steady_figures(TestRun& test, const Steady& steady);

}  // namespace hamilcar::circle_braking
