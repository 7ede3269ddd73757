// Work against precision: how far a method strays from the converged path, and how long it takes.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// Where the chassis origin is, ten times a second [m].
using Trace = std::vector<Vec3<double>>;
inline constexpr double path_interval = 0.1;  // [s]

// Largest distance between the two at one time [m]; infinite where one ends early.
double path_error(const Trace& path, const Trace& reference);

struct AccuracyTrial {
    std::string integrator;
    double step;  // [s]
    ConstraintMode constraints = ConstraintMode::exact;
    double tolerance = 1e-8;
};

struct TrialResult {
    AccuracyTrial trial;
    double path_error;  // [m]
    double violation;   // the largest opening of a cut joint, ten times a second [m]
    double wall_time;   // [s]
};

// The scenario with a step so small that halving it changes nothing that the trials could see.
Trace reference_path(const VehicleDescription& vehicle, ScenarioDescription scenario);

// Driven so often; the median of the times counts.
TrialResult run_trial(const VehicleDescription& vehicle, ScenarioDescription scenario, const AccuracyTrial& trial,
                      const Trace& reference, int times);

// All integrators worth a look, in both constraint modes.
std::vector<AccuracyTrial> default_trials();

}  // namespace hamilcar
