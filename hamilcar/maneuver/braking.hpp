// What a stop straight ahead tells, on one friction or on two: stopping distance, mean fully developed deceleration, when
// which wheel locked, where the vehicle went meanwhile.
#pragma once

#include <array>
#include <limits>

#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar::braking {

inline constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
inline constexpr double approach = 1.5;    // driven at the speed before the pedal is pressed [s]
inline constexpr double standing = 0.3;    // as good as standing [m/s]
inline constexpr double lane_width = 3.5;  // of the track that UN R13 and R13-H let a braking vehicle use [m]

// How the brakes are used.
struct Use {
    double speed;        // [m/s]
    double pedal;        // [1]
    double rise;         // of the pedal, from nothing [s]
    bool engine_drives;  // a gear stays in; otherwise the gearbox goes to neutral with the pedal
};
// From the speed to standstill on the options' road; the time suffices for a deceleration [m/s^2].
ScenarioDescription stop(const VehicleDescription& vehicle, const ManeuverOptions& options, const Use& use,
                         double deceleration);

struct Stop {
    double initial_speed = nowhere;  // as the pedal begins to move [m/s]
    double distance = nowhere;       // from there to standstill [m]
    double time = nowhere;           // likewise [s]
    double developed = nowhere;      // mean fully developed deceleration [m/s^2]
    double heading = 0;              // largest change of it, with its sign [rad]
    double beside = 0;               // farthest that a wheel's outer tire gets from the line straight ahead [m]
    std::vector<double> lock;        // of every wheel, from the pedal on; NaN where it never locks [s]
};
Stop evaluated(const History& history);

// Leaves out what comes after standstill.
void end_at_standstill(Trial& trial);

// v^2 / (2 s), with v and s between 80 and 10 percent of the initial speed (UN R13-H, annex 3) [m/s^2].
double mean_fully_developed(const Series& speed, const Series& distance, double initial_speed);
// The slip of a wheel over time, in percent: 0 rolls as before the pedal, 100 locked, or across its direction.
std::vector<double> slip(const History& history, std::size_t wheel);
// First lock of an axle [s]; NaN where none of its wheels does.
double first_lock(const straight::Axle& axle, const Stop& stop);

// The diagrams of every stop.
void add_charts(Outcome& outcome, const VehicleDescription& vehicle, const History& history);
void add_lock_figures(Outcome& outcome, const VehicleDescription& vehicle, const Stop& stop);

}  // namespace hamilcar::braking
