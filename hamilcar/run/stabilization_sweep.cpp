#include "hamilcar/run/stabilization_sweep.hpp"

#include <cmath>

namespace hamilcar {

std::vector<SweepRun> stabilization_sweep(const VehicleDescription& vehicle, ScenarioDescription scenario,
                                          const std::vector<double>& gains, double interval,
                                          const std::function<bool()>& keep_going) {
    scenario.solver.constraints = ConstraintMode::stabilized;
    scenario.solver.stabilization = StabilizationRule::value;
    scenario.solver.check_stability = false;
    const long every = std::max(1L, std::lround(interval / scenario.solver.step));
    std::vector<SweepRun> runs;
    for (const double gain : gains) {
        scenario.solver.stabilization_gain = gain;
        Simulation simulation(vehicle, scenario);
        SweepRun run{.gain = gain};
        double sum = 0;
        long samples = 0;
        while (true) {
            if (simulation.steps_taken() % every == 0) {
                const double norm = simulation.sample().constraint_norm;
                run.time.push_back(simulation.time());
                run.norm.push_back(norm);
                run.max_norm = std::max(run.max_norm, norm);
                sum += norm * norm;
                ++samples;
            }
            if (simulation.finished()) break;
            if (!keep_going()) return runs;
            if (simulation.advance()) {
                run.blew_up = true;
                break;
            }
        }
        run.ended = simulation.time();
        run.rms_norm = std::sqrt(sum / static_cast<double>(samples));
        runs.push_back(std::move(run));
    }
    return runs;
}

}  // namespace hamilcar
