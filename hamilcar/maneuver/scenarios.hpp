// Scenarios that maneuvers are put together from: a car that drives along at a speed, steering wheels over time, lines to follow.
#pragma once

#include "hamilcar/maneuver/test_run.hpp"

namespace hamilcar {

inline constexpr double straight_ahead = 4;  // before the steering wheel turns: a driver's foot has found its place [s]

// The car on the options' road, going straight ahead at `speed` [m/s] in the gear for it, held there by its driver. With
// power units these drive; without, a torque at the wheels. Inputs and driver can be changed afterwards.
ScenarioDescription driving_at(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed,
                               double duration);
// Under the maneuver's name.
ScenarioDescription driving_at(const TestRun& test, double speed, double duration);
// The same with its steering wheel turned so [rad]; lasts until the last angle.
ScenarioDescription steered_at(const TestRun& test, double speed, SignalDescription angle);

// The highest gear in which the rotor of the first power unit turns at least at twice its idle speed; the only one of a
// motor; 0 without power units.
int gear_for(const VehicleDescription& vehicle, double speed);
// How far the steering wheel can be turned each way, a hair before the rack's stops [rad].
double steering_lock(const VehicleDescription& vehicle);
// Steering wheel angle of a lateral acceleration in steady driving at a speed, by linear theory [rad].
double angle_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration);

// A steering wheel that is turned evenly from corner to corner of (time [s], angle [rad]), finely enough that the rack's
// rate is continuous and the ramps are straight.
SignalDescription turned(const std::vector<std::array<double, 2>>& corners);
// An angle as a function of time, as a table fine enough for its cubics; from 0 to `duration` [s].
SignalDescription tabulated(const std::function<double(double)>& angle, double duration);

// The driver holds `speed` [m/s] up to `time` [s] and then takes the foot off the throttle within `within` [s], without
// braking.
void lift_foot(ScenarioDescription& scenario, double speed, double time, double within = 0.01);
// The line along x that a driver who steers keeps to, so long [m]. Nothing where nothing steers.
void follow_straight_line(ScenarioDescription& scenario, const VehicleDescription& vehicle, double length);
// To the left about (0, radius), from the origin on [m]; a spline through 90 points leaves its circle by micrometers.
std::vector<std::array<double, 2>> circle(double radius, int points = 90);

}  // namespace hamilcar
