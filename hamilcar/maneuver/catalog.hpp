// Every maneuver by its function; each has a file of its name.
#pragma once

#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar {

// ISO 4138: steady-state circular driving.
Maneuver constant_radius();
Maneuver constant_speed();
Maneuver constant_steer();
// ISO 7401: lateral transient response.
Maneuver step_steer();
Maneuver sine_steer();
Maneuver pulse_steer();
Maneuver random_steer();
// ISO 13674-1: on-center handling.
Maneuver weave();
// ISO 3888-1 and -2.
Maneuver double_lane_change();
Maneuver obstacle_avoidance();
// ISO 7975.
Maneuver braking_in_turn();
// ISO 9816.
Maneuver power_off_in_turn();
// FMVSS 126 / UN R140, and NHTSA's fishhook.
Maneuver sine_with_dwell();
Maneuver fishhook();
// Straight ahead.
Maneuver straight_braking();
Maneuver split_braking();
Maneuver acceleration();
Maneuver coast_down();
// Ride.
Maneuver cleat();
Maneuver rough_road();

}  // namespace hamilcar
