// ISO 7401, random input: the steering wheel moves without a plan in a band of frequencies. Spectra of many pieces of the
// drive give the response and, by the coherence, how much of what the vehicle does comes from the steering wheel.
//
// The steering is a sum of sines, as many as repeat only after the whole drive, all alike and with random phases.
#include <fmt/format.h>

#include <Random123/philox.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "hamilcar/analysis/spectrum.hpp"
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steering_gain.hpp"

namespace hamilcar {

namespace {

constexpr double onset = 1;                      // over which it grows [s]
constexpr double interval = 0.01;                // between rows [s]
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

// Largest angle 1 [1].
SignalDescription random_steering(const Settings& chosen) {
    const double duration = chosen.at("duration"), highest = chosen.at("highest_frequency");
    std::vector<std::pair<double, double>> waves;  // angular frequency, phase
    const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(chosen.at("seed")), purpose}};
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
    double largest = 0;
    for (const double value : out.value) largest = std::max(largest, std::abs(value));
    out.value = scaled(std::move(out.value), 1 / largest);
    return out;
}

// All lines from the first one on, coherent or not.
SteeringGain gain_of(const History& history, double highest) {
    const auto from = static_cast<std::ptrdiff_t>(row_at(history, straight_ahead + onset));
    const auto part = [&](const std::vector<double>& column) {
        return std::vector<double>(column.begin() + from, column.end());
    };
    const std::vector<double> angle = part(history.steering_wheel);
    const double rate = series_of(history, history.time).rate;
    const std::size_t segment = std::min(piece, std::bit_floor(angle.size() / 2));
    const FrequencyResponse yaw = frequency_response(angle, part(history.yaw_rate), rate, segment);
    const FrequencyResponse lateral = frequency_response(angle, part(history.lateral_acceleration), rate, segment);
    SteeringGain out;
    for (std::size_t k = 1; k < yaw.response.size(); ++k) {
        const double f = static_cast<double>(k) * yaw.resolution;
        if (f < first_line - hair || f > highest) continue;
        out.frequency.push_back(f);
        out.yaw_rate.push_back(yaw.response[k]), out.yaw_coherence.push_back(yaw.coherence[k]);
        out.lateral_acceleration.push_back(lateral.response[k]);
        out.lateral_coherence.push_back(lateral.coherence[k]);
    }
    return out;
}

// Those lines on which an output follows the steering wheel.
SteeringGain trusted_lines(const SteeringGain& all, std::vector<double> SteeringGain::*coherence) {
    SteeringGain out;
    for (std::size_t i = 0; i < all.frequency.size(); ++i) {
        if ((all.*coherence)[i] < trusted) continue;
        out.frequency.push_back(all.frequency[i]);
        out.yaw_rate.push_back(all.yaw_rate[i]), out.lateral_acceleration.push_back(all.lateral_acceleration[i]);
    }
    return out;
}

// Figures and diagrams of each output by the lines that count for it; there is no steady gain in such a drive.
void add_response(const VehicleDescription& vehicle, double speed, const SteeringGain& all, Outcome& outcome) {
    const auto add = [&](const std::string& of, std::vector<double> SteeringGain::*coherence, auto&& add_figures) {
        const SteeringGain found = trusted_lines(all, coherence);
        if (found.frequency.empty()) {
            outcome.notes.push_back(fmt::format("no line of the {} has a coherence of {:g}: no figures", of, trusted));
            return;
        }
        SteadyGain compared = lowest_gain(found);
        compared.line = found.frequency.front();
        add_figures(found, compared, theoretical_gain(vehicle, speed, found.frequency), outcome);
    };
    add("yaw rate", &SteeringGain::yaw_coherence, add_yaw_rate_gain);
    add("lateral acceleration", &SteeringGain::lateral_coherence, add_lateral_acceleration_gain);
    outcome.charts.push_back(
        {.title = "coherence",
         .x_label = "frequency [Hz]",
         .y_label = "coherence [1]",
         .curves = {{.label = "yaw rate", .x = all.frequency, .y = all.yaw_coherence},
                    {.label = "lateral acceleration", .x = all.frequency, .y = all.lateral_coherence}},
         .horizontal_marks = {{trusted, "below, a line does not count"}}});
}

Verdict coherent(const SteeringGain& all, double highest) {
    constexpr double good = 0.95;
    const double up_to = std::min(judged, highest);
    double least = 1, where = first_line;
    for (std::size_t i = 0; i < all.frequency.size() && all.frequency[i] <= up_to; ++i) {
        if (all.yaw_coherence[i] < least) least = all.yaw_coherence[i], where = all.frequency[i];
    }
    return {fmt::format("coherence of the yaw rate at least {:g} from {:g} to {:g} Hz", good, first_line, up_to),
            least >= good, fmt::format("{:.4f} at {:.2f} Hz", least, where)};
}

double root_mean_square(const std::vector<double>& values) {
    double squares = 0;
    for (const double value : values) squares += value * value;
    return std::sqrt(squares / static_cast<double>(values.size()));
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double speed = chosen.at("speed") * kilometer_per_hour, highest = chosen.at("highest_frequency");
    const Amplitude amplitude = amplitude_for(vehicle, speed, chosen.at("lateral_acceleration"));
    if (!amplitude.note.empty()) outcome.notes.push_back(amplitude.note);
    SignalDescription steering = random_steering(chosen);
    steering.value = scaled(std::move(steering.value), amplitude.angle);
    ScenarioDescription scenario = steered_at(vehicle, options, speed, std::move(steering));
    scenario.name = "random_steer";
    Trial trial = drive_share(vehicle, scenario, options, interval);
    if (!take_whole(outcome, trial)) return outcome;
    const History& history = trial.history;
    const SteeringGain all = gain_of(history, highest);
    add_response(vehicle, speed, all, outcome);
    outcome.figures.push_back({"steering wheel angle", "deg", "largest", amplitude.angle / degree});
    outcome.figures.push_back(
        {"lateral acceleration", "m/s^2", "root mean square", root_mean_square(history.lateral_acceleration)});
    outcome.verdicts.push_back(speed_held(history, speed, straight_ahead - 1, straight_ahead));
    outcome.verdicts.push_back(coherent(all, highest));
    return outcome;
}

}  // namespace

Maneuver random_steer() {
    return {.name = "random_steer",
            .title = "Random input of the steering wheel",
            .standard = "ISO 7401",
            .summary = "The steering wheel moves at random: the frequency response and its coherence from spectra.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
