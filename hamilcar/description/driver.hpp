// A driver who looks, as a person writes it down. Parts that are left out are done by the scenario's inputs over time.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hamilcar/description/signal.hpp"

namespace hamilcar {

// A line on the ground that the center of mass is to follow, smooth through its points.
struct PathDescription {
    std::vector<std::array<double, 2>> points;  // x, y on the ground [m]
    bool closed = false;                        // the last point leads to the first one
};

// Steers along a path by looking ahead.
struct PathFollowerDescription {
    PathDescription path;
    double preview_time = 0.5;  // how far ahead the driver looks [s]
    double largest_angle = 0;   // of the steering wheel, each way; 0: up to the rack's stops [rad]
    double largest_rate = 20;   // of the steering wheel [rad/s]
};

// Holds a speed with the pedals.
struct SpeedControlDescription {
    SignalDescription speed;          // wanted over time [m/s]
    bool may_brake = true;            // otherwise the driver only lifts the foot
    double largest_acceleration = 3;  // that is asked for, either way [m/s^2]
};

// Gears: one that stays, or chosen by the driver (manual gearbox) or by the gearbox (automatic).
struct ShiftingDescription {
    std::optional<int> gear;  // -1 reverse, 0 neutral, 1 ...; empty: chosen while driving
    int first_gear = 1;       // lowest that is chosen
};

// What ends a run before its time is up; the first that comes true.
struct EndingDescription {
    std::optional<double> speed_below, speed_above;  // [m/s]
    std::optional<double> distance;                  // driven since the start [m]
    std::optional<double> station;                   // along the path [m]
    std::optional<double> path_offset;               // of the center of mass from the path, either side [m]
    std::optional<double> lateral_acceleration;      // either side [m/s^2]
    std::optional<double> roll;                      // either side [rad]
    double earliest = 0;                             // nothing ends before [s]
};

struct DriverDescription {
    double interval = 0.005;  // between two decisions [s]
    std::optional<PathFollowerDescription> steering;
    std::optional<SpeedControlDescription> speed;
    std::optional<ShiftingDescription> shifting;
    EndingDescription ending;
};

}  // namespace hamilcar
