#include "hamilcar/maneuver/steering_gain.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/curves.hpp"

namespace hamilcar {

namespace {

std::vector<double> magnitudes(const std::vector<std::complex<double>>& response, double factor = 1) {
    std::vector<double> out;
    for (const auto& one : response) out.push_back(factor * std::abs(one));
    return out;
}

void add_charts(TestRun& test, const SteeredOutput& of, const Answer& found, const Answer& theory) {
    const auto add = [&](const std::string& title, const std::string& label, std::vector<double> measured,
                         std::vector<double> linear) {
        test.chart(of.name + title, "frequency [Hz]", label,
                   {{.label = "test", .x = found.frequency, .y = std::move(measured), .points = true},
                    {.label = "linear theory", .x = theory.frequency, .y = std::move(linear)}});
    };
    add(" gain", "gain [" + of.unit + "]", magnitudes(found.response), magnitudes(theory.response));
    add(" phase", "phase [deg]", phases(found.response), phases(theory.response));
}

void add_peak(TestRun& test, const SteeredOutput& of, const Answer& found, const ComparedGain& steady) {
    const std::vector<double>& f = found.frequency;
    const std::vector<double> gain = magnitudes(found.response, 1 / steady.gain), phase = phases(found.response);
    const auto top = static_cast<std::size_t>(std::ranges::max_element(gain) - gain.begin());
    constexpr double lagging = -45;   // [deg]: that of a first-order lag at 1 / T
    constexpr double visible = 1.01;  // peak ratio from which there is a peak, and not just a spectrum's noise
    const bool line = steady.line > 0, peaks = !line || gain[top] >= visible;
    const std::string compared =
        line ? fmt::format("that at {:.3f} Hz, the lowest line that counts", steady.line) : "the steady one";
    test.figure(of.name + " peak ratio", "", gain[top], "largest gain over " + compared);
    test.figure(of.name + " peak frequency", "Hz", peaks ? f[top] : not_shown,
                peaks ? "of the largest gain" : "no gain is as much as 1 percent above " + compared);
    test.figure(of.name + " bandwidth", "Hz", falls_through(f, gain, std::sqrt(0.5)),
                "where the gain is down to 71 percent of " + compared);
    test.figure(of.name + " equivalent time", "s", 1 / (2 * std::numbers::pi * falls_through(f, phase, lagging)),
                "1 / (2 pi f) where the " + of.name + " lags by 45 degrees");
}

}  // namespace

const std::array<SteeredOutput, 2> steered_outputs{
    {{"yaw rate", "deg/s/deg", channel::yaw_rate, output_yaw_rate, true},
     {"lateral acceleration", "m/s^2/deg", channel::lateral_acceleration, output_lateral_acceleration, false}}};

Answer theoretical_answer(const VehicleDescription& vehicle, double speed, const SteeredOutput& output,
                          const std::vector<double>& frequency) {
    std::vector<std::complex<double>> response = steering_wheel_response(vehicle, speed, output.by_theory, frequency);
    if (response.empty()) return {};
    return {frequency, std::move(response), {}};
}

ComparedGain lowest_gain(const Answer& found) {
    return {found.frequency.empty() ? not_shown : std::abs(found.response.front())};
}

void add_answer(TestRun& test, const SteeredOutput& output, const Answer& found, const ComparedGain& compared,
                const Answer& theory) {
    if (found.frequency.empty()) return;
    if (compared.line > 0) {
        test.figure(
            output.name + " gain at the lowest line", output.unit, compared.gain,
            fmt::format("per angle of the steering wheel at {:.3f} Hz, the lowest line that counts", compared.line));
    } else {
        test.figure(output.name + " gain", output.unit, compared.gain, "steady, per angle of the steering wheel");
    }
    if (output.has_peak) add_peak(test, output, found, compared);
    const std::vector<double> phase = phases(found.response);
    for (const double at : {0.5, 1.0}) {
        test.figure(fmt::format("{} lag at {:g} Hz", output.name, at), "s",
                    -value_at(found.frequency, phase, at) / 360 / at, "phase as time");
    }
    add_charts(test, output, found, theory);
}

void add_coherence(TestRun& test, const std::vector<Answer>& answers) {
    io::Chart& chart = test.chart("coherence", "frequency [Hz]", "coherence [1]");
    for (std::size_t i = 0; i < answers.size(); ++i) {
        chart.curves.push_back(
            {.label = steered_outputs[i].name, .x = answers[i].frequency, .y = answers[i].coherence});
    }
}

}  // namespace hamilcar
