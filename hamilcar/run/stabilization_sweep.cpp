#include "hamilcar/run/stabilization_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/run/run_loop.hpp"

namespace hamilcar {

std::vector<SweepRun> stabilization_sweep(const VehicleDescription& vehicle, ScenarioDescription scenario,
                                          const std::vector<double>& gains, double interval,
                                          const std::function<bool()>& keep_going) {
    scenario.solver.constraints = ConstraintMode::stabilized;
    scenario.solver.stabilization = StabilizationRule::value;
    scenario.solver.check_stability = false;
    std::vector<SweepRun> runs;
    for (const double gain : gains) {
        scenario.solver.stabilization_gain = gain;
        Simulation simulation(vehicle, scenario);
        SweepRun run{.gain = gain};
        double sum = 0;
        const auto add_norm = [&](const Sample& sample) {
            const double norm = sample.constraint_norm;
            run.time.push_back(sample.time), run.norm.push_back(norm);
            run.max_norm = std::max(run.max_norm, norm);
            sum += norm * norm;
            return true;
        };
        const RunEnd end =
            run_to_end(simulation, {.interval = interval, .on_sample = add_norm, .keep_going = keep_going});
        if (end.cause == RunEnd::Cause::interrupted) return runs;
        run.blew_up = end.cause == RunEnd::Cause::failure;
        run.ended = simulation.time();
        run.rms_norm = std::sqrt(sum / static_cast<double>(run.norm.size()));
        runs.push_back(std::move(run));
    }
    return runs;
}

}  // namespace hamilcar
