// Butterworth's low-pass filters, gain 1 / sqrt(1 + (f/cutoff)^2n) for an even order n (Butterworth 1930): forward, as
// an instrument would, and both ways, without phase. FMVSS 126 evaluates 12 poles without phase at 6 Hz: order 6,
// twice.
#pragma once

#include <span>
#include <vector>

#include "hamilcar/analysis/second_order_section.hpp"

namespace hamilcar {

struct LowPass {
    int order;      // of one pass; even
    double cutoff;  // where one pass leaves half the power [Hz]
};

// Its sections for a sampling rate [Hz]. Bilinear: the gain at f is the above with tan(pi f/rate) in place of f and
// tan(pi cutoff/rate) in place of the cutoff. std::invalid_argument for an order that is not even and positive and a
// cutoff that is not between zero and half the rate.
std::vector<SecondOrderSection> butterworth(const LowPass& filter, double rate);

// Forward over a series sampled at a rate [Hz]. What is slow comes 1 / (2 pi cutoff sin(pi / (2 order))) seconds late.
std::vector<double> low_passed(std::span<const double> series, double rate, const LowPass& filter);

// Forward and then backward: no delay, and the gain of one pass squared (a half at the cutoff). Before the first and
// after the last value the series goes on as its own reflection through that point until the filter has forgotten how
// it began: straight lines stay straight up to their ends, and the end values stay what they are, noise and all.
std::vector<double> low_passed_both_ways(std::span<const double> series, double rate, const LowPass& filter);

}  // namespace hamilcar
