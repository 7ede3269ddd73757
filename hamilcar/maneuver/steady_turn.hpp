// ISO 4138's three ways to go round in circles have one evaluation: steady states in order of lateral acceleration, and what
// their steering wheel angle, roll, sideslip and torque do over it.
#pragma once

#include <span>

#include "hamilcar/maneuver/lateral.hpp"

namespace hamilcar {

// Means over a second or so of driving in which nothing changes any more; to the left positive.
struct SteadyTurn {
    double time;                    // the middle [s]
    double speed, yaw_rate;         // [m/s], [rad/s]
    double acceleration;            // by the forces on the vehicle [m/s^2]
    double steering_wheel, torque;  // [rad]; NaN where it is not measured [N m]
    double roll, sideslip;          // [rad]

    // Speed times yaw rate, as linear theory has it [m/s^2].
    double lateral_acceleration() const { return speed * yaw_rate; }
    double curvature() const { return yaw_rate / speed; }
    // Whether forces and turning belong together: a vehicle that begins to spin turns faster than its path.
    bool settled() const;
};
SteadyTurn steady_turn(const History& history, double from, double to);

// A value that goes up in stairs and rests on each: tables over time, and when the rests end.
struct Stairs {
    SignalDescription signal;
    std::vector<double> rests;  // ends [s]
};
// Rests longer on the first level [s].
void delay(Stairs& stairs, double by);
// Starts on the first level; `ramp` [s] from the level i to i + 1, `rest` [s] on each.
Stairs stairs(const std::vector<double>& levels, const std::function<double(std::size_t)>& ramp, double rest);

// The gear for all of a circle, since a change of gear at the limit throws a car off. None for a heavy vehicle, which is to
// change gears: its engine has not the range, and it rolls over first.
std::optional<int> steady_gear(const VehicleDescription& vehicle, double radius);

// What a vehicle's steering wheel would turn by geometry alone: angle per curvature, ratio times wheelbase.
struct TurningGeometry {
    double steering_ratio;                                                     // [1]
    double wheelbase;                                                          // [m]
    double angle_per_curvature() const { return steering_ratio * wheelbase; }  // [rad m]
};
TurningGeometry turning_geometry(const VehicleDescription& vehicle);

// The slope at x = 0 of c + s x + q x^2 + k x^3 of least squares through points up to `most`; NaN for too few points. Curves are
// not odd: drag and drive grow with x, and there are vehicles with a kink at zero.
double beginning_slope(std::span<const double> x, std::span<const double> y, double most);

// Slopes of lines through every point and its neighbors within `half_width` of x.
std::vector<double> local_slopes(std::span<const double> x, std::span<const double> y, double half_width);

// How the understeer of a test is to be read.
struct SteadyTest {
    TurningGeometry geometry;
    double small;       // up to this lateral acceleration the curves are fitted [m/s^2]
    bool fixed_wheel;   // the steering wheel is held: understeer shows in the curvature
    double half_width;  // of local slopes [m/s^2]
};

// The angle per curvature that a vehicle needs without lateral acceleration [rad m], and by how much the angle of the steering
// wheel grows with it beyond that, at its beginning [rad/(m/s^2)]. The first is geometry's, or with a fixed steering wheel what
// the states themselves show: delta_H = f kappa + s a + q a^2 + k a^3, which has camber and scrub in it.
struct Understeer {
    double angle_per_curvature, gradient;
};
Understeer understeer_of(const SteadyTest& test, const std::vector<SteadyTurn>& states);

// Adds gradients at small lateral acceleration and the test's diagrams.
void evaluate(const SteadyTest& test, const std::vector<SteadyTurn>& states, Outcome& outcome);

// The largest mean lateral acceleration over a second in which all rows count and which is steady: it is speed times yaw rate,
// and not a vehicle that spins [m/s^2].
double largest_lateral_acceleration(const History& history, const std::function<bool(std::size_t)>& counts);

// Takes the drive into the outcome. A limit that ended it is a note; a failure are an interruption and too few states to fit.
void finish_steady(Outcome& outcome, Trial trial, std::size_t states);

}  // namespace hamilcar
