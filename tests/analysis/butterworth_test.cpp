// Butterworth's gain in closed form, known coefficients, and what both ways must leave as it is.
#include "hamilcar/analysis/butterworth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace hamilcar {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> sampled(std::size_t size, double rate, auto&& f) {
    std::vector<double> out(size);
    for (std::size_t i = 0; i < size; ++i) out[i] = f(static_cast<double>(i) / rate);
    return out;
}

// The sum of a series times exp(-2 pi i f t), as it is written down.
std::complex<double> fourier_sum(const std::vector<double>& series, double rate, double f) {
    std::complex<double> sum = 0;
    for (std::size_t i = 0; i < series.size(); ++i)
        sum += series[i] * std::polar(1.0, -2 * pi * f * static_cast<double>(i) / rate);
    return sum;
}

// The power gain of one pass, 1 / (1 + (tan/tan)^2n).
double power_gain(const LowPass& filter, double rate, double f) {
    const double ratio = std::tan(pi * f / rate) / std::tan(pi * filter.cutoff / rate);
    return 1 / (1 + std::pow(ratio, 2 * filter.order));
}

// As Octave prints butter(2, 0.2), half the sampling rate being 1.
TEST(Butterworth, HasTheKnownCoefficients) {
    const auto sections = butterworth({2, 10}, 100);
    ASSERT_EQ(sections.size(), 1U);
    EXPECT_NEAR(sections[0].b0, 0.067455273889072, 1e-14);
    EXPECT_NEAR(sections[0].b1, 0.134910547778144, 1e-14);
    EXPECT_NEAR(sections[0].b2, 0.067455273889072, 1e-14);
    EXPECT_NEAR(sections[0].a1, -1.142980502539901, 1e-14);
    EXPECT_NEAR(sections[0].a2, 0.412801598096189, 1e-14);
}

// An impulse holds all frequencies.
TEST(Butterworth, HasItsGainAtEveryFrequency) {
    const double rate = 200;
    const std::size_t middle = 2000;
    for (const int order : {2, 4, 6, 12}) {
        const LowPass filter{order, 6};
        std::vector<double> impulse(4001, 0.0);
        impulse[middle] = 1;
        const auto once = low_passed(impulse, rate, filter), twice = low_passed_both_ways(impulse, rate, filter);
        for (const double f : {0.0, 0.5, 3.0, 5.0, 6.0, 7.0, 12.0, 30.0, 90.0}) {
            const double power = power_gain(filter, rate, f);
            EXPECT_NEAR(std::norm(fourier_sum(once, rate, f)), power, 1e-11) << order << " at " << f;
            const double delay = static_cast<double>(middle) / rate;
            EXPECT_NEAR(std::abs(fourier_sum(twice, rate, f) - power * std::polar(1.0, -2 * pi * f * delay)), 0, 1e-11)
                << "no phase; " << order << " at " << f;
        }
        EXPECT_NEAR(std::norm(fourier_sum(once, rate, filter.cutoff)), 0.5, 1e-11);
    }
}

// The slope of the phase at zero, from the poles: the sum of 2 sine / (2 pi cutoff) is 1 / (2 pi cutoff sin(pi/2n)).
TEST(Butterworth, IsLateByItsDelay) {
    const double rate = 1000;
    for (const int order : {2, 6}) {
        const LowPass filter{order, 6};
        const auto ramp = sampled(4000, rate, [](double t) { return 3 * t; });
        const double delay = 1 / (2 * pi * filter.cutoff * std::sin(pi / (2 * order)));
        EXPECT_NEAR(low_passed(ramp, rate, filter).back(), ramp.back() - 3 * delay, 3 * 2e-4 * delay)
            << "but for warping";
    }
}

TEST(Butterworth, LeavesConstantsAlone) {
    const std::vector<double> constant(50, -7.3);
    for (const double value : low_passed(constant, 100, {6, 6})) EXPECT_NEAR(value, -7.3, 1e-12);
    for (const double value : low_passed_both_ways(constant, 100, {6, 6})) EXPECT_NEAR(value, -7.3, 1e-12);
    EXPECT_TRUE(low_passed({}, 100, {6, 6}).empty());
    EXPECT_TRUE(low_passed_both_ways({}, 100, {6, 6}).empty());
    EXPECT_NEAR(low_passed_both_ways(std::vector{2.0}, 100, {6, 6}).at(0), 2, 1e-12);
}

// The ends of a maneuver must not ring, nor move.
TEST(Butterworth, KeepsLinesUpToTheirEnds) {
    const auto line = sampled(3000, 1000, [](double t) { return 5 - 4 * t; });
    const auto out = low_passed_both_ways(line, 1000, {6, 6});
    for (std::size_t i = 0; i < line.size(); ++i) ASSERT_NEAR(out[i], line[i], 2e-6) << i;
}

TEST(Butterworth, BothWaysHasNoDirection) {
    const auto there = sampled(900, 200, [](double t) { return std::sin(9 * t * t) + t; });
    std::vector<double> back(there.rbegin(), there.rend());
    const auto a = low_passed_both_ways(there, 200, {6, 6});
    auto b = low_passed_both_ways(back, 200, {6, 6});
    std::ranges::reverse(b);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 2e-6) << i;
}

// Twelve poles at 6 Hz, as FMVSS 126 has them: the yaw rate of 0.7 Hz stays, noise of 20 Hz goes. Both are zero at the
// ends, so the reflections go on as the sines do and the ends are no worse.
TEST(Butterworth, SeparatesYawFromNoise) {
    const double rate = 1000;
    const auto yaw = [](double t) { return 0.4 * std::sin(2 * pi * 0.7 * t); };
    const auto clean = sampled(5001, rate, yaw);
    const auto noisy = sampled(5001, rate, [&](double t) { return yaw(t) + 0.1 * std::sin(2 * pi * 20 * t); });
    const auto out = low_passed_both_ways(noisy, rate, {6, 6});
    for (std::size_t i = 0; i < clean.size(); ++i) ASSERT_NEAR(out[i], clean[i], 1e-6) << i;
}

// By symmetry: an end that is noisy stays so.
TEST(Butterworth, BothWaysKeepsTheEndsThemselves) {
    const auto noisy = sampled(3000, 1000, [](double t) { return std::cos(300 * t) + t * t; });
    const auto out = low_passed_both_ways(noisy, 1000, {6, 6});
    EXPECT_NEAR(out.front(), noisy.front(), 1e-5);
    EXPECT_NEAR(out.back(), noisy.back(), 1e-5);
}

TEST(Butterworth, RefusesWhatItIsNot) {
    EXPECT_THROW(butterworth({3, 6}, 100), std::invalid_argument);
    EXPECT_THROW(butterworth({0, 6}, 100), std::invalid_argument);
    EXPECT_THROW(butterworth({4, 50}, 100), std::invalid_argument);
    EXPECT_THROW(butterworth({4, 0}, 100), std::invalid_argument);
}

}  // namespace
}  // namespace hamilcar
