#include "hamilcar/maneuver/dwell.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/slow_steer.hpp"

namespace hamilcar::dwell {

namespace {

constexpr double light_limit = 1.83, heavy_limit = 1.52;  // of the displacement [m]
constexpr double heaviest = 4536;                         // that FMVSS 126 is for: 10 000 lb [kg]

// The run farthest from passing by a value that is to stay below (or above) a limit, and its verdict.
void add_verdict(TestRun& test, const std::vector<Run>& runs, const std::string& criterion, const std::string& unit,
                 double limit, bool below, double Run::*value) {
    const Run *worst = nullptr, *first_beyond = nullptr, *first_ended = nullptr;
    const auto keep_sooner = [](const Run& run, const Run*& first) {
        if (!first || run.size() < first->size()) first = &run;
    };
    for (const Run& run : runs) {
        const double found = run.*value;
        if (std::isnan(found)) {
            keep_sooner(run, first_ended);
            continue;
        }
        if (!worst || (below ? found > worst->*value : found < worst->*value)) worst = &run;
        if (!(below ? found <= limit : found >= limit)) keep_sooner(run, first_beyond);
    }
    std::string found = worst || first_ended ? "" : "no run";
    if (worst) {
        found = fmt::format("{:.3g} {} at {:.0f} deg to the {} first", worst->*value, unit, worst->size(),
                            worst->amplitude > 0 ? "left" : "right");
    }
    if (first_beyond && first_beyond != worst)
        found += fmt::format(", beyond the limit from {:.0f} deg", first_beyond->size());
    if (first_ended) {
        found += fmt::format("{}from {:.0f} deg runs ended before", worst ? "; " : "", first_ended->size());
    }
    test.verdict(criterion, worst && !first_beyond && !first_ended, found);
}

// A vehicle that stands does not turn any more, even if it spun until then.
void note_stopped(TestRun& test, const std::vector<Run>& runs) {
    const auto slow = std::ranges::count_if(runs, [](const Run& run) { return run.last_speed < stopped; });
    if (slow == 0) return;
    test.note(
        "in {} of {} runs the vehicle was slower than {:g} m/s {:g} s after completion of steer: its small yaw rate "
        "there does not count as passed",
        slow, runs.size(), stopped, late);
    Verdict& verdict = test.outcome.verdicts.back();
    verdict.passed = false;
    verdict.found += fmt::format("; in {} runs the vehicle stood", slow);
}

// At an instant after the beginning of steer, toward the first turn: by the integral, and by the path.
void measure_displacement(const Recording& recording, Run& run) {
    const double side = run.amplitude > 0 ? 1 : -1;
    const double sine = std::min(begun / std::abs(run.amplitude), 1.0);
    const double beginning = steering + std::asin(sine) / (2 * std::numbers::pi * frequency);
    const double measured = beginning + displacement_time;
    if (recording.end() < measured) return;
    const Series raw = recording[channel::lateral_acceleration], y = recording[channel::y];
    const std::vector<double> across = scaled(smoothed(raw), side);
    const Series part = between({across, raw.rate, raw.start}, beginning);
    const std::vector<double> velocity = running_integral(part);
    const std::vector<double> distance = running_integral({velocity, part.rate, part.start});
    run.displacement = interpolated({distance, part.rate, part.start}, measured);
    run.path = side * (interpolated(y, measured) - interpolated(y, beginning));
}

}  // namespace

SignalDescription sine(double amplitude) {
    constexpr int points = 150;  // of the sine
    constexpr double period = 1 / frequency;
    SignalDescription out{.time = {0}, .value = {0}};
    for (int i = 0; i <= points; ++i) {
        const bool paused = 4 * i > 3 * points;
        if (paused && 4 * (i - 1) < 3 * points) {  // at the second peak
            for (const double since : {0.0, pause}) {
                out.time.push_back(steering + 0.75 * period + since), out.value.push_back(-amplitude);
            }
        }
        const double t = period * i / points;
        out.time.push_back(steering + t + (paused ? pause : 0));
        out.value.push_back(amplitude * std::sin(2 * std::numbers::pi * frequency * t));
    }
    return out;
}

Drive drive(const TestRun& test, double speed, const Run& run, const DriveOptions& options) {
    constexpr double afterwards = 0.3;  // smoothing needs a little more than is evaluated [s]
    ScenarioDescription scenario = steered_at(test, speed, sine(run.amplitude * degree));
    scenario.duration = end + late + afterwards;
    scenario.name =
        fmt::format("sine with dwell, {:.0f} deg to the {} first", run.size(), run.amplitude > 0 ? "left" : "right");
    lift_foot(scenario, speed, lift);
    return test.drive(scenario, options);
}

// Yaw rate and lateral acceleration smoothed; the second peak of the yaw rate is its largest value
// against the first turn between the wheel's change of sign and its return.
Run evaluated(const Recording& recording, double amplitude, double factor) {
    Run run{.amplitude = amplitude, .factor = factor};
    const double last = recording.end(), reversal = steering + 0.5 / frequency;
    const Series raw = recording[channel::yaw_rate];
    const std::vector<double> yaw_rate = scaled(smoothed(raw), amplitude > 0 ? -1 : 1);
    const Series yaw{yaw_rate, raw.rate, raw.start};
    run.sideslip = largest(recording, channel::sideslip);
    if (const auto second = peak(yaw, Extreme::highest, reversal, end); second && last > end) {
        run.peak = second->value;
        if (last >= end + early) run.early = 100 * interpolated(yaw, end + early) / second->value;
        if (last >= end + late) run.late = 100 * interpolated(yaw, end + late) / second->value;
    }
    measure_displacement(recording, run);
    if (last >= end + late) {
        run.last_speed = std::hypot(interpolated(recording[channel::speed], end + late),
                                    interpolated(recording[channel::lateral_speed], end + late));
    }
    return run;
}

double displacement_limit(const VehicleDescription& vehicle) {
    return is_heavy(vehicle) ? heavy_limit : light_limit;
}

void add_verdicts(TestRun& test, const std::vector<Run>& runs) {
    if (total_mass(test.vehicle) > heaviest) {
        test.note("FMVSS 126 is for vehicles of up to {:g} kg; this one is heavier, and judged all the same", heaviest);
    }
    const auto criterion = [](double after, double limit) {
        return fmt::format("yaw rate {:g} s after completion of steer at most {:g} % of its peak", after, limit);
    };
    add_verdict(test, runs, criterion(early, early_limit), "%", early_limit, true, &Run::early);
    add_verdict(test, runs, criterion(late, late_limit), "%", late_limit, true, &Run::late);
    note_stopped(test, runs);
    std::vector<Run> large;
    std::ranges::copy_if(runs, std::back_inserter(large),
                         [](const Run& run) { return run.factor >= answering - 1e-9; });
    if (large.empty()) {
        test.note("no amplitude of {:g} A or more: the lateral displacement is not judged", answering);
        return;
    }
    const double limit = displacement_limit(test.vehicle);
    add_verdict(test, large,
                fmt::format("lateral displacement {:g} s after the beginning of steer at least {:g} m, from {:g} A on",
                            displacement_time, limit, answering),
                "m", limit, false, &Run::displacement);
}

}  // namespace hamilcar::dwell
