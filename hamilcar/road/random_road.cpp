// The table of a random road: harmonics of its length, then one Fourier transform. Random numbers come from Philox, with the
// harmonic as counter and seed, case and stream as key, so they do not depend on the machine or on the order of evaluation.
#include "hamilcar/road/random_road.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "hamilcar/math/fourier.hpp"
#include "hamilcar/road/road_spectrum.hpp"

namespace hamilcar {
namespace {

constexpr double min_period = 1000;            // [m]: at least ten of the longest waves
constexpr double max_spacing = 0.1;            // [m]: three and a half knots per shortest wave
constexpr std::uint32_t purpose = 0x726f6164;  // separates these numbers from others with the same seed

// Random numbers of one harmonic.
struct Draw {
    double phase;  // of c [rad]
    double side;   // 1: d leads c by a quarter wave, -1: it lags
};

Draw draw(const RandomRoadDescription& d, std::uint32_t harmonic) {
    const r123::Philox4x32::ctr_type counter{{harmonic, d.case_number, d.stream, purpose}};
    const r123::Philox4x32::key_type key{
        {static_cast<std::uint32_t>(d.seed), static_cast<std::uint32_t>(d.seed >> 32)}};
    const auto random = r123::Philox4x32()(counter, key);
    return {2 * std::numbers::pi * std::ldexp(random[0] + 0.5, -32), (random[1] & 1) != 0 ? 1.0 : -1.0};
}

// Cross-spectrum over spectrum of two parallel lines on a surface whose density goes as (kx^2 + ky^2)^(-3/2): Basset's
// integral of cos(ky b) (kx^2 + ky^2)^(-3/2) over ky, over the same with b = 0.
double coherence(double frequency, double width) {
    const double z = 2 * std::numbers::pi * frequency * width;
    return z > 0 ? z * std::cyl_bessel_k(1.0, z) : 1;
}

}  // namespace

RandomRoad::RandomRoad(const RandomRoadDescription& d)
    : along_(d.start, d.length > 0 ? d.start + d.length : everywhere, d.fade),
      per_meter_(1 / d.spacing),
      per_half_width_(2 / d.track_width) {
    if (!(d.spacing > 0 && d.spacing <= max_spacing)) throw std::invalid_argument("spacing of a road: 0 to 0.1 m");
    if (!(d.track_width > 0)) throw std::invalid_argument("the track width of a road is above zero");
    const double roughness = class_roughness(d.road_class);
    const std::size_t count =
        std::bit_ceil(static_cast<std::size_t>(std::ceil(std::max(d.length, min_period) * per_meter_)));
    const double step = per_meter_ / static_cast<double>(count);  // from harmonic to harmonic [1/m]

    std::vector<std::complex<double>> table(count);  // c in the real parts, d in the imaginary ones
    for (auto k = static_cast<std::uint32_t>(std::ceil(lowest_frequency / step)); k * step <= highest_frequency; ++k) {
        const double n = k * step, relative = n / reference_frequency, gamma = coherence(n, d.track_width);
        const double amplitude = std::sqrt(2 * roughness / (relative * relative) * step);
        // The spline weights its coefficients 1/6, 4/6, 1/6 at a knot; the attenuation of each harmonic is compensated
        // here.
        const auto at_knot = sincos(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count));
        const double scale = amplitude * 3 / (2 + at_knot.cosine);
        const double common = scale * std::sqrt((1 + gamma) / 2), different = scale * std::sqrt((1 - gamma) / 2);
        const auto [phase, side] = draw(d, k);
        const auto [s, c] = sincos(phase);
        // Real c cos(2 pi n x + phase) and d = -side sin of the same, as half each of harmonics k and -k.
        const std::complex<double> of_c(0.5 * common * c, 0.5 * common * s);
        const std::complex<double> of_d(-0.5 * side * different * s, 0.5 * side * different * c);
        table[k] = {of_c.real() - of_d.imag(), of_c.imag() + of_d.real()};
        table[count - k] = {of_c.real() + of_d.imag(), of_d.real() - of_c.imag()};
    }
    fourier_transform(table);
    pieces_.reserve(count);
    const auto knot = [&](std::size_t k) { return DoublePair{table[k % count].real(), table[k % count].imag()}; };
    for (std::size_t k = 0; k < count; ++k) {
        // A B-spline is bounded by its coefficients, and s(y) by 1.5.
        max_height_ = std::max(max_height_, std::abs(table[k].real()) + 1.5 * std::abs(table[k].imag()));
        const DoublePair before = knot(k + count - 1), from = knot(k), to = knot(k + 1), behind = knot(k + 2);
        pieces_.push_back({(before + 4.0 * from + to) / 6.0, (to - before) / 2.0, (before + to) / 2.0 - from,
                           (behind - before) / 6.0 + (from - to) / 2.0});
    }
}

}  // namespace hamilcar
