#include "hamilcar/maneuver/sine_with_dwell_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/slow_steer.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar::dwell {

namespace {

constexpr double light_limit = 1.83, heavy_limit = 1.52;  // of the displacement [m]
constexpr double heaviest = 4536;                         // that FMVSS 126 is for: 10 000 lb [kg]

// The run farthest from passing by a value that is to stay below (or above) a limit, and its verdict.
template <class Value>
void add_verdict(Outcome& outcome, const std::vector<Driven>& runs, const std::string& criterion,
                 const std::string& unit, double limit, bool below, Value&& value) {
    const Driven *worst = nullptr, *first_beyond = nullptr, *first_ended = nullptr;
    const auto sooner = [](const Driven& a, const Driven* b) {
        return !b || std::abs(a.amplitude) < std::abs(b->amplitude);
    };
    for (const Driven& run : runs) {
        const double found = value(run);
        if (std::isnan(found)) {
            if (sooner(run, first_ended)) first_ended = &run;
            continue;
        }
        if (!worst || (below ? found > value(*worst) : found < value(*worst))) worst = &run;
        if (!(below ? found <= limit : found >= limit) && sooner(run, first_beyond)) first_beyond = &run;
    }
    const auto angle = [](const Driven& run) { return std::abs(run.amplitude) / degree; };
    std::string found = worst || first_ended ? "" : "no run";
    if (worst) {
        found = fmt::format("{:.3g} {} at {:.0f} deg to the {} first", value(*worst), unit, angle(*worst),
                            worst->amplitude > 0 ? "left" : "right");
    }
    if (first_beyond && first_beyond != worst)
        found += fmt::format(", beyond the limit from {:.0f} deg", angle(*first_beyond));
    if (first_ended) {
        found += fmt::format("{}from {:.0f} deg runs ended before", worst ? "; " : "", angle(*first_ended));
    }
    outcome.verdicts.push_back({criterion, worst && !first_beyond && !first_ended, found});
}

// A vehicle that has come to a stand does not turn any more, even if it spun until then.
void mind_the_stopped(const std::vector<Driven>& runs, Outcome& outcome) {
    const auto slow = std::ranges::count_if(runs, [](const Driven& run) { return run.last_speed < stopped; });
    if (slow == 0) return;
    outcome.notes.push_back(
        fmt::format("in {} of {} runs the vehicle was slower than {:g} m/s {:g} s after completion of steer: its small "
                    "yaw rate there does not count as passed",
                    slow, runs.size(), stopped, late));
    Verdict& verdict = outcome.verdicts.back();
    verdict.passed = false;
    verdict.found += fmt::format("; {} runs had come to a stand", slow);
}

}  // namespace

Driven driven(const History& h, double amplitude, double factor) {
    Driven out{{.amplitude = amplitude, .factor = factor}};
    evaluate(h, out);
    if (h.time.back() < end + late) return out;
    const double rate = row_rate(h);
    out.last_speed = std::hypot(interpolated({.values = h.speed, .rate = rate}, end + late),
                                interpolated({.values = h.lateral_velocity, .rate = rate}, end + late));
    return out;
}

double displacement_limit(const VehicleDescription& vehicle) {
    return straight::is_heavy(vehicle) ? heavy_limit : light_limit;
}

void add_verdicts(const VehicleDescription& vehicle, const std::vector<Driven>& runs, Outcome& outcome) {
    if (straight::total_mass(vehicle) > heaviest) {
        outcome.notes.push_back(fmt::format(
            "FMVSS 126 is for vehicles of up to {:g} kg; this one is heavier, and judged all the same", heaviest));
    }
    const std::string criterion = "yaw rate {:g} s after completion of steer at most {:g} % of its peak";
    add_verdict(outcome, runs, fmt::format(fmt::runtime(criterion), early, early_limit), "%", early_limit, true,
                [](const Run& run) { return run.early; });
    add_verdict(outcome, runs, fmt::format(fmt::runtime(criterion), late, late_limit), "%", late_limit, true,
                [](const Run& run) { return run.late; });
    mind_the_stopped(runs, outcome);
    std::vector<Driven> large;
    for (const Driven& run : runs) {
        if (run.factor >= answering - 1e-9) large.push_back(run);
    }
    if (large.empty()) {
        outcome.notes.push_back(
            fmt::format("no amplitude of {:g} A or more: the lateral displacement is not judged", answering));
        return;
    }
    const double limit = displacement_limit(vehicle);
    add_verdict(outcome, large,
                fmt::format("lateral displacement {:g} s after the beginning of steer at least {:g} m, from {:g} A on",
                            displacement_time, limit, answering),
                "m", limit, false, [](const Run& run) { return run.displacement; });
}

}  // namespace hamilcar::dwell
