// FMVSS 126 (49 CFR 571.126) and UN R140: coasting at 80 km/h, one period of a 0.7 Hz sine of the steering wheel with a dwell
// of 500 ms at its second peak, in growing amplitudes and both directions. Whether the yaw rate dies away afterwards tells
// stability, how far aside the vehicle gets tells whether it answers at all.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/dwell.hpp"
#include "hamilcar/maneuver/slow_steer.hpp"

namespace hamilcar {

namespace {

using dwell::Run, dwell::early, dwell::late, dwell::early_limit, dwell::late_limit;

constexpr double first_amplitude = 1.5, step = 0.5;  // [A]
constexpr double last_amplitude = 6.5;               // [A]; or, if that is more,
constexpr double min_last = 270, max_last = 300;     // [deg]

// Multiples of A from the first to the last, thinned evenly to at most `count` (0: all), the last always among them.
std::vector<double> factors(double angle, double lock, int count) {
    const double last = std::min({std::max(last_amplitude * angle, min_last), max_last, lock}) / angle;
    std::vector<double> all;
    for (double factor = first_amplitude; factor < last - 1e-9; factor += step) all.push_back(factor);
    all.push_back(last);
    const std::size_t n = all.size(), wanted = static_cast<std::size_t>(count);
    if (count == 0 || wanted >= n) return all;
    std::vector<double> out;
    for (std::size_t i = 0; i < wanted; ++i) out.push_back(wanted == 1 ? last : all[i * (n - 1) / (wanted - 1)]);
    return out;
}

void add_charts(TestRun& test, const std::vector<Run>& runs) {
    const auto add = [&](const std::string& title, const std::string& label, double limit, const char* unit,
                         double Run::*value) {
        test.chart(title, "amplitude of the steering wheel [deg]", label,
                   over_runs_by_side(runs, &Run::amplitude, &Run::size, value))
            .horizontal_marks = {{limit, fmt::format("limit {:g} {}", limit, unit)}};
    };
    add("Yaw rate 1 s after completion of steer", "over its peak [%]", early_limit, "%", &Run::early);
    add("Yaw rate 1.75 s after completion of steer", "over its peak [%]", late_limit, "%", &Run::late);
    add("Lateral displacement 1.07 s after the beginning of steer", "displacement [m]",
        dwell::displacement_limit(test.vehicle), "m", &Run::displacement);
}

// The drives with the largest amplitudes over time, with the instants at which the yaw rate is read.
void add_time_charts(TestRun& test, const std::vector<Recording>& largest) {
    const auto add = [&](const std::string& title, const std::string& label, auto&& values) {
        io::Chart& chart = test.chart(title + ", largest amplitude", "time [s]", label);
        for (const Recording& recording : largest) {
            const std::string side = &recording == &largest.front() ? "left first" : "right first";
            chart.curves.push_back({.label = side, .x = recording.time(), .y = values(recording)});
        }
        chart.vertical_marks = {{dwell::end + early, fmt::format("{:g} s after completion of steer", early)},
                                {dwell::end + late, fmt::format("{:g} s after", late)}};
    };
    add("Steering wheel", "angle [deg]",
        [](const Recording& r) { return scaled(r[channel::steering_wheel].values, 1); });
    add("Yaw rate", "yaw rate [deg/s]", [](const Recording& r) { return scaled(r[channel::yaw_rate].values, 1); });
    add("Lateral acceleration below 6 Hz", "lateral acceleration [m/s^2]",
        [](const Recording& r) { return smoothed(r[channel::lateral_acceleration]); });
    add("Lateral displacement of the path", "displacement [m]", [](const Recording& r) {
        const Series y = r[channel::y];
        return shifted(y.values, -y.values[sample_at(y, dwell::steering)]);
    });
}

void add_figures(TestRun& test, const std::vector<Run>& runs) {
    const auto largest = [&](auto value) {  // of all runs that show it
        double out = 0;
        for (const Run& run : runs) out = std::fmax(out, std::invoke(value, run));
        return out;
    };
    test.figure("largest amplitude", "deg", largest(&Run::size), "of the steering wheel");
    test.figure("yaw rate ratio after 1 s", "%", largest(&Run::early),
                "yaw rate 1 s after completion of steer over its second peak, the largest of all runs");
    test.figure("yaw rate ratio after 1.75 s", "%", largest(&Run::late),
                "yaw rate 1.75 s after completion of steer over its second peak, the largest of all runs");
    test.figure("lateral displacement", "m", runs.back().displacement,
                "1.07 s after the beginning of steer, twice the integral of lateral acceleration; last run");
    test.figure("lateral displacement of the path", "m", runs.back().path,
                "likewise, of the center of mass across its first heading; last run");
    test.figure("largest sideslip angle", "deg", largest(&Run::sideslip), "of the center of mass, of all runs");
}

std::vector<Setting> settings(const VehicleDescription&) {
    return {{"speed", "km/h", "from which the vehicle coasts", 80, 30, 120},
            {"amplitudes", "", "a direction; fewer are spread evenly, 0: all of the standard", 0, 0, 30,
             SettingKind::whole}};
}

void run(TestRun& test) {
    constexpr double slow_share = 0.2;  // of the maneuver [1]
    const auto slow = slow_steer(test, test["speed"], {0, slow_share});
    if (!slow) return;
    const double lock = steering_lock(test.vehicle) / degree;
    if (std::max(last_amplitude * slow->angle, min_last) > lock && lock < max_last) {
        test.note("the steering wheel's lock at {:.0f} deg ends the series", lock);
    }
    const auto wanted = factors(slow->angle, lock, static_cast<int>(test["amplitudes"]));
    const double width = (1 - slow_share) / (2.0 * static_cast<double>(wanted.size()));
    std::vector<Run> runs;
    std::vector<Recording> largest;
    std::vector<double> fallen;  // amplitudes at which it fell over [deg]
    for (const double side : {1.0, -1.0}) {
        for (const double factor : wanted) {
            const double from = slow_share + static_cast<double>(runs.size()) * width;
            const Run planned{.amplitude = side * factor * slow->angle, .factor = factor};
            const bool last = factor == wanted.back();
            Drive drive = dwell::drive(test, test["speed"], planned, {.share = {from, from + width}, .replay = last});
            if (!drive.breaks_off()) {
                runs.push_back(dwell::evaluated(drive.recording, planned.amplitude, factor));
                if (drive.stopped == Stopped::fell_over) fallen.push_back(std::abs(planned.amplitude));
                drive.stopped = Stopped::no;  // told once for all runs
                drive.warnings.clear();       // that a coasting car does not hold its speed
            }
            if (!test.take(drive)) return;
            if (last) largest.push_back(std::move(drive.recording));
        }
    }
    if (!fallen.empty()) {
        test.note("{} of {} runs: the vehicle fell over, from {:.0f} deg on", fallen.size(), runs.size(),
                  std::ranges::min(fallen));
    }
    add_figures(test, runs);
    dwell::add_verdicts(test, runs);
    add_charts(test, runs);
    add_time_charts(test, largest);
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
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
