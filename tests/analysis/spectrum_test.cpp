// Spectra and responses of series whose spectra and responses are known beforehand.
#include "hamilcar/analysis/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace hamilcar {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> noise(std::size_t size, unsigned seed) {
    std::mt19937 source(seed);
    std::vector<double> out(size);  // uniform within +-sqrt(3): variance 1
    for (double& value : out) value = std::sqrt(3.0) * (2 * (static_cast<double>(source()) + 0.5) / 4294967296.0 - 1);
    return out;
}

std::vector<double> sampled(std::size_t size, double rate, auto&& f) {
    std::vector<double> out(size);
    for (std::size_t i = 0; i < size; ++i) out[i] = f(static_cast<double>(i) / rate);
    return out;
}

// White noise of variance v has v over half the rate everywhere; what lies under the spectrum is the variance.
TEST(PowerSpectrum, OfWhiteNoiseIsFlat) {
    const double rate = 400;
    const Spectrum found = power_spectrum(noise(1 << 18, 3), rate, 256);
    EXPECT_DOUBLE_EQ(found.resolution, 400.0 / 256);
    ASSERT_EQ(found.density.size(), 129U);
    double variance = 0;
    for (const double density : found.density) variance += density * found.resolution;
    EXPECT_NEAR(variance, 1, 0.02);
    for (std::size_t k = 2; k < 128; ++k) EXPECT_NEAR(found.density[k], 1 / (rate / 2), 0.15 / (rate / 2)) << k;
}

TEST(PowerSpectrum, OfASineHoldsHalfItsSquare) {
    const Spectrum found =
        power_spectrum(sampled(8192, 1000, [](double t) { return 4 + 3 * std::sin(2 * pi * 31.7 * t); }), 1000, 1024);
    double power = 0;
    for (std::size_t k = 2; k < found.density.size(); ++k) {  // below, lines were taken out of pieces of the sine
        const double f = static_cast<double>(k) * found.resolution;
        const bool near = std::abs(f - 31.7) < 8;
        if (near) power += found.density[k] * found.resolution;
        EXPECT_TRUE(near || found.density[k] < 1e-4) << f;
    }
    EXPECT_NEAR(power, 4.5, 0.005);
}

// The mean of two neighbors has the response exp(-i w/2) cos(w/2), w = 2 pi f/rate; a window is a few lines wide.
TEST(FrequencyResponse, OfAMovingMean) {
    const auto x = noise(1 << 17, 5);
    std::vector<double> y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = 40 + 2.5 * (x[i] + (i > 0 ? x[i - 1] : 0));
    const FrequencyResponse found = frequency_response(x, y, 200, 512);
    ASSERT_EQ(found.response.size(), 257U);
    for (std::size_t k = 2; k < 250; ++k) {
        const double w = pi * static_cast<double>(k) / 256;
        EXPECT_LT(std::abs(found.response[k] - std::polar(5 * std::cos(w / 2), -w / 2)), 0.03) << k;
        if (k < 200) {
            EXPECT_GT(found.coherence[k], 0.999) << k;
        }
    }
}

// Noise of the same power in the output: half the power is coherent, and the response stays what it is.
TEST(FrequencyResponse, KnowsHowMuchIsNoise) {
    const auto x = noise(1 << 19, 7), other = noise(1 << 19, 8);
    std::vector<double> y(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = -2 * x[i] + 2 * other[i];
    const FrequencyResponse found = frequency_response(x, y, 100, 128);
    double mean = 0;
    for (std::size_t k = 2; k < 63; ++k) {
        EXPECT_LT(std::abs(found.response[k] + 2.0), 0.12) << k;
        EXPECT_NEAR(found.coherence[k], 0.5, 0.06) << k;
        mean += found.coherence[k] / 61;
    }
    EXPECT_NEAR(mean, 0.5, 0.01);
}

TEST(FrequencyResponse, OfNoInputIsNone) {
    const FrequencyResponse found = frequency_response(std::vector<double>(256), noise(256, 1), 100, 64);
    for (std::size_t k = 0; k < found.response.size(); ++k) {
        EXPECT_EQ(found.response[k], 0.0);
        EXPECT_EQ(found.coherence[k], 0);
    }
    EXPECT_THROW(frequency_response(noise(256, 1), noise(255, 1), 100, 64), std::length_error);
    EXPECT_THROW(frequency_response(noise(256, 1), noise(256, 1), 100, 60), std::length_error);
    EXPECT_THROW(frequency_response(noise(256, 1), noise(256, 1), 100, 512), std::length_error);
}

// No whole number of samples a period, an offset, a transient before the last periods.
TEST(FittedSine, FindsAmplitudePhaseAndOffset) {
    const double rate = 1000, f = 0.7;
    const auto series =
        sampled(7000, rate, [&](double t) { return -3 + 2.5 * std::cos(2 * pi * f * t + 0.4) + (t < 1 ? 100 : 0); });
    const FittedSine found = fitted_sine(series, rate, f);
    EXPECT_NEAR(std::abs(found.amplitude), 2.5, 1e-11) << "four periods from 1.286 s on";
    EXPECT_NEAR(std::arg(found.amplitude), 0.4, 1e-11);
    EXPECT_NEAR(found.offset, -3, 1e-11);
    EXPECT_NEAR(found.residual, 0, 1e-11);
}

// A third harmonic is orthogonal over whole periods: it stays in the residual.
TEST(FittedSine, LeavesHarmonicsOut) {
    const auto series = sampled(1000, 500, [](double t) { return std::sin(2 * pi * t) + 0.2 * std::sin(6 * pi * t); });
    const FittedSine found = fitted_sine(series, 500, 1);
    EXPECT_NEAR(std::abs(found.amplitude - std::complex<double>(0, -1)), 0, 1e-12);
    EXPECT_NEAR(found.residual, 0.2 / std::sqrt(2.0), 1e-12);
    EXPECT_THROW(fitted_sine(series, 500, 0.4), std::length_error);
    EXPECT_THROW(fitted_sine(series, 500, 250), std::invalid_argument);
    EXPECT_THROW(fitted_sine(series, 500, 0), std::invalid_argument);
}

// A lag of first order, 1 / (1 + i w T), under a sine that has settled.
TEST(ResponseAt, OfALag) {
    const double rate = 250, T = 0.12;
    for (const double f : {0.3, 1.1, 3.7}) {
        const double w = 2 * pi * f;
        const auto input = sampled(5000, rate, [&](double t) { return 0.05 * std::sin(w * t); });
        const auto output = sampled(5000, rate, [&](double t) {
            return 0.05 * (std::sin(w * t) - w * T * std::cos(w * t) + w * T * std::exp(-t / T)) / (1 + w * w * T * T);
        });
        const auto found = response_at(std::span(input).subspan(1000), std::span(output).subspan(1000), rate, f);
        EXPECT_NEAR(std::abs(found), 1 / std::sqrt(1 + w * w * T * T), 1e-12) << f;
        EXPECT_NEAR(std::arg(found), -std::atan(w * T), 1e-12) << f;
    }
    EXPECT_THROW(response_at(noise(100, 1), noise(99, 1), 100, 5), std::length_error);
}

}  // namespace
}  // namespace hamilcar
