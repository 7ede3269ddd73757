// ISO 7401, pulse input: the steering wheel goes out and back within less than half a second, to the left and, when all has
// died away, to the right. Each transient over its input is the frequency response; what both sides have in common is
// linear, which the coherence shows.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

constexpr double decayed = 0.02;  // of a peak: what may be left at the end
constexpr double enough = 0.2;    // of the pulse's content at no frequency, down to which a response is read off
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

// Integral of a part times exp(-i 2 pi f t), by trapezoids: all parts begin and end at zero.
std::complex<double> transform(const Series& series, double from, double to, double frequency) {
    std::complex<double> sum = 0;
    for (std::size_t i = sample_at(series, from); i < sample_at(series, to); ++i) {
        sum += series.values[i] * std::polar(1.0, -2 * std::numbers::pi * frequency * (series.time(i) - from));
    }
    return sum / series.rate;
}

// Of both pulses together: the response and its coherence.
std::pair<std::complex<double>, double> response(const Recording& recording, const char* output, double each,
                                                 double frequency) {
    std::complex<double> cross = 0;
    double in = 0, out = 0;
    for (const double from : {straight_ahead, straight_ahead + each}) {
        const auto x = transform(recording[channel::steering_wheel], from, from + each, frequency);
        const auto y = transform(recording[output], from, from + each, frequency);
        cross += std::conj(x) * y, in += std::norm(x), out += std::norm(y);
    }
    return {cross / in, std::norm(cross) / (in * out)};
}

Answer answer_of(const Recording& recording, const SteeredOutput& output, double each) {
    const auto content = [&](double f) {
        return std::abs(transform(recording[channel::steering_wheel], straight_ahead, straight_ahead + each, f));
    };
    const double all = content(0);
    Answer out;
    for (int k = 1; k * finest <= highest && content(k * finest) >= enough * all; ++k) {
        const auto [gain, coherence] = response(recording, output.channel, each, k * finest);
        out.add(k * finest, gain), out.coherence.push_back(coherence);
    }
    return out;
}

void judge_decay(TestRun& test, const Series& yaw_rate, double each) {
    constexpr double last = 0.5;  // before the end of each part [s]
    double left = 0;
    for (std::size_t i = sample_at(yaw_rate, straight_ahead) + 1; i < yaw_rate.values.size(); ++i) {
        const double since = std::fmod(yaw_rate.time(i) - straight_ahead, each);
        if (since > each - last) left = std::max(left, std::abs(yaw_rate.values[i]));
    }
    const double largest = largest_magnitude(yaw_rate.values);
    test.verdict("yaw rate down to 2 percent of its peak at the end of each transient", left <= decayed * largest,
                 fmt::format("{:.2g} percent", 100 * left / largest));
}

void run(TestRun& test) {
    const double speed = test["speed"], each = test["duration"];
    const double angle = angle_for(test, speed, test["lateral_acceleration"]);
    Drive drive = test.drive(steered_at(test, speed, pulses(angle, std::min(test["width"], each), each)));
    if (!test.take_whole(drive)) return;
    const Recording& recording = drive.recording;
    std::vector<Answer> answers;
    for (const SteeredOutput& output : steered_outputs) {
        const Answer& found = answers.emplace_back(answer_of(recording, output, each));
        const double steady = std::abs(response(recording, output.channel, each, 0).first);
        add_answer(test, output, found, {steady}, theoretical_answer(test.vehicle, speed, output, found.frequency));
    }
    add_coherence(test, answers);
    const auto largest = peak(recording[channel::lateral_acceleration], Extreme::largest);
    test.figure("steering wheel angle", "deg", angle / degree, "of the pulses");
    test.figure("largest lateral acceleration", "m/s^2", std::abs(largest->value), "after the pulses");
    judge_speed(test, recording);
    judge_decay(test, recording[channel::yaw_rate], each);
}

}  // namespace

Maneuver pulse_steer() {
    return {
        .name = "pulse_steer",
        .title = "Pulse input of the steering wheel",
        .standard = "ISO 7401",
        .summary = "The steering wheel goes out and back at once: the frequency response from one transient a side.",
        .settings = settings,
        .unsupported_reason = needs_steering_and_drive,
        .run = run};
}

}  // namespace hamilcar
