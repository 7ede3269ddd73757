// What tests straight ahead have in common: braking, accelerating, rolling out and riding over bumps.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/maneuver/common.hpp"

namespace hamilcar::straight {

// Of everything, trailers too [kg].
double total_mass(const VehicleDescription& vehicle);
// Beyond the 3.5 t that regulations divide cars and trucks by (UN R.E.3, category N2).
bool is_heavy(const VehicleDescription& vehicle);

// An axle of the vehicle or of a trailer: wheels at one place along it, by their numbers in a History.
struct Axle {
    std::string name;  // "axle 1 (front)"
    std::vector<std::size_t> wheels;
    double x;  // of its wheel centers in the vehicle frame [m]
    bool of_trailer;
};
// From the foremost on.
std::vector<Axle> axles(const VehicleDescription& vehicle);

// At full command, of all brakes at the ground [N].
double full_brake_force(const VehicleDescription& vehicle);

// The line along x that a driver who steers keeps to, so long [m]. Nothing where nothing steers.
void follow_straight_line(ScenarioDescription& scenario, const VehicleDescription& vehicle, double length);

// One drive of several, with its share of the progress.
TrialOptions trial_options(const ManeuverOptions& options, double from, double to);
// As drive; where the mathematics gave up, again with a step of a quarter, which complaints tell: drive torques make some
// axles stiffer than the usual step stands.
Trial drive_again_finely(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                         const TrialOptions& options);

Series series(const History& history, const std::vector<double>& values);
// Driven since the start, along the path of the chassis's center of mass [m].
std::vector<double> distance(const History& history);
// Of the chassis's center of mass, whatever way it goes [m/s].
std::vector<double> ground_speed(const History& history);
// Keeps the first rows of a drive, of its film too.
void keep_rows(Trial& trial, std::size_t count);
double mean(std::span<const double> values);
std::vector<double> scaled(const std::vector<double>& values, double factor);
// At most about so many of the rows, for a diagram.
std::vector<double> thinned(const std::vector<double>& values, std::size_t most = 1500);

}  // namespace hamilcar::straight
