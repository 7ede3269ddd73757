// The paper's Fig. 9: the same run with different stabilization gains, and what becomes of the constraints.
#pragma once

#include <functional>
#include <vector>

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct SweepRun {
    double gain;          // alpha [1/s]
    double rms_norm = 0;  // of |Phi| over the run, up to where it ended
    double max_norm = 0;
    double ended = 0;  // time reached [s]
    bool blew_up = false;
    std::vector<double> time, norm;  // every `interval`
};

// Runs a scenario in stabilized mode once per gain; gains beyond the stability limit are allowed here and end early.
// `keep_going` is asked now and then; after a no the sweep returns the runs that are complete.
std::vector<SweepRun> stabilization_sweep(
    const VehicleDescription& vehicle, ScenarioDescription scenario, const std::vector<double>& gains, double interval,
    const std::function<bool()>& keep_going = [] { return true; });

}  // namespace hamilcar
