// FMVSS 126 (49 CFR 571.126) and UN R140: coasting at 80 km/h, one period of a 0.7 Hz sine of the steering wheel with a dwell
// of 500 ms at its second peak, in growing amplitudes and both directions. Whether the yaw rate dies away afterwards tells
// stability, how far aside the vehicle gets tells whether it answers at all.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/sine_with_dwell_limits.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar {

namespace {

using dwell::Driven, dwell::early, dwell::late, dwell::early_limit, dwell::late_limit;

constexpr double first_amplitude = 1.5, step = 0.5;  // [A]
constexpr double last_amplitude = 6.5;               // [A]; or, if that is more,
constexpr double least_last = 270 * degree, most = 300 * degree;

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

template <class Value>
io::Chart over_amplitude(const std::vector<Driven>& runs, const std::string& title, const std::string& label,
                         Value&& value) {
    io::Chart chart{.title = title, .x_label = "amplitude of the steering wheel [deg]", .y_label = label};
    for (const double side : {1.0, -1.0}) {
        io::Curve curve{.label = side > 0 ? "left first" : "right first", .points = true};
        for (const Driven& run : runs) {
            if (run.amplitude * side < 0) continue;
            curve.x.push_back(std::abs(run.amplitude) / degree), curve.y.push_back(value(run));
        }
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

void add_charts(const VehicleDescription& vehicle, const std::vector<Driven>& runs, Outcome& outcome) {
    const auto limit = [](double value, const std::string& unit) {
        return std::vector<std::pair<double, std::string>>{{value, fmt::format("limit {:g} {}", value, unit)}};
    };
    outcome.charts.push_back(over_amplitude(runs, "Yaw rate 1 s after completion of steer", "over its peak [%]",
                                            [](const Driven& run) { return run.early; }));
    outcome.charts.back().horizontal_marks = limit(early_limit, "%");
    outcome.charts.push_back(over_amplitude(runs, "Yaw rate 1.75 s after completion of steer", "over its peak [%]",
                                            [](const Driven& run) { return run.late; }));
    outcome.charts.back().horizontal_marks = limit(late_limit, "%");
    outcome.charts.push_back(over_amplitude(runs, "Lateral displacement 1.07 s after the beginning of steer",
                                            "displacement [m]", [](const Driven& run) { return run.displacement; }));
    outcome.charts.back().horizontal_marks = limit(dwell::displacement_limit(vehicle), "m");
}

// How the run with the largest amplitude went in each direction.
class Histories {
public:
    void add(const History& h, double amplitude) {
        const double rate = row_rate(h), from = h.y[row_at(h, dwell::steering)];
        std::vector<double> aside = h.y;
        for (double& y : aside) y -= from;
        const std::string label = amplitude > 0 ? "left first" : "right first";
        const std::vector<double> columns[] = {straight::scaled(h.steering_wheel, 1 / degree),
                                               straight::scaled(h.yaw_rate, 1 / degree),
                                               smoothed(h.lateral_acceleration, rate), aside};
        for (std::size_t i = 0; i < charts_.size(); ++i) {
            charts_[i].curves.push_back({.label = label, .x = h.time, .y = columns[i]});
        }
    }
    // With the instants at which the yaw rate is read.
    void add_to(Outcome& outcome) const {
        for (io::Chart chart : charts_) {
            chart.x_label = "time [s]";
            chart.vertical_marks = {{dwell::end + early, fmt::format("{:g} s after completion of steer", early)},
                                    {dwell::end + late, fmt::format("{:g} s after", late)}};
            outcome.charts.push_back(std::move(chart));
        }
    }

private:
    std::array<io::Chart, 4> charts_{
        {{.title = "Steering wheel, largest amplitude", .y_label = "angle [deg]"},
         {.title = "Yaw rate, largest amplitude", .y_label = "yaw rate [deg/s]"},
         {.title = "Lateral acceleration below 6 Hz, largest amplitude", .y_label = "lateral acceleration [m/s^2]"},
         {.title = "Lateral displacement of the path, largest amplitude", .y_label = "displacement [m]"}}};
};

template <class Value>
double largest(const std::vector<Driven>& runs, Value&& value) {
    double out = 0;
    for (const Driven& run : runs) out = std::isnan(value(run)) ? out : std::max(out, value(run));
    return out;
}

void add_figures(const std::vector<Driven>& runs, Outcome& outcome) {
    const auto add = [&](const std::string& name, const std::string& unit, double value, const std::string& meaning) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    add("largest amplitude", "deg", largest(runs, [](const Driven& run) { return std::abs(run.amplitude); }) / degree,
        "of the steering wheel");
    add("yaw rate ratio after 1 s", "%", largest(runs, [](const Driven& run) { return run.early; }),
        "yaw rate 1 s after completion of steer over its second peak, the largest of all runs");
    add("yaw rate ratio after 1.75 s", "%", largest(runs, [](const Driven& run) { return run.late; }),
        "yaw rate 1.75 s after completion of steer over its second peak, the largest of all runs");
    const Driven& last = runs.back();
    add("lateral displacement", "m", last.displacement,
        "1.07 s after the beginning of steer, twice the integral of lateral acceleration; last run");
    add("lateral displacement of the path", "m", last.path,
        "likewise, of the center of mass across its first heading; last run");
    add("largest sideslip angle", "deg", largest(runs, [](const Driven& run) { return run.sideslip; }) / degree,
        "of the center of mass, of all runs");
}

std::vector<Setting> settings(const VehicleDescription&) {
    return {{"speed", "km/h", "from which the vehicle coasts", 80, 30, 120},
            {"amplitudes", "", "a direction; fewer are spread evenly, 0: all of the standard", 0, 0, 30,
             SettingKind::whole}};
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
    std::vector<Driven> runs;
    Histories histories;
    std::vector<double> fallen;  // amplitudes at which it fell over [deg]
    for (const double side : {1.0, -1.0}) {
        for (const double factor : wanted) {
            const auto part = [&](double n) { return slow_share + (1 - slow_share) * n / count; };
            const double n = static_cast<double>(runs.size());
            const dwell::Run planned{.amplitude = side * factor * test.angle, .factor = factor};
            const bool last = factor == wanted.back();
            Trial trial = dwell::drive_run(vehicle, options, speed, planned, last && options.keep_runs,
                                           share(options, part(n), part(n + 1)));
            if (trial.breaks_off()) {
                add_trial(outcome, std::move(trial));
                return outcome;
            }
            runs.push_back(dwell::driven(trial.history, planned.amplitude, factor));
            if (last) histories.add(trial.history, planned.amplitude);
            if (trial.stopped == Stopped::fell_over) fallen.push_back(std::abs(planned.amplitude) / degree);
            trial.stopped = Stopped::no;  // told once for all runs
            trial.complaints.clear();     // that a coasting car does not hold its speed
            add_trial(outcome, std::move(trial));
        }
    }
    if (!fallen.empty()) {
        outcome.notes.push_back(fmt::format("{} of {} runs: the vehicle fell over, from {:.0f} deg on", fallen.size(),
                                            runs.size(), std::ranges::min(fallen)));
    }
    add_figures(runs, outcome);
    dwell::add_verdicts(vehicle, runs, outcome);
    add_charts(vehicle, runs, outcome);
    histories.add_to(outcome);
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
