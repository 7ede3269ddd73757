#include "hamilcar/math/signal.hpp"

namespace hamilcar {

namespace {

// Fritsch-Butland slopes: zero at local extrema, otherwise the weighted harmonic mean of the neighboring secants.
std::vector<double> monotone_slopes(const std::vector<double>& t, const std::vector<double>& y) {
    const std::size_t n = t.size();
    std::vector<double> slope(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
        const double d0 = (y[i] - y[i - 1]) / h0, d1 = (y[i + 1] - y[i]) / h1;
        if (d0 * d1 > 0) {
            const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
            slope[i] = (w0 + w1) / (w0 / d0 + w1 / d1);
        }
    }
    return slope;  // zero at both ends: the input is constant outside the table
}

}  // namespace

Signal::Signal(const SignalDescription& d, double scale) {
    if (d.time.empty()) return;
    std::vector<double> value = d.value;
    for (double& number : value) number *= scale;
    const bool smooth = d.interpolation == Interpolation::smooth;
    if (d.interpolation == Interpolation::steps) {
        spans_.clear();
        for (std::size_t i = 0; i < value.size(); ++i) {
            const double end = i + 1 < value.size() ? d.time[i + 1] : forever;
            spans_.push_back({{.y0 = value[i]}, i == 0 ? -forever : d.time[i], end});
        }
        return;
    }
    const std::vector<double> slope = smooth ? monotone_slopes(d.time, value) : std::vector<double>();
    spans_ = {Span{{.y0 = value.front()}, -forever, d.time.front()}};
    for (std::size_t i = 0; i + 1 < d.time.size(); ++i) {
        const double h = d.time[i + 1] - d.time[i], rise = value[i + 1] - value[i];
        SignalPiece<double> piece{.inverse_duration = 1 / h, .y0 = value[i], .a = rise};
        if (smooth) {  // Hermite
            const double begin = slope[i] * h, end = slope[i + 1] * h;
            piece.a = begin, piece.b = 3 * rise - 2 * begin - end, piece.c = begin + end - 2 * rise;
        }
        spans_.push_back({piece, d.time[i], d.time[i + 1]});
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
