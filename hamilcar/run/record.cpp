#include "hamilcar/run/record.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hamilcar/analysis/energy_bounds.hpp"

namespace hamilcar {

namespace {

// However rare the rows and however slow the steps, Ctrl-C is seen in time: so many steps lie between two looks that they
// take a tenth of a second, or as many as a look costs nothing beside.
class LookOut {
public:
    bool is_due() {
        if (++steps_ < steps_between_) return false;
        const auto now = std::chrono::steady_clock::now();
        const double took = std::chrono::duration<double>(now - last_).count();
        const double wanted = static_cast<double>(steps_between_) * wanted_time / std::max(took, 1e-6);
        steps_between_ = std::lround(std::clamp(wanted, 1.0, most_steps));
        steps_ = 0, last_ = now;
        return true;
    }

private:
    static constexpr double wanted_time = 0.1, most_steps = 1000;  // [s]
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    long steps_ = 0, steps_between_ = 1;
};

}  // namespace

long steps_per_row(const Simulation& simulation, double interval) {
    return std::max(1L, std::lround(interval / simulation.scenario().solver.step));
}

RunSummary record(Simulation& simulation, const std::vector<Channel>& channels, double interval, const OnRow& on_row,
                  const KeepGoing& keep_going, RunSummary summary) {
    const auto began = std::chrono::steady_clock::now();
    const double wall_time_before = summary.wall_time;
    const long every = steps_per_row(simulation, interval);
    summary.ended_early.reset();
    std::vector<double> row(channels.size());
    const auto write_row = [&] {
        const Sample sample = simulation.sample();
        for (std::size_t i = 0; i < channels.size(); ++i) row[i] = channels[i].read(sample);
        summary.worst_opening = std::max(summary.worst_opening, sample.violation);
        summary.largest_kinetic_energy = std::max(summary.largest_kinetic_energy, sample.energy.kinetic);
        summary.largest_work = std::max(summary.largest_work, std::abs(sample.energy.work));  // a NaN is none
        const double error = account_error(sample.energy.balance() - simulation.initial_energy_balance(),
                                           simulation.model().energy_balance);
        summary.worst_energy_drift = std::isnan(error) ? error : std::max(summary.worst_energy_drift, error);
        on_row(sample, row);
    };
    LookOut look_out;
    bool last_written = simulation.steps_taken() % every == 0;
    if (last_written) write_row();
    while (!simulation.finished()) {
        if (auto end = simulation.advance()) {
            summary.ended_early = end->message;
            break;
        }
        if (simulation.ending()) break;  // at the state of before
        last_written = simulation.steps_taken() % every == 0;
        if (last_written) write_row();
        if (!look_out.is_due() && !last_written) continue;
        const double share =
            static_cast<double>(simulation.steps_taken()) / static_cast<double>(simulation.total_steps());
        summary.duration = simulation.time(), summary.steps = simulation.steps_taken();
        if (!keep_going(share, summary)) {
            summary.interrupted = true;
            break;
        }
    }
    if (!last_written) write_row();
    summary.duration = simulation.time();
    summary.steps = simulation.steps_taken();
    summary.wall_time =
        wall_time_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return summary;
}

}  // namespace hamilcar
