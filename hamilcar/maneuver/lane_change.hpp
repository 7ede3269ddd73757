// Driving through a course of lanes at a speed, and the search for the highest speed at which no cone falls.
#pragma once

#include <optional>

#include "hamilcar/maneuver/lane_course.hpp"
#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar {

struct LaneChange {
    std::string title;  // of its diagrams
    std::vector<Lane> lanes;
    std::optional<double>
        lift;  // x of the vehicle's front where the foot leaves the throttle; empty: the speed is held [m]
};

// Settings that both courses have: speed [km/h], search [yes or no], attempts, preview_time [s].
std::vector<Setting> lane_change_settings(double default_speed, bool default_search);

// A default entry speed, up to `standard` [km/h], that asks no more of a vehicle than a part of what tips it over; a car
// driven at `standard` is asked for `acceleration` [m/s^2].
double default_entry_speed(const VehicleDescription& vehicle, double standard, double acceleration);

// The maneuver with its drive, its course and what it needs: through these lanes.
Maneuver through_lanes(LaneChange (*lanes)(const VehicleDescription&), Maneuver named);

}  // namespace hamilcar
