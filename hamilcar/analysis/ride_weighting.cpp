#include "hamilcar/analysis/ride_weighting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/analysis/second_order_section.hpp"

namespace hamilcar {

namespace {

// f1 to f6 [Hz] and Q4 to Q6 of ISO 2631-1, annex A. The band's edges have Butterworth's 1/Q = sqrt(2), and f3 = f4.
std::vector<AnalogSection> sections_of(RideWeighting weighting) {
    constexpr double f1 = 0.4, f2 = 100, root = std::numbers::sqrt2, Q4 = 0.63;
    const double f4 = weighting == RideWeighting::vertical ? 12.5 : 2;
    std::vector<AnalogSection> sections{{f1, {0, 0, 1}, {1, root, 1}},     // high pass
                                        {f2, {1, 0, 0}, {1, root, 1}},     // low pass
                                        {f4, {1, 1, 0}, {1, 1 / Q4, 1}}};  // acceleration below, velocity above
    if (weighting == RideWeighting::vertical) {
        constexpr double f5 = 2.37, Q5 = 0.91, f6 = 3.35, Q6 = 0.91, r = f5 / f6;
        sections.push_back({f6, {r * r, r / Q5, 1}, {1, 1 / Q6, 1}});  // the step, up by (f6/f5)^2
    }
    return sections;
}

}  // namespace

std::complex<double> weighting_response(RideWeighting weighting, double frequency) {
    std::complex<double> gain = 1;
    for (const AnalogSection& section : sections_of(weighting)) gain *= section.response(frequency);
    return gain;
}

std::vector<double> ride_weighted(RideWeighting weighting, std::span<const double> acceleration, double rate) {
    std::vector<SecondOrderSection> sections;
    for (const AnalogSection& section : sections_of(weighting)) sections.push_back(bilinear(section, rate));
    return filtered(sections, acceleration);
}

double root_mean_square(std::span<const double> weighted) {
    if (weighted.empty()) return 0;
    double sum = 0;
    for (const double a : weighted) sum += a * a;
    return std::sqrt(sum / static_cast<double>(weighted.size()));
}

double vibration_dose(std::span<const double> weighted, double rate) {
    double sum = 0;
    for (const double a : weighted) sum += (a * a) * (a * a);
    return std::sqrt(std::sqrt(sum / rate));
}

double largest_running_rms(std::span<const double> weighted, double rate) {
    const auto second = static_cast<std::size_t>(std::max(1.0, std::round(rate)));
    std::vector<double> sums{0};  // of the squares so far
    sums.reserve(weighted.size() + 1);
    double largest = 0;
    for (const double a : weighted) {
        sums.push_back(sums.back() + a * a);
        const std::size_t end = sums.size() - 1;
        largest = std::max(largest, sums[end] - sums[end - std::min(end, second)]);
    }
    return std::sqrt(largest / static_cast<double>(second));
}

double crest_factor(std::span<const double> weighted) {
    const double rms = root_mean_square(weighted);
    double largest = 0;
    for (const double a : weighted) largest = std::max(largest, std::abs(a));
    return rms > 0 ? largest / rms : 0;
}

double comfort_total(double x, double y, double z) {
    return std::sqrt(x * x + y * y + z * z);
}

}  // namespace hamilcar
