// The one loop that steps a simulation from where it stands to its end. What is made of the samples on the way is up to
// its observers: rows in a file, columns of a maneuver, a norm.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct RunWatch {
    double interval = 0;      // between two samples [s]; at least one step
    bool last_state = false;  // sample the last state too where none was due
    // With the state at the start, if one is due there, and then every interval; false ends the run.
    std::function<bool(const Sample&)> on_sample;
    // After every sample but the first and, however rare these are, about ten times a second; false ends the run.
    std::function<bool()> keep_going = [] { return true; };
};

struct RunEnd {
    enum class Cause { duration, driver, failure, watch, interrupted };
    Cause cause = Cause::duration;
    std::string message;  // of a failure: why the run cannot go on
};

RunEnd run_to_end(Simulation& simulation, const RunWatch& watch);

// An interval as a number of steps, at least one.
inline long steps_per_row(const Simulation& simulation, double interval) {
    return std::max(1L, std::lround(interval / simulation.scenario().solver.step));
}

}  // namespace hamilcar
