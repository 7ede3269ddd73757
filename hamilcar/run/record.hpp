// Steps a simulation to its end and writes the chosen channels on the way.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/validity_warning.hpp"

namespace hamilcar {

struct RunSummary {
    double duration = 0;  // simulated time reached [s]
    long steps = 0;
    double wall_time = 0;                    // of stepping and writing [s]
    std::optional<std::string> ended_early;  // why
    bool interrupted = false;
    double max_violation = 0;               // of a cut joint, at the samples [m]
    double max_balance_error = 0;           // of the energy balance, at the samples; NaN if none is kept [J]
    double max_kinetic_energy = 0;          // [J]
    double max_work = 0;                    // of the forces that keep no energy, either sign [J]
    std::vector<ValidityWarning> validity;  // at the end: where models were used beyond their ranges
    std::vector<double> validity_marks;     // of the ValidityMonitor so far
    // What to compare the balance error with [J].
    double energy_exchanged() const { return std::max(max_kinetic_energy, max_work); }
    double real_time_factor() const { return wall_time > 0 ? duration / wall_time : 0; }
};

// Called now and then between two steps, with the share done and the summary so far; false ends the run.
using KeepGoing = std::function<bool(double share, const RunSummary& so_far)>;
// Called with every sample that is recorded and the values of the channels.
using OnRow = std::function<void(const Sample&, const std::vector<double>&)>;

// `interval` between rows [s]; zero records every step. The start and the last state are always recorded. A run that is
// gone on with brings the summary of its first part; its start is recorded where a row is due.
RunSummary record(Simulation& simulation, const std::vector<Channel>& channels, double interval, const OnRow& on_row,
                  const KeepGoing& keep_going, RunSummary summary = {});

}  // namespace hamilcar
