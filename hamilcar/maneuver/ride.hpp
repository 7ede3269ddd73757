// What a ride over an uneven road does to people on the seat and to the wheels' loads.
#pragma once

#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar::ride {

// Seat accelerations by ISO 2631-1 between two instants, weighted with Wd along x and y and Wk along z.
struct Comfort {
    double x, y, z, total;  // r.m.s. and their vector sum, each axis with the factor 1 [m/s^2]
    double crest_z;         // largest value over r.m.s. [1]
    double running_z;       // MTVV, largest r.m.s. over a second [m/s^2]
    double dose_z;          // VDV [m/s^1.75]
};
Comfort felt(const History& history, double from, double to);
void add_figures(Outcome& outcome, const Comfort& comfort);

// Load of an axle's wheel that varies most, between two instants.
struct Loads {
    double mean, deviation, least, most;  // [N]
};
Loads loads(const History& history, const straight::Axle& axle, double from, double to);

// The rows that such evaluations need, a thousand a second where the solver's step allows, and a film of fewer.
TrialOptions trial_options(const ManeuverOptions& options);
ManeuverOptions with_fine_step(const ManeuverOptions& options);
void thin_out(io::PageRun& film, const History& history);

// Values between two instants.
std::span<const double> between(const History& history, const std::vector<double>& values, double from, double to);

}  // namespace hamilcar::ride
