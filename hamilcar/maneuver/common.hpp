// What all maneuvers need: a car that drives along at a speed, its size, and how an outcome is put together.
#pragma once

#include <numbers>

#include "hamilcar/maneuver/trial.hpp"

namespace hamilcar {

inline constexpr double degree = std::numbers::pi / 180;  // [rad]
inline constexpr double kilometer_per_hour = 1 / 3.6;     // [m/s]
inline constexpr double standard_gravity = 9.80665;       // [m/s^2]

// The car on the options' road, going straight ahead at `speed` [m/s] in the gear for it, held there by its driver. With
// power units these drive; without, a torque at the wheels. Inputs and driver can be changed afterwards.
ScenarioDescription driving_at(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed,
                               double duration);

// The highest gear in which the rotor of the first power unit turns at least at twice its idle speed; the only one of a
// motor; 0 without power units.
int gear_for(const VehicleDescription& vehicle, double speed);

// Why a vehicle cannot do it, or nothing.
std::string needs_steering(const VehicleDescription& vehicle);
std::string needs_drive(const VehicleDescription& vehicle);
std::string needs_steering_and_drive(const VehicleDescription& vehicle);
std::string needs_power_units(const VehicleDescription& vehicle);

// Half the width of the vehicle's widest tire, of which files say nothing: 0.27 of the radius, as of truck tires, at least
// 0.1 as of a car's [m].
double half_tire(const VehicleDescription& vehicle);
// The box around the motor vehicle on the ground, from its hull and its tires; x and y from its center of mass [m].
struct Footprint {
    double front, rear, left, right;
    double width() const { return left - right; }
    double length() const { return front - rear; }
};
Footprint footprint(const VehicleDescription& vehicle);
// x of what comes last, trailers' wheels too, from there while the combination stands straight [m].
double rear_end(const VehicleDescription& vehicle);

// Of the motor vehicle, between its foremost and its rearmost axle [m].
double wheelbase(const VehicleDescription& vehicle);
// Turn of the road wheels per turn of the steering wheel, straight ahead [1]; 0 where nothing steers.
double steer_per_angle(const VehicleDescription& vehicle);
// How far the steering wheel can be turned each way, a hair before the rack's stops [rad].
double steering_lock(const VehicleDescription& vehicle);
// Steering wheel angle of a lateral acceleration in steady driving at a speed, by linear theory [rad].
double angle_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration);

// Adds a drive to an outcome: its energy, its film if there is one, its complaints and a fall as notes. Whether the maneuver
// may go on: an interruption or a failure of the mathematics ends it and is its failure.
bool add_trial(Outcome& outcome, Trial trial);
// The same of a run on the way to those that count, where all else that goes wrong is what it is for: energy alone.
bool add_search_trial(Outcome& outcome, const Trial& trial);
// The same of a drive that says nothing unless it came to its end: a fall is a failure too. Takes all but the history; whether
// it came to its end.
bool take_whole(Outcome& outcome, Trial& trial);

// The first row at or after a time [s].
std::size_t row_at(const History& history, double time);

}  // namespace hamilcar
