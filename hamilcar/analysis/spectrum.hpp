// Series over time by frequency: power spectra, how an output answers an input in a random or swept test, and how it
// answers a single sine. Rates and frequencies in Hz; a phase is positive where the output leads.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "hamilcar/road/road_spectrum.hpp"

namespace hamilcar {

// One-sided power spectral density by Welch's method [unit^2/Hz], as of a road's profile: Hann windows over segments of
// `segment` samples, a power of two, that overlap by three quarters, each less its straight line. The resolution is
// rate / segment. std::length_error for a segment that is none or longer than the series.
Spectrum power_spectrum(const std::vector<double>& series, double rate, std::size_t segment);

// What an output makes of an input, by frequency.
struct FrequencyResponse {
    double resolution = 0;                       // [Hz]
    std::vector<std::complex<double>> response;  // at multiples of the resolution [output's unit / input's]
    // How much of the output's power comes linearly from the input, 0 to 1. Means something where segments are many:
    // of one segment it is 1.
    std::vector<double> coherence;
};

// H1, cross-spectrum over the input's spectrum: noise in the output averages out, noise in the input makes it small.
// Windows and segments as above. Where the input has no power, response and coherence are zero. std::length_error also
// for series of unequal length.
FrequencyResponse frequency_response(const std::vector<double>& input, const std::vector<double>& output, double rate,
                                     std::size_t segment);

// offset + Re(amplitude exp(i 2 pi f t)), t from the series' first value on [s]. A sine has the phase -pi/2.
struct FittedSine {
    std::complex<double> amplitude;  // [unit]
    double offset;                   // [unit]
    double residual;                 // root mean square of what is left [unit]
};

// Least squares over the last whole periods: a transient at the start should be cut off. std::length_error where there
// is no whole period or fewer than three samples, std::invalid_argument unless 0 < frequency < rate / 2.
FittedSine fitted_sine(std::span<const double> series, double rate, double frequency);

// Gain and phase of an output under an input that oscillates at one frequency: abs and arg of the quotient of both
// amplitudes. std::length_error for series of unequal length, else as fitted_sine.
std::complex<double> response_at(std::span<const double> input, std::span<const double> output, double rate,
                                 double frequency);

}  // namespace hamilcar
