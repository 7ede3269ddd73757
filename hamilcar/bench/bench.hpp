// The whole short benchmark, as `hamilcar bench` shows it: one car, batches, snapshots, step_jitter, work against precision.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hamilcar/bench/accuracy.hpp"
#include "hamilcar/bench/operations.hpp"
#include "hamilcar/bench/step_jitter.hpp"
#include "hamilcar/engine/engines.hpp"

namespace hamilcar {

struct Machine {
    std::string processor;
    int threads;
    std::vector<std::string_view> engines;
};

// One car by one engine; a step of the scene "bend" with its method.
struct CarBench {
    std::string_view engine;
    double step, step_with_balance;  // [s]
};

struct BatchBench {
    std::string_view engine;
    Precision precision;
    int threads, lanes;
    double step;           // per car and step [s]
    double peak;           // additions and multiplications that a core can do [1/s]; of as many cores as threads
    double share_of_peak;  // of that peak, with the operations of a step as counted
    double speedup;        // over one thread
};

struct BenchReport {
    std::string vehicle;
    Machine machine;
    OperationCount operations_of_turn, operations_of_step;
    std::vector<CarBench> cars;
    std::vector<BatchBench> batches;
    double ready = 0;     // from a description to a first step: assembled, settled, recorded, compiled [s]
    double snapshot = 0;  // save and restore together [s]
    StepJitter step_jitter{};
    double trial_duration = 0;  // of the lane change [s]
    std::vector<TrialResult> trials;
};

// Takes about `seconds`, and drives less than the 15 s of the lane change if these are fewer; tells `progress` what it is at.
BenchReport bench(const VehicleDescription& vehicle, double seconds,
                  const std::function<void(const std::string&)>& progress);

}  // namespace hamilcar
