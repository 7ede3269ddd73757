// How a vehicle answers its steering wheel by frequency: what tests of ISO 7401 with pulses, sines and random steering find,
// and its diagrams and characteristic values.
#pragma once

#include <complex>

#include "hamilcar/maneuver/lateral.hpp"

namespace hamilcar {

// Responses per radian of the steering wheel; a positive phase leads.
struct SteeringGain {
    std::vector<double> frequency;                           // ascending, above zero [Hz]
    std::vector<std::complex<double>> yaw_rate;              // [1/s]
    std::vector<std::complex<double>> lateral_acceleration;  // [m/s^2/rad]
    std::vector<double> yaw_coherence, lateral_coherence;    // [1]; empty where a test has none
};

// Straight ahead at a speed [m/s], by the exact linearization; empty where there is none.
SteeringGain theoretical_gain(const VehicleDescription& vehicle, double speed, const std::vector<double>& frequency);

// What gains are compared with: those at no frequency, where the test shows them, else those at the lowest one.
struct SteadyGain {
    double yaw_rate, lateral_acceleration;  // [1/s], [m/s^2/rad]
    // Of the line of a spectrum that stands for them; 0: they are steady. Spectra are noisy: a peak that is less than 1 percent
    // above it is none [Hz].
    double line = 0;
};
SteadyGain lowest_gain(const SteeringGain& found);
// Gain, peak ratio, bandwidth, equivalent time, lags and the diagrams with linear theory beside the test.
void add_yaw_rate_gain(const SteeringGain& found, const SteadyGain& steady, const SteeringGain& theory,
                       Outcome& outcome);
// Gain, lags and diagrams.
void add_lateral_acceleration_gain(const SteeringGain& found, const SteadyGain& steady, const SteeringGain& theory,
                                   Outcome& outcome);
// Both, and their coherence where the test has it.
void add_gain(const SteeringGain& found, const SteadyGain& steady, const SteeringGain& theory, Outcome& outcome);

// Phases without jumps of a turn, from the first one on, which lies within half a turn of zero [deg].
std::vector<double> phases(const std::vector<std::complex<double>>& response);
// Where a curve first falls through a level, linear between points; NaN where it does not.
double falls_through(const std::vector<double>& x, const std::vector<double>& y, double level);

}  // namespace hamilcar
