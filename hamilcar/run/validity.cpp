#include "hamilcar/run/validity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hamilcar {

namespace {

bool is_beyond(const RangeCheck& check, double value) {
    return value < check.min || value > check.max;
}

// By how much, in the check's unit; not above zero within.
double distance(const RangeCheck& check, double value) {
    return std::max(check.min - value, value - check.max);
}

}  // namespace

ValidityMonitor::ValidityMonitor(const Simulation& simulation, std::span<const double> marks)
    : checks_(range_checks(simulation.vehicle(), simulation.scenario())),
      marks_(checks_.size()),
      stability_(simulation) {
    if (marks.empty()) return;
    const double* at = marks.data();
    for (Mark& mark : marks_) {
        mark = {.worst = at[0], .time = at[1], .since = at[2], .from = at[3], .to = at[4]};
        at += Mark::size;
    }
    stability_.take_marks(at);
}

std::vector<double> ValidityMonitor::marks() const {
    std::vector<double> out;
    for (const Mark& m : marks_) out.insert(out.end(), {m.worst, m.time, m.since, m.from, m.to});
    const std::vector<double> further = stability_.marks();
    out.insert(out.end(), further.begin(), further.end());
    return out;
}

bool ValidityMonitor::fit(const Simulation& simulation, std::span<const double> marks) {
    if (marks.empty()) return true;
    const std::size_t checks = range_checks(simulation.vehicle(), simulation.scenario()).size();
    if (marks.size() != checks * Mark::size + StepStability::mark_count) return false;
    return StepStability(simulation).take_marks(marks.data() + checks * Mark::size);
}

void ValidityMonitor::look(const Sample& sample) {
    for (std::size_t i = 0; i < checks_.size(); ++i) look(checks_[i], sample, marks_[i]);
    stability_.look(sample);
}

void ValidityMonitor::look(const RangeCheck& check, const Sample& sample, Mark& mark) const {
    const double value = check.read(sample), time = sample.time;
    if (!std::isfinite(value) || !is_beyond(check, value)) {
        mark.since = -1;
        return;
    }
    if (mark.since < 0) mark.since = time;
    if (time - mark.since < check.patience) return;
    if (mark.from < 0) mark.from = mark.since, mark.worst = value, mark.time = time;
    if (distance(check, value) > distance(check, mark.worst)) mark.worst = value, mark.time = time;
    mark.to = time;
}

ValidityWarning ValidityMonitor::warning(const RangeCheck& check, const Mark& mark) const {
    return {.kind = check.kind,
            .where = check.where,
            .quantity = check.quantity,
            .unit = check.unit,
            .worst = mark.worst,
            .limit = mark.worst < check.min ? check.min : check.max,
            .time = mark.time,
            .from = mark.from,
            .to = mark.to,
            .meaning = check.meaning,
            .advice = check.advice,
            .drive = {}};
}

std::vector<ValidityWarning> ValidityMonitor::warnings() const {
    std::vector<ValidityWarning> out;
    if (stability_.is_exceeded()) {
        const StepLimit& worst = stability_.worst();
        out.push_back(
            {.kind = "step",
             .where = "solver",
             .quantity = "step",
             .unit = "s",
             .worst = stability_.step(),
             .limit = worst.stable_step,
             .time = stability_.time(),
             .from = stability_.time(),
             .to = stability_.time(),
             .meaning = fmt::format("{} makes a motion of {} grow that decays by itself, at {:.3g} + {:.3g} i "
                                    "1/s",
                                    stability_.method(), stability_.number_name(), worst.lambda.real(),
                                    std::abs(worst.lambda.imag())),
             .advice =
                 fmt::format("take a step below {:.2g} s, or a method with a larger limit (rk4)", worst.stable_step),
             .drive = {}});
    }
    for (std::size_t i = 0; i < checks_.size(); ++i) {
        if (marks_[i].from >= 0) out.push_back(warning(checks_[i], marks_[i]));
    }
    return out;
}

}  // namespace hamilcar
