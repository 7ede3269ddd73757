#include "hamilcar/bench/accuracy.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "hamilcar/bench/interleave.hpp"

namespace hamilcar {

namespace {

struct Run {
    Trace path;
    double violation = 0, wall_time = 0;
};

Run drive(const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    Simulation simulation(vehicle, scenario);
    const long every = std::lround(path_interval / scenario.solver.step);
    Run run;
    run.path.push_back(simulation.state().position());
    while (!simulation.finished()) {
        const auto began = std::chrono::steady_clock::now();
        for (long i = 0; i < every; ++i) {
            if (simulation.advance()) return run;
        }
        run.wall_time += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        run.path.push_back(simulation.state().position());
        run.violation = std::max(run.violation, simulation.sample().violation);
    }
    return run;
}

}  // namespace

double path_error(const Trace& path, const Trace& reference) {
    if (path.size() != reference.size()) return std::numeric_limits<double>::infinity();
    double worst = 0;
    for (std::size_t i = 0; i < path.size(); ++i) worst = std::max(worst, (path[i] - reference[i]).norm());
    return worst;
}

Trace reference_path(const VehicleDescription& vehicle, ScenarioDescription scenario) {
    scenario.solver.integrator = "rk4";
    scenario.solver.step = 1e-4;
    return drive(vehicle, scenario).path;
}

TrialResult run_trial(const VehicleDescription& vehicle, ScenarioDescription scenario, const AccuracyTrial& trial,
                      const Trace& reference, int times) {
    scenario.solver.integrator = trial.integrator;
    scenario.solver.step = trial.step;
    scenario.solver.constraints = trial.constraints;
    scenario.solver.tolerance = trial.tolerance;
    scenario.solver.stabilization = StabilizationRule::limit;
    TrialResult result{trial, 0, 0, 0};
    std::vector<double> wall_times;
    for (int i = 0; i < times; ++i) {
        const Run run = drive(vehicle, scenario);
        result.path_error = path_error(run.path, reference);
        result.violation = run.violation;
        wall_times.push_back(run.wall_time);
    }
    result.wall_time = median(wall_times);
    return result;
}

std::vector<AccuracyTrial> default_trials() {
    constexpr auto exact = ConstraintMode::exact, stabilized = ConstraintMode::stabilized;
    return {
        {"ab2", 1e-3, exact},          {"ab2", 5e-4, exact},          {"ab3", 2e-3, exact},
        {"ab3", 1e-3, exact},          {"ab3", 5e-4, exact},          {"ab3", 1e-3, stabilized},
        {"ab3", 5e-4, stabilized},     {"ab4", 1e-3, exact},          {"ab4", 5e-4, exact},
        {"abm3", 2e-3, exact},         {"abm3", 1e-3, exact},         {"abm3", 2e-3, stabilized},
        {"abm4", 2e-3, exact},         {"abm4", 1e-3, exact},         {"rk4", 1e-2, exact},
        {"rk4", 5e-3, exact},          {"rk4", 2e-3, exact},          {"rk4", 1e-3, exact},
        {"rk4", 2e-3, stabilized},     {"dopri5", 1e-1, exact, 1e-4}, {"dopri5", 1e-1, exact, 1e-6},
        {"dopri5", 1e-1, exact, 1e-8},
    };
}

}  // namespace hamilcar
