#include "hamilcar/run/validity_warning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "hamilcar/analysis/energy_bounds.hpp"

namespace hamilcar {

namespace {

// How far beyond the limit, in limits: what makes one warning worse than another of its kind.
double excess(const ValidityWarning& w) {
    return std::abs(w.worst - w.limit) / std::max(std::abs(w.limit), 1e-300);
}

}  // namespace

std::string sentence(const ValidityWarning& w) {
    const bool throughout = w.from == w.to;
    const std::string unit = w.unit == "1" ? "" : " " + w.unit;
    const std::string when = throughout ? "" : fmt::format(", beyond it from {:.4g} s to {:.4g} s", w.from, w.to);
    return fmt::format("{}{}: {} {:.4g}{} at t = {:.4g} s (limit {:.4g}{}{}): {}; {}",
                       w.drive.empty() ? "" : w.drive + ": ", w.where, w.quantity, w.worst, unit, w.time, w.limit, unit,
                       when, w.meaning, w.advice);
}

std::vector<std::string> sentences(const std::vector<ValidityWarning>& warnings) {
    std::vector<std::pair<ValidityWarning, int>> farthest;  // and how many are alike
    for (const ValidityWarning& one : warnings) {
        const auto same = std::ranges::find_if(farthest, [&](const auto& entry) {
            const ValidityWarning& other = entry.first;
            return std::tie(one.kind, one.quantity, one.meaning, one.advice) ==
                   std::tie(other.kind, other.quantity, other.meaning, other.advice);
        });
        if (same == farthest.end()) {
            farthest.emplace_back(one, 1);
            continue;
        }
        ++same->second;
        if (excess(one) > excess(same->first)) same->first = one;
    }
    std::vector<std::string> out;
    for (auto& [warning, alike] : farthest) {
        if (alike > 1) warning.where += fmt::format(", farthest of {} alike", alike);
        out.push_back(sentence(warning));
    }
    return out;
}

std::vector<ValidityWarning> energy_warning(double error, double exchanged, double step, double duration) {
    if (judge_energy(error, exchanged) == EnergyVerdict::fine) return {};
    // A share that is no number, of numbers that were too large, is not below any other.
    const double share = error / exchanged, largest = std::numeric_limits<double>::max();
    return {{.kind = "energy_balance",
             .where = "energy account",
             .quantity = "balance error, share of the energy exchanged",
             .unit = "1",
             .worst = share < largest ? share : largest,
             .limit = EnergyBounds::doubtful,
             .time = duration,
             .from = 0,
             .to = duration,
             .meaning = fmt::format("off by {:.3g} J of {:.3g} J, more than a step that is small enough explains: the "
                                    "step of {:g} s is too large for this run, its results are doubtful",
                                    error, exchanged, step),
             .advice = "halve the step until the results stay",
             .drive = {}}};
}

void add_warnings(std::vector<ValidityWarning> further, const std::string& drive, std::vector<ValidityWarning>& to) {
    for (ValidityWarning& one : further) {
        one.drive = drive;
        const auto same = std::ranges::find_if(
            to, [&](const ValidityWarning& w) { return w.kind == one.kind && w.where == one.where; });
        if (same == to.end()) {
            to.push_back(std::move(one));
        } else if (excess(one) > excess(*same)) {
            *same = std::move(one);
        }
    }
}

}  // namespace hamilcar
