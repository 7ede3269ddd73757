// How much of an acceleration people feel, after ISO 2631-1:1997: its frequency weightings and the figures made of a
// weighted acceleration. The weightings are the standard's analog filters (parameters as in ISO 8041:2005): a band from
// 0.4 to 100 Hz, a passage from acceleration to velocity and, for the vertical, a step.
//
// Series are sampled at a constant rate, without gravity or with: a constant is filtered out from the first value on.
#pragma once

#include <complex>
#include <span>
#include <vector>

namespace hamilcar {

enum class RideWeighting {
    vertical,   // Wk: z on a seat
    horizontal  // Wd: x and y on a seat
};

// The exact complex gain at a frequency [Hz], for oscillations exp(+i 2 pi f t).
std::complex<double> weighting_response(RideWeighting weighting, double frequency);

// An acceleration as felt, in its own unit, sampled at a rate [Hz]. The sections are bilinear, each exact at its own
// corner: sampled at 1 kHz the gain is at most 0.4 percent off the exact one up to 40 Hz and 1.4 percent at 80 Hz;
// sampled at 500 Hz, 1.6 and 5.8 percent. std::invalid_argument for rates of 200 Hz and less.
std::vector<double> ride_weighted(RideWeighting weighting, std::span<const double> acceleration, double rate);

// The figures below are of weighted accelerations [m/s^2]; zero of an empty series. A value stands for one interval.

// a_w [m/s^2].
double root_mean_square(std::span<const double> weighted);

// VDV, the fourth root of the integral of the fourth power [m/s^1.75].
double vibration_dose(std::span<const double> weighted, double rate);

// MTVV, the largest root mean square over any second [m/s^2]. Before the series there was rest.
double largest_running_rms(std::span<const double> weighted, double rate);

// Largest magnitude over root mean square; zero at rest. Above 9 the standard wants VDV or MTVV beside a_w.
double crest_factor(std::span<const double> weighted);

// Of the three root mean squares on a seat's surface, each axis with the factor 1 that comfort asks for (health: 1.4
// for x and y) [m/s^2].
double comfort_total(double x, double y, double z);

}  // namespace hamilcar
