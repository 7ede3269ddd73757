// ISO 7401, pulse input: the steering wheel goes out and back within less than half a second, to the left and, when all has
// died away, to the right. Each transient over its input is the frequency response; what both sides have in common is
// linear, which the coherence shows.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

constexpr double interval = 0.005;  // between rows [s]
constexpr double decayed = 0.02;    // of a peak: what may be left at the end
constexpr double enough = 0.2;      // of the pulse's content at no frequency, down to which a response is read off
constexpr double finest = 0.05, highest = 5;  // of frequencies [Hz]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    return {speed_setting(vehicle, 80, 80),
            acceleration_setting(vehicle, 4, 2, "in steady driving with the pulse's largest angle"),
            {"width", "s", "of the pulse", 0.4, 0.1, 2},
            {"duration", "s", "from each pulse on", is_heavy(vehicle) ? 15.0 : 7.0, 2, 60}};
}

// Two half waves of a squared sine, which have a rate without jumps.
SignalDescription pulses(double angle, double width, double each) {
    const auto pulse = [&](double time) {
        if (time <= 0 || time >= width) return 0.0;
        const double s = std::sin(std::numbers::pi * time / width);
        return angle * s * s;
    };
    return tabulated([&](double time) { return pulse(time - straight_ahead) - pulse(time - straight_ahead - each); },
                     straight_ahead + 2 * each);
}

// Integral of a column's part times exp(-i 2 pi f t), by trapezoids: all parts begin and end at zero.
std::complex<double> transform(const History& history, const std::vector<double>& column, double from, double to,
                               double frequency) {
    std::complex<double> sum = 0;
    const std::size_t first = row_at(history, from), last = row_at(history, to);
    for (std::size_t i = first; i < last; ++i) {
        const double turned = 2 * std::numbers::pi * frequency * (history.time[i] - from);
        sum += column[i] * std::polar(1.0, -turned);
    }
    return sum / series_of(history, column).rate;
}

// Both pulses together.
struct Answer {
    std::complex<double> response;
    double coherence;
};
Answer answer(const History& history, const std::vector<double>& output, double each, double frequency) {
    std::complex<double> cross = 0;
    double in = 0, out = 0;
    for (const double from : {straight_ahead, straight_ahead + each}) {
        const auto x = transform(history, history.steering_wheel, from, from + each, frequency);
        const auto y = transform(history, output, from, from + each, frequency);
        cross += std::conj(x) * y, in += std::norm(x), out += std::norm(y);
    }
    return {cross / in, std::norm(cross) / (in * out)};
}

SteeringGain gain_of(const History& history, double each) {
    SteeringGain out;
    const auto content = [&](double f) {
        return std::abs(transform(history, history.steering_wheel, straight_ahead, straight_ahead + each, f));
    };
    const double all = content(0);
    for (int k = 1; k * finest <= highest && content(k * finest) >= enough * all; ++k) {
        const Answer yaw = answer(history, history.yaw_rate, each, k * finest);
        const Answer lateral = answer(history, history.lateral_acceleration, each, k * finest);
        out.frequency.push_back(k * finest);
        out.yaw_rate.push_back(yaw.response), out.yaw_coherence.push_back(yaw.coherence);
        out.lateral_acceleration.push_back(lateral.response), out.lateral_coherence.push_back(lateral.coherence);
    }
    return out;
}

Verdict died_away(const History& history, double each) {
    double largest = 0, left = 0;
    constexpr double last = 0.5;  // before the end of each part [s]
    for (std::size_t i = 0; i < history.size(); ++i) {
        const double here = std::abs(history.yaw_rate[i]),
                     since = std::fmod(std::max(0.0, history.time[i] - straight_ahead), each);
        largest = std::max(largest, here);
        if (history.time[i] > straight_ahead && since > each - last) left = std::max(left, here);
    }
    return {"yaw rate down to 2 percent of its peak at the end of each transient", left <= decayed * largest,
            fmt::format("{:.2g} percent", 100 * left / largest)};
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double speed = chosen.at("speed") * kilometer_per_hour, each = chosen.at("duration");
    const Amplitude amplitude = amplitude_for(vehicle, speed, chosen.at("lateral_acceleration"));
    if (!amplitude.note.empty()) outcome.notes.push_back(amplitude.note);
    ScenarioDescription scenario =
        steered_at(vehicle, options, speed, pulses(amplitude.angle, std::min(chosen.at("width"), each), each));
    scenario.name = "pulse_steer";
    Trial trial = drive_share(vehicle, scenario, options, interval);
    if (!take_whole(outcome, trial)) return outcome;
    const History& history = trial.history;
    const SteeringGain found = gain_of(history, each);
    const SteadyGain steady{std::abs(answer(history, history.yaw_rate, each, 0).response),
                            std::abs(answer(history, history.lateral_acceleration, each, 0).response)};
    add_gain(found, steady, theoretical_gain(vehicle, speed, found.frequency), outcome);
    const auto largest = peak(series_of(history, history.lateral_acceleration), Extreme::largest);
    outcome.figures.push_back({"steering wheel angle", "deg", "of the pulses", amplitude.angle / degree});
    outcome.figures.push_back({"largest lateral acceleration", "m/s^2", "after the pulses", std::abs(largest->value)});
    outcome.verdicts.push_back(speed_held(history, speed, straight_ahead - 1, straight_ahead));
    outcome.verdicts.push_back(died_away(history, each));
    return outcome;
}

}  // namespace

Maneuver pulse_steer() {
    return {
        .name = "pulse_steer",
        .title = "Pulse input of the steering wheel",
        .standard = "ISO 7401",
        .summary = "The steering wheel goes out and back at once: the frequency response from one transient a side.",
        .settings = settings,
        .obstacle = needs_steering_and_drive,
        .drive = drive_it,
        .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
