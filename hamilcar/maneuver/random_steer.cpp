// ISO 7401, random input: the steering wheel moves without a plan in a band of frequencies. Spectra of many pieces of the
// drive give the response and, by the coherence, how much of what the vehicle does comes from the steering wheel.
//
// The steering is a sum of sines, as many as repeat only after the whole drive, all alike and with random phases.
#include <Random123/philox.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "hamilcar/analysis/ride_weighting.hpp"
#include "hamilcar/analysis/spectrum.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

constexpr double onset = 1;                      // over which it grows [s]
constexpr std::size_t piece = 2048;              // rows of a spectrum, 20.48 s; half the drive at most
constexpr double trusted = 0.9;                  // coherence from which a line of the spectrum counts
constexpr double lowest = 0.1;                   // of the steering [Hz]
constexpr double first_line = 0.2, hair = 0.01;  // of the response; spectra have a line at 0.195 [Hz]
constexpr double judged = 2;                     // up to here the coherence is to be good [Hz]
constexpr std::uint32_t purpose = 0x73746572;    // tells these numbers from others of the same seed

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    constexpr double largest_seed = 1e6;
    return {speed_setting(vehicle, 80, 80),
            acceleration_setting(vehicle, 4, 2, "in steady driving with the largest angle of all"),
            {"highest_frequency", "Hz", "of the steering", 4, 1, 8},
            {"duration", "s", "of the steering", 120, 30, 1800},
            {"seed", "", "of the random phases", 1, 0, largest_seed, SettingKind::whole}};
}

// `angle`: the largest [rad].
SignalDescription random_steering(const TestRun& test, double angle) {
    const double duration = test["duration"], highest = test["highest_frequency"];
    std::vector<std::pair<double, double>> waves;  // angular frequency, phase
    const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(test["seed"]), purpose}};
    for (auto k = static_cast<std::uint32_t>(std::ceil(lowest * duration)); k / duration <= highest; ++k) {
        const auto random = r123::Philox4x32()(r123::Philox4x32::ctr_type{{k, 0, 0, 0}}, key);
        waves.emplace_back(2 * std::numbers::pi * k / duration,
                           2 * std::numbers::pi * std::ldexp(random[0] + 0.5, -32));
    }
    SignalDescription out = tabulated(
        [&](double time) {
            const double since = time - straight_ahead;
            if (since <= 0) return 0.0;
            double sum = 0;
            for (const auto& [w, phase] : waves) sum += std::sin(w * since + phase);
            return sum * std::min(since / onset, 1.0);
        },
        straight_ahead + duration);
    out.value = scaled(out.value, angle / largest_magnitude(out.value));
    return out;
}

// All lines from the first one on, coherent or not.
Answer answer_of(const Recording& recording, const SteeredOutput& output, double highest) {
    const auto part = [&](const char* channel) {
        const auto values = between(recording[channel], straight_ahead + onset).values;
        return std::vector<double>(values.begin(), values.end());
    };
    const std::vector<double> angle = part(channel::steering_wheel);
    const std::size_t segment = std::min(piece, std::bit_floor(angle.size() / 2));
    const FrequencyResponse all = frequency_response(angle, part(output.channel), recording.rate(), segment);
    Answer out;
    for (std::size_t k = 1; k < all.response.size(); ++k) {
        const double f = static_cast<double>(k) * all.resolution;
        if (f < first_line - hair || f > highest) continue;
        out.add(f, all.response[k]), out.coherence.push_back(all.coherence[k]);
    }
    return out;
}

// Those lines on which the output follows the steering wheel.
Answer trusted_lines(const Answer& all) {
    Answer out;
    for (std::size_t i = 0; i < all.frequency.size(); ++i) {
        if (all.coherence[i] >= trusted) out.add(all.frequency[i], all.response[i]);
    }
    return out;
}

// By the lines that count; there is no steady gain in such a drive.
void add_trusted(TestRun& test, const SteeredOutput& output, const Answer& all) {
    const Answer found = trusted_lines(all);
    if (found.frequency.empty()) {
        return test.note("no line of the {} has a coherence of {:g}: no figures", output.name, trusted);
    }
    add_answer(test, output, found, {lowest_gain(found).gain, found.frequency.front()},
               theoretical_answer(test.vehicle, test["speed"], output, found.frequency));
}

void judge_coherence(TestRun& test, const Answer& yaw_rate) {
    constexpr double good = 0.95;
    const double up_to = std::min(judged, test["highest_frequency"]);
    double worst = 1, where = first_line;
    for (std::size_t i = 0; i < yaw_rate.frequency.size() && yaw_rate.frequency[i] <= up_to; ++i) {
        if (yaw_rate.coherence[i] < worst) worst = yaw_rate.coherence[i], where = yaw_rate.frequency[i];
    }
    test.verdict(fmt::format("coherence of the yaw rate at least {:g} from {:g} to {:g} Hz", good, first_line, up_to),
                 worst >= good, fmt::format("{:.4f} at {:.2f} Hz", worst, where));
}

void run(TestRun& test) {
    const double angle = angle_for(test, test["speed"], test["lateral_acceleration"]);
    Drive drive = test.drive(steered_at(test, test["speed"], random_steering(test, angle)), {.interval = 0.01});
    if (!test.take_whole(drive)) return;
    std::vector<Answer> answers;
    for (const SteeredOutput& output : steered_outputs) {
        answers.push_back(answer_of(drive.recording, output, test["highest_frequency"]));
        add_trusted(test, output, answers.back());
    }
    add_coherence(test, answers);
    test.outcome.charts.back().horizontal_marks = {{trusted, "below, a line does not count"}};
    test.figure("steering wheel angle", "deg", angle / degree, "largest");
    test.figure("lateral acceleration", "m/s^2",
                root_mean_square(drive.recording[channel::lateral_acceleration].values), "root mean square");
    judge_speed(test, drive.recording);
    judge_coherence(test, answers.front());
}

}  // namespace

Maneuver random_steer() {
    return {.name = "random_steer",
            .title = "Random input of the steering wheel",
            .standard = "ISO 7401",
            .summary = "The steering wheel moves at random: the frequency response and its coherence from spectra.",
            .settings = settings,
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
