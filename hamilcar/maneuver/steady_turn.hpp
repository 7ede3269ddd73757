// ISO 4138's three ways to go round in circles have one evaluation: steady states in order of lateral acceleration, and what
// their steering wheel angle, roll, sideslip and torque do over it.
#pragma once

#include <span>

#include "hamilcar/maneuver/amplitude.hpp"

namespace hamilcar {

// Means over a second or so of driving in which nothing changes any more; to the left positive.
struct SteadyTurn {
    double time;                    // the middle [s]
    double speed, yaw_rate;         // [m/s], [rad/s]
    double acceleration;            // by the forces on the vehicle [m/s^2]
    double steering_wheel, torque;  // [deg], [N m]
    double roll, sideslip;          // [deg]

    // Speed times yaw rate, as linear theory has it [m/s^2].
    double lateral_acceleration() const { return speed * yaw_rate; }
    double curvature() const { return yaw_rate / speed; }
    // By how much forces and turning differ, a share of the acceleration: a vehicle that begins to spin turns faster than its path.
    double unsteadiness() const;
    bool settled() const;  // that is small
};
SteadyTurn steady_turn(const Recording& recording, double from, double to);

// Speeds in stairs, with a rest on each: over time, and when the rests end.
struct Stairs {
    std::vector<double> speeds;  // [m/s]
    SignalDescription signal;
    std::vector<double> rests;  // ends [s]
    double begun;               // by so much the first rest is longer [s]
};
// Those of lateral accelerations on a circle, each with a rest that long [s]; `ramp` [s] from the speed i to i + 1. The first rest
// is longer by `turning` [s] and a quarter of the circle, on which the driver finds it and a trailer its angle.
Stairs stairs(const std::vector<double>& accelerations, double radius, double rest, double turning,
              const std::function<double(const std::vector<double>& speeds, std::size_t i)>& ramp);
// At these speeds, in one gear that suits the circle, until the vehicle rolls too far; what steers is to be added.
ScenarioDescription climbing(const TestRun& test, const Stairs& stairs, double radius);
// The last second of each rest until one is none: slower than ISO 4138 allows, or one that `is_lost`.
std::vector<SteadyTurn> rests_of(const Recording& recording, const Stairs& stairs,
                                 const std::function<bool(const SteadyTurn&, double end)>& is_lost);

inline constexpr double steady_window = 1;                // of a mean at the end of a rest [s]
inline constexpr double steady_speed_share = 0.97;        // of the wanted one, below which a state is none: ISO 4138
inline constexpr double steady_roll_limit = 30 * degree;  // at which the test ends

// Settings: how long a rest is, and up to which lateral acceleration gradients are fitted.
Setting rest_setting();
Setting small_setting(const VehicleDescription& vehicle);

// The gear for all of a circle, since a change of gear at the limit throws a car off. None for a heavy vehicle, which is to
// change gears: its engine has not the range, and it rolls over first.
std::optional<int> steady_gear(const VehicleDescription& vehicle, double radius);

// What a vehicle's steering wheel would turn by geometry alone: angle per curvature, ratio times wheelbase.
struct TurningGeometry {
    double steering_ratio;                                                              // [1]
    double wheelbase;                                                                   // [m]
    double angle_per_curvature() const { return steering_ratio * wheelbase / degree; }  // [deg m]
};
TurningGeometry turning_geometry(const VehicleDescription& vehicle);

// Of the steering wheel: turned as the vehicle needs it, or held, so that understeer shows in the curvature.
enum class Steering { turned, held };

// Adds gradients up to the setting "small_lateral_acceleration", and the test's diagrams; `half_width` is that of local slopes
// [m/s^2].
void evaluate(TestRun& test, const std::vector<SteadyTurn>& states, double half_width,
              Steering steering = Steering::turned);

// The largest mean lateral acceleration over a second in which all rows count and which is steady: it is speed times yaw rate,
// and not a vehicle that spins [m/s^2].
double largest_lateral_acceleration(const Recording& recording, const std::function<bool(std::size_t)>& counts);

// Takes the drive into the outcome. A limit that ended it is a note; a failure are an interruption and too few states to fit.
void finish_steady(TestRun& test, Drive& drive, std::size_t states);

}  // namespace hamilcar
