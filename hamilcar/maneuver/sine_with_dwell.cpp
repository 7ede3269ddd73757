// FMVSS 126 (49 CFR 571.126) and UN R140: coasting at 80 km/h, one period of a 0.7 Hz sine of the steering wheel with a dwell
// of 500 ms at its second peak, in growing amplitudes and both directions. Whether the yaw rate dies away afterwards tells
// stability, how far aside the vehicle gets tells whether it answers at all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/dwell_run.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar {

namespace {

using dwell::early, dwell::late, dwell::displacement_time, dwell::Run;

constexpr double first_amplitude = 1.5, step = 0.5;  // [A]
constexpr double last_amplitude = 6.5;               // [A]; or, if that is more,
constexpr double least_last = 270 * degree, most = 300 * degree;
constexpr double answering = 5;                           // from which on the displacement counts [A]
constexpr double early_limit = 35, late_limit = 20;       // of the peak [%]
constexpr double light_limit = 1.83, heavy_limit = 1.52;  // of the displacement [m]

// Multiples of A from the first to the last, thinned evenly to at most `count` (0: all), the last always among them.
std::vector<double> factors(double angle, double lock, int count) {
    const double last = std::min({std::max(last_amplitude * angle, least_last), most, lock}) / angle;
    std::vector<double> all;
    for (double factor = first_amplitude; factor < last - 1e-9; factor += step) all.push_back(factor);
    all.push_back(last);
    const std::size_t n = all.size(), wanted = static_cast<std::size_t>(count);
    if (count == 0 || wanted >= n) return all;
    std::vector<double> out;
    for (std::size_t i = 0; i < wanted; ++i) out.push_back(wanted == 1 ? last : all[i * (n - 1) / (wanted - 1)]);
    return out;
}

// The run farthest from passing by a value that is to stay below (or above) a limit, and its verdict.
template <class Value>
void add_verdict(Outcome& outcome, const std::vector<Run>& runs, const std::string& criterion, const std::string& unit,
                 double limit, bool below, Value&& value) {
    const Run* worst = nullptr;
    bool passed = !runs.empty();
    for (const Run& run : runs) {
        const double found = value(run);
        passed = passed && (below ? found <= limit : found >= limit);
        const bool worse = !worst || std::isnan(found) || (below ? found > value(*worst) : found < value(*worst));
        if (worse && !(worst && std::isnan(value(*worst)))) worst = &run;
    }
    std::string found = "no run";
    if (worst && std::isnan(value(*worst))) {
        found = fmt::format("not reached: the run ended before, at {:.0f} deg", std::abs(worst->amplitude) / degree);
    } else if (worst) {
        found = fmt::format("{:.3g} {} at {:.0f} deg to the {} first", value(*worst), unit,
                            std::abs(worst->amplitude) / degree, worst->amplitude > 0 ? "left" : "right");
    }
    outcome.verdicts.push_back({criterion, passed, found});
}

void add_verdicts(const VehicleDescription& vehicle, const std::vector<Run>& runs, Outcome& outcome) {
    add_verdict(outcome, runs,
                fmt::format("yaw rate {:g} s after completion of steer at most {:g} % of its peak", early, early_limit),
                "%", early_limit, true, [](const Run& run) { return run.early; });
    add_verdict(outcome, runs,
                fmt::format("yaw rate {:g} s after completion of steer at most {:g} % of its peak", late, late_limit),
                "%", late_limit, true, [](const Run& run) { return run.late; });
    std::vector<Run> large;
    for (const Run& run : runs) {
        if (run.factor >= answering - 1e-9) large.push_back(run);
    }
    if (large.empty()) {
        outcome.notes.push_back(
            fmt::format("no amplitude of {:g} A or more: the lateral displacement is not judged", answering));
        return;
    }
    const double limit = straight::is_heavy(vehicle) ? heavy_limit : light_limit;
    add_verdict(outcome, large,
                fmt::format("lateral displacement {:g} s after the beginning of steer at least {:g} m, from {:g} A on",
                            displacement_time, limit, answering),
                "m", limit, false, [](const Run& run) { return run.displacement; });
}

template <class Value>
io::Chart over_amplitude(const std::vector<Run>& runs, const std::string& title, const std::string& label,
                         Value&& value) {
    io::Chart chart{.title = title, .x_label = "amplitude of the steering wheel [deg]", .y_label = label};
    for (const double side : {1.0, -1.0}) {
        io::Curve curve{.label = side > 0 ? "left first" : "right first", .points = true};
        for (const Run& run : runs) {
            if (run.amplitude * side < 0) continue;
            curve.x.push_back(std::abs(run.amplitude) / degree), curve.y.push_back(value(run));
        }
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

void add_charts(const VehicleDescription& vehicle, const std::vector<Run>& runs, Outcome& outcome) {
    const auto limit = [](double value, const std::string& unit) {
        return std::vector<std::pair<double, std::string>>{{value, fmt::format("limit {:g} {}", value, unit)}};
    };
    outcome.charts.push_back(over_amplitude(runs, "Yaw rate 1 s after completion of steer", "over its peak [%]",
                                            [](const Run& run) { return run.early; }));
    outcome.charts.back().horizontal_marks = limit(early_limit, "%");
    outcome.charts.push_back(over_amplitude(runs, "Yaw rate 1.75 s after completion of steer", "over its peak [%]",
                                            [](const Run& run) { return run.late; }));
    outcome.charts.back().horizontal_marks = limit(late_limit, "%");
    outcome.charts.push_back(over_amplitude(runs, "Lateral displacement 1.07 s after the beginning of steer",
                                            "displacement [m]", [](const Run& run) { return run.displacement; }));
    outcome.charts.back().horizontal_marks = limit(straight::is_heavy(vehicle) ? heavy_limit : light_limit, "m");
}

// How the last run of each direction went.
void add_history(const History& h, const Run& run, std::vector<io::Curve>& steering, std::vector<io::Curve>& yaw) {
    const std::string label = run.amplitude > 0 ? "left first" : "right first";
    steering.push_back({.label = label, .x = h.time, .y = straight::scaled(h.steering_wheel, 1 / degree)});
    yaw.push_back({.label = label, .x = h.time, .y = straight::scaled(h.yaw_rate, 1 / degree)});
}

template <class Value>
double largest(const std::vector<Run>& runs, Value&& value) {
    double out = 0;
    for (const Run& run : runs) out = std::isnan(value(run)) ? out : std::max(out, value(run));
    return out;
}

void add_figures(const std::vector<Run>& runs, Outcome& outcome) {
    const auto add = [&](const std::string& name, const std::string& unit, double value, const std::string& meaning) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    add("largest amplitude", "deg", largest(runs, [](const Run& run) { return std::abs(run.amplitude); }) / degree,
        "of the steering wheel");
    add("yaw rate ratio after 1 s", "%", largest(runs, [](const Run& run) { return run.early; }),
        "yaw rate 1 s after completion of steer over its second peak, the largest of all runs");
    add("yaw rate ratio after 1.75 s", "%", largest(runs, [](const Run& run) { return run.late; }),
        "yaw rate 1.75 s after completion of steer over its second peak, the largest of all runs");
    const Run& last = runs.back();
    add("lateral displacement", "m", last.displacement,
        "1.07 s after the beginning of steer, twice the integral of lateral acceleration; last run");
    add("lateral displacement of the path", "m", last.path,
        "likewise, of the center of mass across its first heading; last run");
    add("largest sideslip angle", "deg", largest(runs, [](const Run& run) { return run.sideslip; }) / degree,
        "of the center of mass, of all runs");
}

std::vector<Setting> settings(const VehicleDescription&) {
    return {{"speed", "km/h", "from which the vehicle coasts", 80, 30, 120},
            {"amplitudes", "", "a direction; fewer are spread evenly, 0: all of the standard", 0, 0, 30}};
}

Outcome drive_all(const VehicleDescription& vehicle, const Settings& settings, const ManeuverOptions& options) {
    constexpr double slow_share = 0.2;  // of the maneuver [1]
    const double speed = settings.at("speed") * kilometer_per_hour, lock = steering_lock(vehicle);
    Outcome outcome;
    const SlowSteer test = slow_steer(vehicle, options, speed, 0, slow_share, outcome);
    if (test.failed) {
        outcome.failed = test.failed;
        return outcome;
    }
    add_slow_steer(test, outcome);
    if (std::max(last_amplitude * test.angle, least_last) > lock && lock < most) {
        outcome.notes.push_back(fmt::format("the steering wheel's lock at {:.0f} deg ends the series", lock / degree));
    }
    const auto wanted = factors(test.angle, lock, static_cast<int>(settings.at("amplitudes")));
    const double count = 2.0 * static_cast<double>(wanted.size());
    std::vector<Run> runs;
    std::vector<io::Curve> steering, yaw;
    std::map<std::string, std::vector<double>> troubles;  // amplitudes [deg]
    for (const double side : {1.0, -1.0}) {
        for (const double factor : wanted) {
            const auto part = [&](double n) { return slow_share + (1 - slow_share) * n / count; };
            const double n = static_cast<double>(runs.size());
            Run run{.amplitude = side * factor * test.angle, .factor = factor};
            const bool last = factor == wanted.back();
            Trial trial = dwell::drive_run(vehicle, options, speed, run, last && options.keep_runs,
                                           share(options, part(n), part(n + 1)));
            if (interrupted(trial)) {
                outcome.failed = "interrupted";
                return outcome;
            }
            dwell::evaluate(trial.history, run);
            runs.push_back(run);
            if (last) add_history(trial.history, run, steering, yaw);
            if (trial.trouble) troubles[*trial.trouble].push_back(std::abs(run.amplitude) / degree);
            trial.trouble.reset();     // told once for all runs
            trial.complaints.clear();  // that a coasting car does not hold its speed
            add_trial(outcome, std::move(trial));
        }
    }
    for (const auto& [trouble, amplitudes] : troubles) {
        outcome.notes.push_back(fmt::format("{} of {} runs: {}, from {:.0f} deg on", amplitudes.size(), runs.size(),
                                            trouble, *std::ranges::min_element(amplitudes)));
    }
    add_figures(runs, outcome);
    add_verdicts(vehicle, runs, outcome);
    add_charts(vehicle, runs, outcome);
    outcome.charts.push_back({.title = "Steering wheel, largest amplitude",
                              .x_label = "time [s]",
                              .y_label = "angle [deg]",
                              .curves = steering});
    outcome.charts.push_back(
        {.title = "Yaw rate, largest amplitude", .x_label = "time [s]", .y_label = "yaw rate [deg/s]", .curves = yaw});
    return outcome;
}

}  // namespace

Maneuver sine_with_dwell() {
    return {.name = "sine_with_dwell",
            .title = "Sine with dwell",
            .standard = "FMVSS 126, UN R140",
            .summary =
                "A sine of the steering wheel that pauses at its second peak: whether the vehicle stays stable and "
                "answers.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_all,
            .course = [](const VehicleDescription&, const Settings&) { return Course(); }};
}

}  // namespace hamilcar
