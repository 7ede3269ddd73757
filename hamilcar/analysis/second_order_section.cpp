#include "hamilcar/analysis/second_order_section.hpp"

#include <numbers>
#include <stdexcept>

#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

std::complex<double> AnalogSection::response(double frequency) const {
    const double w = frequency / corner;  // p = i w
    const auto at = [&](const std::array<double, 3>& c) { return std::complex<double>(c[0] - c[2] * w * w, c[1] * w); };
    return at(numerator) / at(denominator);
}

// p = k (1 - z^-1) / (1 + z^-1) with k = 1 / tan(pi corner / rate); both polynomials times (1 + z^-1)^2.
SecondOrderSection bilinear(const AnalogSection& analog, double rate) {
    if (!(analog.corner > 0 && analog.corner < rate / 2))
        throw std::invalid_argument("a filter's corner lies between zero and half the sampling rate");
    const auto [s, c] = sincos(std::numbers::pi * analog.corner / rate);
    const double k = c / s;
    const auto in_z = [&](const std::array<double, 3>& p) {
        const double p1 = p[1] * k, p2 = p[2] * k * k;
        return std::array{p[0] + p1 + p2, 2 * (p[0] - p2), p[0] - p1 + p2};
    };
    const auto [n0, n1, n2] = in_z(analog.numerator);
    const auto [d0, d1, d2] = in_z(analog.denominator);
    return {n0 / d0, n1 / d0, n2 / d0, d1 / d0, d2 / d0};
}

std::vector<double> filtered(std::span<const SecondOrderSection> sections, std::span<const double> series) {
    std::vector<double> out(series.begin(), series.end());
    if (out.empty()) return out;
    for (const SecondOrderSection& f : sections) {
        const double first = out.front(), settled = first * ((f.b0 + f.b1 + f.b2) / (1 + f.a1 + f.a2));
        // What earlier values leave for the output of this step and of the next.
        double next = f.b2 * first - f.a2 * settled;
        double now = f.b1 * first - f.a1 * settled + next;
        for (double& value : out) {
            const double x = value;
            value = f.b0 * x + now;
            now = f.b1 * x - f.a1 * value + next;
            next = f.b2 * x - f.a2 * value;
        }
    }
    return out;
}

}  // namespace hamilcar
