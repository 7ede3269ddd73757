// What a ride over an uneven road does to people on the seat and to the wheels' loads.
#pragma once

#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar::ride {

// Seat accelerations by ISO 2631-1 between two instants, weighted with Wd along x and y and Wk along z.
struct Comfort {
    double x, y, z, total;  // r.m.s. and their vector sum, each axis with the factor 1 [m/s^2]
    double crest_z;         // largest value over r.m.s. [1]
    double running_z;       // MTVV, largest r.m.s. over a second [m/s^2]
    double dose_z;          // VDV [m/s^1.75]
};
Comfort felt(const Recording& recording, double from, double to);
void add_figures(TestRun& test, const Comfort& comfort);

// Load of an axle's wheel that varies most, between two instants.
struct Loads {
    double mean, deviation, min, max;  // [N]
};
Loads loads(const Recording& recording, const Axle& axle, double from, double to);

// A thousand rows a second, as the weightings need, where the solver's step allows, and fewer in the replay.
inline constexpr DriveOptions drive_options{.interval = 1e-3, .replay_interval = 0.01, .seat_acceleration = true};
inline constexpr double max_step = 1e-3;  // so that it does [s]

// Values in [from, to).
std::span<const double> within(const Series& series, double from, double to);

}  // namespace hamilcar::ride
