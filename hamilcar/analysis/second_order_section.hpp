// Filters of sampled series as chains of second-order sections: made from an analog transfer function by the bilinear
// transform, s = c (1 - z^-1) / (1 + z^-1), and run over a series. Chains of low order keep their digits where one
// polynomial of high order would lose them (a corner at a thousandth of the sampling rate is common here).
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

namespace hamilcar {

// (n0 + n1 p + n2 p^2) / (d0 + d1 p + d2 p^2) with p = s / (2 pi corner).
struct AnalogSection {
    double corner;  // [Hz]
    std::array<double, 3> numerator, denominator;

    // At a frequency [Hz], of steady oscillations exp(+i 2 pi f t).
    std::complex<double> response(double frequency) const;
};

// y[i] = b0 x[i] + b1 x[i-1] + b2 x[i-2] - a1 y[i-1] - a2 y[i-2]
struct SecondOrderSection {
    double b0, b1, b2, a1, a2;
};

// Prewarped, so exact at the corner: a frequency f gets what the analog section has at corner tan(pi f/rate) /
// tan(pi corner/rate). std::invalid_argument unless 0 < corner < rate / 2, both [Hz].
SecondOrderSection bilinear(const AnalogSection& analog, double rate);

// A series through all sections, one after the other. They start as if the first value had been there forever, so an
// offset makes no step.
std::vector<double> filtered(std::span<const SecondOrderSection> sections, std::span<const double> series);

}  // namespace hamilcar
