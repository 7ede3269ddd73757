// ISO 7401, sinusoidal input: first one period, from straight ahead; then sines of one amplitude that go on until all has
// settled, one frequency after the other, which give the frequency response line by line.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/spectrum.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

constexpr double interval = 0.005;  // between rows [s]
constexpr std::array frequencies{0.2, 0.25, 0.4, 0.5, 0.625, 0.8,
                                 1.0, 1.25, 1.6, 2.0, 2.5,   4.0};  // [Hz]; whole rows to a period
constexpr double measured = 2;                                      // of each frequency, and at least one period [s]
constexpr double share_of_period = 0.2;                             // of the time that both drives take [1]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {speed_setting(vehicle, 80, 80),
            acceleration_setting(vehicle, 4, 2, "in steady driving with the single period's amplitude"),
            {"frequency", "Hz", "of the single period", 0.5, 0.1, 4},
            {"sweep_lateral_acceleration", "m/s^2", "in steady driving with the lasting sines' amplitude",
             heavy ? 0.5 : 1.0, 0.05, 10},
            {"sweep_settling", "s", "at each frequency before it is measured, rounded up to whole periods",
             heavy ? 6.0 : 3.0, 0.5, 30}};
}

SignalDescription period(double angle, double frequency, double after) {
    return tabulated(
        [&](double time) {
            const double since = time - straight_ahead;
            return since <= 0 || since * frequency >= 1 ? 0
                                                        : angle * std::sin(2 * std::numbers::pi * frequency * since);
        },
        straight_ahead + std::ceil(1 / frequency + after));
}

// What one output does in the period: its two peaks after those of the steering wheel.
struct PeakPair {
    double first = 0, second = 0;          // in magnitude [unit]
    double first_lag = 0, second_lag = 0;  // behind the steering wheel's own [s]
};

PeakPair peaks_of(const History& history, const std::vector<double>& column, double frequency) {
    const Series steering = series_of(history, history.steering_wheel), output = series_of(history, column);
    const double middle = straight_ahead + 0.5 / frequency;
    const auto steered_first = peak(steering, Extreme::highest, straight_ahead, middle);
    const auto steered_second = peak(steering, Extreme::lowest, middle, middle + 0.5 / frequency);
    const auto first = peak(output, Extreme::highest, straight_ahead, middle + 0.5 / frequency);
    const auto second = peak(output, Extreme::lowest, middle);
    if (!steered_first || !steered_second || !first || !second) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        return {none, none, none, none};
    }
    return {first->value, -second->value, first->time - steered_first->time, second->time - steered_second->time};
}

void add_period(const History& history, double angle, double frequency, Outcome& outcome) {
    const auto add = [&](const std::string& of, const std::string& unit, double factor,
                         const std::vector<double>& column) {
        const PeakPair peaks = peaks_of(history, column, frequency);
        const double mean = 0.5 * (peaks.first + peaks.second) * factor;
        outcome.figures.push_back({of + " peak", unit, "mean of both peaks of the single period", mean});
        outcome.figures.push_back(
            {of + " peak gain", unit + "/deg", "that over the steering wheel's amplitude", mean / (angle / degree)});
        outcome.figures.push_back(
            {of + " first lag", "s", "of the first peak behind the steering wheel's", peaks.first_lag});
        outcome.figures.push_back({of + " second lag", "s", "of the second peak", peaks.second_lag});
    };
    add("yaw rate", "deg/s", 1 / degree, history.yaw_rate);
    add("lateral acceleration", "m/s^2", 1, history.lateral_acceleration);
    const auto curve = [&](const std::string& label, const std::vector<double>& column, double factor) {
        return io::Curve{.label = label, .x = history.time, .y = scaled(column, factor)};
    };
    outcome.charts.push_back({.title = "single period",
                              .x_label = "time [s]",
                              .y_label = "angle [deg], rate [deg/s], acceleration [m/s^2]",
                              .curves = {curve("steering wheel angle", history.steering_wheel, 1 / degree),
                                         curve("yaw rate", history.yaw_rate, 1 / degree),
                                         curve("lateral acceleration", history.lateral_acceleration, 1)}});
}

// One frequency of the sweep; whole periods throughout, so that the angle goes on evenly.
struct Tone {
    double frequency, from, measured_from, to;  // [Hz], [s]
};
std::vector<Tone> tones(double settling) {
    std::vector<Tone> out;
    double time = straight_ahead;
    for (const double f : frequencies) {
        const double settled = time + std::ceil(settling * f - 1e-9) / f,
                     end = settled + std::ceil(measured * f - 1e-9) / f;
        out.push_back({f, time, settled, end});
        time = end;
    }
    return out;
}

SignalDescription sweep(const std::vector<Tone>& tones, double angle) {
    return tabulated(
        [&](double time) {
            const auto now = std::ranges::find_if(tones, [&](const Tone& tone) { return time < tone.to; });
            if (time <= straight_ahead || now == tones.end()) return 0.0;
            return angle * std::sin(2 * std::numbers::pi * now->frequency * (time - now->from));
        },
        std::ceil(tones.back().to));
}

SteeringGain gain_of(const History& history, const std::vector<Tone>& tones) {
    SteeringGain out;
    const double rate = series_of(history, history.time).rate;
    for (const Tone& tone : tones) {
        const std::size_t first = row_at(history, tone.measured_from), count = row_at(history, tone.to) - first + 1;
        const auto part = [&](const std::vector<double>& column) { return std::span(column).subspan(first, count); };
        const auto response = [&](const std::vector<double>& column) {
            return response_at(part(history.steering_wheel), part(column), rate, tone.frequency);
        };
        out.frequency.push_back(tone.frequency);
        out.yaw_rate.push_back(response(history.yaw_rate));
        out.lateral_acceleration.push_back(response(history.lateral_acceleration));
    }
    return out;
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double speed = chosen.at("speed") * kilometer_per_hour, frequency = chosen.at("frequency");
    const auto amplitude = [&](const std::string& setting) {
        const Amplitude found = amplitude_for(vehicle, speed, chosen.at(setting));
        if (!found.note.empty()) outcome.notes.push_back(found.note);
        return found.angle;
    };
    const double small = amplitude("sweep_lateral_acceleration"), angle = amplitude("lateral_acceleration");
    const std::vector<Tone> planned = tones(chosen.at("sweep_settling"));
    ScenarioDescription scenario = steered_at(vehicle, options, speed, sweep(planned, small));
    scenario.name = "sweep";
    Trial swept = drive_share(vehicle, scenario, options, interval, {0, 1 - share_of_period});
    if (!take_whole(outcome, swept)) return outcome;
    const SteeringGain found = gain_of(swept.history, planned);
    add_gain(found, lowest_gain(found), theoretical_gain(vehicle, speed, found.frequency), outcome);
    constexpr double after = 3;  // the period [s]
    scenario = steered_at(vehicle, options, speed, period(angle, frequency, after));
    scenario.name = "single period";
    Trial trial = drive_share(vehicle, scenario, options, interval, {1 - share_of_period, 1});
    if (!take_whole(outcome, trial)) return outcome;
    add_period(trial.history, angle, frequency, outcome);
    outcome.figures.push_back({"steering wheel angle", "deg", "amplitude of the single period", angle / degree});
    outcome.verdicts.push_back(speed_held(trial.history, speed, straight_ahead - 1, straight_ahead));
    return outcome;
}

}  // namespace

Maneuver sine_steer() {
    return {.name = "sine_steer",
            .title = "Sinusoidal input of the steering wheel",
            .standard = "ISO 7401",
            .summary = "One period of a sine, and lasting sines of many frequencies: lags and the frequency response.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
