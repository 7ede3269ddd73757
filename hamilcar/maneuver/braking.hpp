// What a stop straight ahead tells, on one friction or on two: stopping distance, mean fully developed deceleration, when
// which wheel locked, where the vehicle went meanwhile.
#pragma once

#include <map>

#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar::braking {

inline constexpr double approach = 1.5;  // driven at the speed before the pedal is pressed [s]
inline constexpr double standing = 0.3;  // as good as standing [m/s]

// From the setting "speed" to standstill with the settings "pedal" and `rise` [s]; the time suffices for a deceleration [m/s^2].
// With the engine connected a gear stays in; otherwise the gearbox goes to neutral with the pedal.
ScenarioDescription stop(const TestRun& test, double rise, bool engine_connected, double deceleration);
// What the brakes ask for at the setting "pedal" [m/s^2].
double asked_deceleration(const TestRun& test);

struct Stop {
    double initial_speed = not_shown;    // as the pedal begins to move [m/s]
    double distance = not_shown;         // from there to standstill [m]
    double time = not_shown;             // likewise [s]
    double developed = not_shown;        // mean fully developed deceleration [m/s^2]
    double heading = 0;                  // largest change of it, with its sign [deg]
    double beside = 0;                   // farthest that a wheel's outer tire gets from the line straight ahead [m]
    std::map<std::string, double> lock;  // of every wheel, from the pedal on; NaN where it never locks [s]
};
Stop evaluated(const VehicleDescription& vehicle, const Recording& recording);

// Leaves out what comes after standstill.
void end_at_standstill(Drive& drive);
// The settings "speed", from which is braked, up to `max_speed` [km/h], and "pedal_rise".
Setting initial_speed_setting(const VehicleDescription& vehicle, double default_value, double default_heavy,
                              double max_speed);
Setting rise_setting(const VehicleDescription& vehicle);
// The maneuver has failed where the vehicle did not come to a stop; whether it did.
bool check_stop(TestRun& test, const Drive& drive, const Stop& stop);

// v^2 / (2 s), with v and s between 80 and 10 percent of the initial speed (UN R13-H, annex 3) [m/s^2].
double mean_fully_developed(const Series& speed, const Series& distance, double initial_speed);
// When the n-th wheel of an axle locked [s]; NaN where so many never do.
double nth_lock(const Axle& axle, const Stop& stop, std::size_t n);

// Over the ground, whatever way the center of mass goes [m/s], and the way since the start [m].
std::vector<double> ground_speed(const Recording& recording);
std::vector<double> distance(const Recording& recording);

// The diagrams of every stop, its distance, time, deceleration and locking wheels, and whether all stay within UN R13's lane.
void add_charts(TestRun& test, const Recording& recording);
void add_figures(TestRun& test, const Stop& stop);
void judge_lane(TestRun& test, const Stop& stop);
inline constexpr double lane_width = 3.5;  // of the track that UN R13 and R13-H let a braking vehicle use [m]

}  // namespace hamilcar::braking
