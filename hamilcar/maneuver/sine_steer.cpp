// ISO 7401, sinusoidal input: first one period, from straight ahead; then sines of one amplitude that go on until all has
// settled, one frequency after the other, which give the frequency response line by line.
#include <algorithm>
#include <array>
#include <cmath>

#include "hamilcar/analysis/spectrum.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

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

SignalDescription period(double angle, double frequency) {
    constexpr double after = 3;  // the period [s]
    return tabulated(
        [&](double time) {
            const double since = time - straight_ahead;
            return since <= 0 || since * frequency >= 1 ? 0
                                                        : angle * std::sin(2 * std::numbers::pi * frequency * since);
        },
        straight_ahead + std::ceil(1 / frequency + after));
}

// What one output does in the period: its two peaks after those of the steering wheel.
void add_peaks(TestRun& test, const Recording& recording, const std::string& of, const std::string& unit,
               const char* channel, double angle) {
    const Series steering = recording[channel::steering_wheel], output = recording[channel];
    const double half = 0.5 / test["frequency"], middle = straight_ahead + half;
    const auto steered_first = peak(steering, Extreme::highest, straight_ahead, middle);
    const auto steered_second = peak(steering, Extreme::lowest, middle, middle + half);
    const auto first = peak(output, Extreme::highest, straight_ahead, middle + half);
    const auto second = peak(output, Extreme::lowest, middle);
    const bool seen = steered_first && steered_second && first && second;
    const double mean = seen ? 0.5 * (first->value - second->value) : not_shown;
    test.figure(of + " peak", unit, mean, "mean of both peaks of the single period");
    test.figure(of + " peak gain", unit + "/deg", mean / (angle / degree), "that over the steering wheel's amplitude");
    test.figure(of + " first lag", "s", seen ? first->time - steered_first->time : not_shown,
                "of the first peak behind the steering wheel's");
    test.figure(of + " second lag", "s", seen ? second->time - steered_second->time : not_shown, "of the second peak");
}

void add_period(TestRun& test, const Recording& recording, double angle) {
    add_peaks(test, recording, "yaw rate", "deg/s", channel::yaw_rate, angle);
    add_peaks(test, recording, "lateral acceleration", "m/s^2", channel::lateral_acceleration, angle);
    test.chart("single period", "time [s]", "angle [deg], rate [deg/s], acceleration [m/s^2]",
               {over_time(recording, "steering wheel angle", channel::steering_wheel),
                over_time(recording, "yaw rate", channel::yaw_rate),
                over_time(recording, "lateral acceleration", channel::lateral_acceleration)});
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

Answer answer_of(const Recording& recording, const SteeredOutput& output, const std::vector<Tone>& tones) {
    Answer out;
    for (const auto& [frequency, from, measured_from, to] : tones) {
        const auto steered = between(recording[channel::steering_wheel], measured_from, to),
                   answered = between(recording[output.channel], measured_from, to);
        out.add(frequency, response_at(steered.values, answered.values, recording.rate(), frequency));
    }
    return out;
}

void run(TestRun& test) {
    const double speed = test["speed"];
    const double small = angle_for(test, speed, test["sweep_lateral_acceleration"]);
    const double angle = angle_for(test, speed, test["lateral_acceleration"]);
    const std::vector<Tone> planned = tones(test["sweep_settling"]);
    ScenarioDescription scenario = steered_at(test, speed, sweep(planned, small));
    scenario.name = "sweep";
    Drive swept = test.drive(scenario, {.share = {0, 1 - share_of_period}});
    if (!test.take_whole(swept)) return;
    for (const SteeredOutput& output : steered_outputs) {
        const Answer found = answer_of(swept.recording, output, planned);
        add_answer(test, output, found, lowest_gain(found),
                   theoretical_answer(test.vehicle, speed, output, found.frequency));
    }
    scenario = steered_at(test, speed, period(angle, test["frequency"]));
    scenario.name = "single period";
    Drive drive = test.drive(scenario, {.share = {1 - share_of_period, 1}});
    if (!test.take_whole(drive)) return;
    add_period(test, drive.recording, angle);
    test.figure("steering wheel angle", "deg", angle / degree, "amplitude of the single period");
    judge_speed(test, drive.recording);
}

}  // namespace

Maneuver sine_steer() {
    return {.name = "sine_steer",
            .title = "Sinusoidal input of the steering wheel",
            .standard = "ISO 7401",
            .summary = "One period of a sine, and lasting sines of many frequencies: lags and the frequency response.",
            .settings = settings,
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
