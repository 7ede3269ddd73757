// How a vehicle answers its steering wheel by frequency: what tests of ISO 7401 with pulses, sines and random steering find,
// and its diagrams and characteristic values.
#pragma once

#include <array>
#include <complex>

#include "hamilcar/analysis/steering_wheel_response.hpp"
#include "hamilcar/maneuver/amplitude.hpp"

namespace hamilcar {

// An output of the vehicle whose answer is looked at.
struct SteeredOutput {
    std::string name, unit;  // "yaw rate", "deg/s/deg"
    const char* channel;
    LinearOutput by_theory;
    bool has_peak;  // whether its largest gain, bandwidth and equivalent time are characteristic values
};
extern const std::array<SteeredOutput, 2> steered_outputs;  // yaw rate, lateral acceleration

// Of one output, per angle of the steering wheel; a positive phase leads.
struct Answer {
    std::vector<double> frequency;               // ascending, above zero [Hz]
    std::vector<std::complex<double>> response;  // [1/s] or [m/s^2/deg]
    std::vector<double> coherence;               // [1]; empty where a test has none

    void add(double f, std::complex<double> gain) { frequency.push_back(f), response.push_back(gain); }
};

// Straight ahead at a speed [m/s], by the exact linearization; empty where there is none.
Answer theoretical_answer(const VehicleDescription& vehicle, double speed, const SteeredOutput& output,
                          const std::vector<double>& frequency);

// What gains are compared with: that at no frequency, where the test shows it, else that at the lowest one.
struct ComparedGain {
    double gain;  // [1/s] or [m/s^2/deg]
    // Of the line of a spectrum that stands for it; 0: it is steady. Spectra are noisy: a peak that is less than 1 percent
    // above it is none [Hz].
    double line = 0;
};
ComparedGain lowest_gain(const Answer& found);

// Gain, lags, what the output's peak has, and the diagrams with linear theory beside the test. Nothing of an empty answer.
void add_answer(TestRun& test, const SteeredOutput& output, const Answer& found, const ComparedGain& compared,
                const Answer& theory);
// The diagram of all outputs' coherences.
void add_coherence(TestRun& test, const std::vector<Answer>& answers);

}  // namespace hamilcar
