#include "hamilcar/run/record.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "hamilcar/analysis/energy_bounds.hpp"
#include "hamilcar/run/run_loop.hpp"
#include "hamilcar/run/validity.hpp"

namespace hamilcar {

RunSummary record(Simulation& simulation, const std::vector<Channel>& channels, double interval, const OnRow& on_row,
                  const KeepGoing& keep_going, RunSummary summary) {
    const auto began = std::chrono::steady_clock::now();
    const double wall_time_before = summary.wall_time;
    summary.ended_early.reset();
    std::vector<double> row(channels.size());
    ValidityMonitor validity(simulation, summary.validity_marks);
    const auto write_row = [&](const Sample& sample) {
        for (std::size_t i = 0; i < channels.size(); ++i) row[i] = channels[i].read(sample);
        summary.max_violation = std::max(summary.max_violation, sample.violation);
        summary.max_kinetic_energy = std::max(summary.max_kinetic_energy, sample.energy.kinetic);
        summary.max_work = std::max(summary.max_work, std::abs(sample.energy.work));  // a NaN is none
        const double error = account_error(sample.energy.balance() - simulation.initial_energy_balance(),
                                           simulation.model().energy_balance);
        summary.max_balance_error = std::isnan(error) ? error : std::max(summary.max_balance_error, error);
        validity.look(sample);
        on_row(sample, row);
        return true;
    };
    const auto count = [&] {
        summary.duration = simulation.time(), summary.steps = simulation.steps_taken();
        summary.validity_marks = validity.marks();
    };
    const RunEnd end =
        run_to_end(simulation, {.interval = interval, .last_state = true, .on_sample = write_row, .keep_going = [&] {
                                    count();
                                    return keep_going(static_cast<double>(simulation.steps_taken()) /
                                                          static_cast<double>(simulation.total_steps()),
                                                      summary);
                                }});
    count();
    if (end.cause == RunEnd::Cause::failure) summary.ended_early = end.message;
    summary.interrupted = end.cause == RunEnd::Cause::interrupted;
    summary.validity = energy_warning(summary.max_balance_error, summary.energy_exchanged(),
                                      simulation.scenario().solver.step, summary.duration);
    add_warnings(validity.warnings(), "", summary.validity);
    summary.wall_time =
        wall_time_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return summary;
}

}  // namespace hamilcar
