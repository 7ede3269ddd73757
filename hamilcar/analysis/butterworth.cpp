#include "hamilcar/analysis/butterworth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

namespace {

// Poles lie on the circle of the cutoff, in pairs; of pair k, -sine is the real part.
double sine_of_pair(int k, int order) {
    return sincos(std::numbers::pi * (2 * k + 1) / (2 * order)).sine;
}

// Until the slowest pair has decayed to a millionth [samples].
std::size_t settling(double rate, const LowPass& filter) {
    const double decay = 2 * std::numbers::pi * filter.cutoff * sine_of_pair(0, filter.order);  // [1/s]
    return static_cast<std::size_t>(std::ceil(std::log(1e6) / decay * rate));
}

}  // namespace

std::vector<SecondOrderSection> butterworth(const LowPass& filter, double rate) {
    if (filter.order < 2 || filter.order % 2 != 0) throw std::invalid_argument("a low-pass filter's order is even");
    std::vector<SecondOrderSection> sections;
    for (int k = 0; k < filter.order / 2; ++k)
        sections.push_back(bilinear({filter.cutoff, {1, 0, 0}, {1, 2 * sine_of_pair(k, filter.order), 1}}, rate));
    return sections;
}

std::vector<double> low_passed(std::span<const double> series, double rate, const LowPass& filter) {
    return filtered(butterworth(filter, rate), series);
}

std::vector<double> low_passed_both_ways(std::span<const double> series, double rate, const LowPass& filter) {
    const std::vector<SecondOrderSection> sections = butterworth(filter, rate);
    if (series.empty()) return {};
    const std::size_t size = series.size(), more = std::min(size - 1, settling(rate, filter));
    std::vector<double> longer(size + 2 * more);
    std::ranges::copy(series, longer.begin() + static_cast<std::ptrdiff_t>(more));
    for (std::size_t i = 1; i <= more; ++i) {
        longer[more - i] = 2 * series.front() - series[i];
        longer[more + size - 1 + i] = 2 * series.back() - series[size - 1 - i];
    }
    for (int pass = 0; pass < 2; ++pass) {
        longer = filtered(sections, longer);
        std::ranges::reverse(longer);
    }
    const auto begin = longer.begin() + static_cast<std::ptrdiff_t>(more);
    return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace hamilcar
