#include "hamilcar/analysis/spectrum.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "hamilcar/math/fourier.hpp"
#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

namespace {

using Complex = std::complex<double>;

}  // namespace

Spectrum power_spectrum(const std::vector<double>& series, double rate, std::size_t segment) {
    return spectrum(series, 1 / rate, segment);
}

FrequencyResponse frequency_response(const std::vector<double>& input, const std::vector<double>& output, double rate,
                                     std::size_t segment) {
    if (input.size() != output.size()) throw std::length_error("input and output have as many samples");
    if (!std::has_single_bit(segment) || segment < 4 || segment > input.size())
        throw std::length_error("a segment is a power of two of samples, from 4 to as many as the series has");
    const std::size_t lines = segment / 2 + 1;
    std::vector<double> power_in(lines), power_out(lines);
    std::vector<Complex> cross(lines);
    const std::vector<double> window = hann_window(segment);
    for (std::size_t from = 0; from + segment <= input.size(); from += segment / 4) {
        const std::vector<Complex> x = transformed(std::span(input).subspan(from, segment), window),
                                   y = transformed(std::span(output).subspan(from, segment), window);
        for (std::size_t k = 0; k < lines; ++k) {
            power_in[k] += std::norm(x[k]), power_out[k] += std::norm(y[k]);
            cross[k] += x[k] * std::conj(y[k]);  // conjugate of the usual, as the transform turns the other way
        }
    }
    FrequencyResponse out{rate / static_cast<double>(segment), std::vector<Complex>(lines), std::vector<double>(lines)};
    for (std::size_t k = 0; k < lines; ++k) {
        if (power_in[k] > 0) out.response[k] = cross[k] / power_in[k];
        if (power_in[k] > 0 && power_out[k] > 0) out.coherence[k] = std::norm(cross[k]) / (power_in[k] * power_out[k]);
    }
    return out;
}

FittedSine fitted_sine(std::span<const double> series, double rate, double frequency) {
    if (!(frequency > 0 && frequency < rate / 2))
        throw std::invalid_argument("a sine's frequency lies between zero and half the sampling rate");
    const double per_period = rate / frequency, rounding = 1e-9;  // of a length that is meant to be whole periods
    const double periods = std::floor(static_cast<double>(series.size()) / per_period + rounding);
    const auto used = std::min(series.size(), static_cast<std::size_t>(std::lround(periods * per_period)));
    if (used < 3) throw std::length_error("a sine is fitted over at least one whole period and three samples");
    const auto basis = [&](std::size_t i) {
        const auto [s, c] = sincos(2 * std::numbers::pi * (static_cast<double>(i) / per_period));
        return Eigen::Vector3d(c, -s, 1);
    };
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = series.size() - used; i < series.size(); ++i) {
        const Eigen::Vector3d b = basis(i);
        normal += b * b.transpose();
        right += b * series[i];
    }
    const Eigen::Vector3d fit = normal.ldlt().solve(right);
    double squares = 0;
    for (std::size_t i = series.size() - used; i < series.size(); ++i) {
        const double left = series[i] - basis(i).dot(fit);
        squares += left * left;
    }
    return {{fit[0], fit[1]}, fit[2], std::sqrt(squares / static_cast<double>(used))};
}

std::complex<double> response_at(std::span<const double> input, std::span<const double> output, double rate,
                                 double frequency) {
    if (input.size() != output.size()) throw std::length_error("input and output have as many samples");
    return fitted_sine(output, rate, frequency).amplitude / fitted_sine(input, rate, frequency).amplitude;
}

}  // namespace hamilcar
