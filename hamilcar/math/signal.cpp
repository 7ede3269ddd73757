#include "hamilcar/math/signal.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hamilcar {

namespace {

using Piece = SignalPiece<double>;

// Fritsch-Butland slopes: zero at local extrema, otherwise the weighted harmonic mean of the neighboring secants; at most so many
// times the flatter of the two.
std::vector<double> monotone_slopes(const std::vector<double>& t, const std::vector<double>& y, double steepest) {
    const std::size_t n = t.size();
    std::vector<double> slope(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
        const double d0 = (y[i] - y[i - 1]) / h0, d1 = (y[i + 1] - y[i]) / h1;
        if (d0 * d1 > 0) {
            const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
            const double flatter = std::min(std::abs(d0), std::abs(d1));
            slope[i] = std::copysign(std::min((w0 + w1) / std::abs(w0 / d0 + w1 / d1), steepest * flatter), d0);
        }
    }
    return slope;  // zero at both ends: the input is constant outside the table
}

// From y0 by `rise` within one unit of s, slopes given: Hermite's cubic.
Piece hermite(double y0, double rise, double begin, double end) {
    return {.y0 = y0, .a = begin, .b = 3 * rise - 2 * begin - end, .c = begin + end - 2 * rise};
}

// The same in three pieces, each over a unit of its own. The second derivative goes in straight lines from zero over m1 at one third
// and m2 at two thirds back to zero; its integrals are the change of slope, (m1 + m2) / 3, and what the rise has beyond the first
// slope, (2 m1 + m2) / 9.
std::array<Piece, 3> thirds(double y0, double rise, double begin, double end) {
    constexpr double h = 1.0 / 3;
    const std::array<double, 4> m{0, 9 * rise - 6 * begin - 3 * end, 6 * end + 3 * begin - 9 * rise, 0};
    std::array<Piece, 3> out;
    double y = y0, slope = begin;
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = {.y0 = y, .a = slope * h, .b = m[i] / 2 * (h * h), .c = (m[i + 1] - m[i]) / 6 * (h * h)};
        y += out[i].a + out[i].b + out[i].c;
        slope += (m[i] + m[i + 1]) / 2 * h;
    }
    return out;
}

}  // namespace

Signal::Signal(const SignalDescription& d, double scale) {
    if (d.time.empty()) return;
    std::vector<double> value = d.value;
    for (double& number : value) number *= scale;
    if (d.interpolation == Interpolation::steps) {
        spans_.clear();
        for (std::size_t i = 0; i < value.size(); ++i) {
            const double end = i + 1 < value.size() ? d.time[i + 1] : forever;
            spans_.push_back({{.y0 = value[i]}, i == 0 ? -forever : d.time[i], end});
        }
        return;
    }
    // Hermite's cubic is monotone up to three times the rise, which these slopes keep; the thirds are up to 1.8 times at both ends.
    const bool is_smoother = d.interpolation == Interpolation::smoother;
    const std::vector<double> slope = monotone_slopes(d.time, value, is_smoother ? 1.8 : 3);
    spans_ = {Span{{.y0 = value.front()}, -forever, d.time.front()}};
    for (std::size_t i = 0; i + 1 < d.time.size(); ++i) {
        const double from = d.time[i], h = d.time[i + 1] - from, rise = value[i + 1] - value[i];
        const auto add = [&](Piece piece, double begin, double end) {
            piece.inverse_duration = 1 / (end - begin);
            spans_.push_back({piece, begin, end});
        };
        if (is_smoother) {
            const double first = from + h / 3, second = from + 2 * h / 3;
            const std::array<Piece, 3> three = thirds(value[i], rise, slope[i] * h, slope[i + 1] * h);
            add(three[0], from, first), add(three[1], first, second), add(three[2], second, d.time[i + 1]);
        } else if (d.interpolation == Interpolation::smooth) {
            add(hermite(value[i], rise, slope[i] * h, slope[i + 1] * h), from, d.time[i + 1]);
        } else {
            add({.y0 = value[i], .a = rise}, from, d.time[i + 1]);
        }
    }
    spans_.push_back({{.y0 = value.back()}, d.time.back(), forever});
}

void Signal::follow(double time, const SignalValue<double>& now, double scale) {
    follow(Span{{.inverse_duration = 1 / scale,
                 .y0 = now.value,
                 .a = now.rate * scale,
                 .b = 0.5 * now.acceleration * (scale * scale)},
                time,
                forever});
}

}  // namespace hamilcar
