// Lines between samples are met exactly, parabolas at their crests; the rest against closed forms.
#include "hamilcar/analysis/series_tools.hpp"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(SeriesTools, InterpolatesAlongLines) {
    const std::vector<double> values{1, 3, -1};
    const Series series{values, 10, 2};
    EXPECT_NEAR(interpolated(series, 2.0), 1, 1e-14);
    EXPECT_NEAR(interpolated(series, 2.05), 2, 1e-14);
    EXPECT_NEAR(interpolated(series, 2.125), 2, 1e-12);
    EXPECT_EQ(interpolated(series, 1.0), 1);
    EXPECT_EQ(interpolated(series, 9.0), -1);
    EXPECT_THROW(interpolated({{}, 10}, 0), std::length_error);
}

TEST(SeriesTools, FindsWhereALevelIsReached) {
    const std::vector<double> values{0, 2, 0, -2, 0, 2};
    const Series series{values, 1, 100};
    EXPECT_NEAR(first_crossing(series, 0.5, Crossing::rising).value(), 100.25, 1e-12);
    EXPECT_NEAR(first_crossing(series, 0.5, Crossing::falling).value(), 101.75, 1e-12);
    EXPECT_NEAR(first_crossing(series, 0.5, Crossing::either, 101).value(), 101.75, 1e-12);
    EXPECT_NEAR(first_crossing(series, 0.5, Crossing::rising, 100.3).value(), 104.25, 1e-12) << "passed already";
    EXPECT_NEAR(first_crossing(series, 0, Crossing::rising).value(), 104, 1e-12) << "the start comes from nowhere";
    EXPECT_NEAR(first_crossing(series, 2, Crossing::rising).value(), 101, 1e-12) << "touched";
    EXPECT_FALSE(first_crossing(series, 2.1, Crossing::either));
    EXPECT_FALSE(first_crossing({{}, 1}, 0, Crossing::either));
}

// A parabola between samples is met exactly.
TEST(SeriesTools, FindsCrestsBetweenSamples) {
    const auto hill = sampled(50, 10, [](double t) { return 4 - 3 * (t - 2.237) * (t - 2.237); });
    const auto found = peak({hill, 10, 1}, Extreme::highest);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->time, 3.237, 1e-12);
    EXPECT_NEAR(found->value, 4, 1e-12);
}

TEST(SeriesTools, FindsThePeakThatIsAskedFor) {
    const double rate = 200;
    const auto swing = sampled(4000, rate, [](double t) { return std::exp(-0.1 * t) * std::sin(t); });
    const double crest = std::atan(10.0);  // tan t = 1 / 0.1
    const auto value = [&](int half_turns) {
        return std::exp(-0.1 * (crest + half_turns * pi)) * std::sin(crest) * (half_turns % 2 == 0 ? 1 : -1);
    };
    const Series series{swing, rate};
    const auto expect = [&](const std::optional<Peak>& found, int half_turns) {
        ASSERT_TRUE(found);
        // The parabola misses a cubic by at most f''' h^3 / (9 sqrt(3)), f''' being 0.17 at the first crest.
        EXPECT_NEAR(found->time, crest + half_turns * pi, 2e-6);
        EXPECT_NEAR(found->value, value(half_turns), 1.4e-9);
    };
    expect(peak(series, Extreme::highest), 0);
    expect(peak(series, Extreme::lowest), 1);
    expect(peak(series, Extreme::largest, 3), 1);
    expect(peak(series, Extreme::highest, 3), 2);
    expect(peak(series, Extreme::largest, 6, 9), 2);
    const auto edge = peak(series, Extreme::highest, 2, 3);
    ASSERT_TRUE(edge);
    EXPECT_DOUBLE_EQ(edge->time, 2) << "still falling: no crest, the sample itself";
    EXPECT_FALSE(peak(series, Extreme::highest, 30));
    const std::vector<double> flat{1, 1, 1};
    EXPECT_EQ(peak({flat, 1}, Extreme::largest)->time, 0);
}

// By hand: means 2.5 and 5, sums of products 5, 11 and 26.
TEST(SeriesTools, FitsTheLineOfLeastSquares) {
    const std::vector<double> x{1, 2, 3, 4}, y{2, 3, 7, 8};
    const FittedLine line = fitted_line(x, y);
    EXPECT_NEAR(line.slope, 11.0 / 5, 1e-14);
    EXPECT_NEAR(line.intercept, 5 - 2.5 * 11 / 5, 1e-14);
    EXPECT_NEAR(line.r_squared, 121.0 / (5 * 26), 1e-14);
    EXPECT_EQ(fitted_line(x, std::vector<double>(4, 0.1)).r_squared, 1);
    EXPECT_THROW(fitted_line(x, std::vector<double>(3)), std::invalid_argument);
    EXPECT_THROW(fitted_line(std::vector<double>(4, 0.1), y), std::invalid_argument);
    EXPECT_THROW(fitted_line({}, {}), std::invalid_argument);
}

TEST(SeriesTools, IntegratesLinesExactlyAndCurvesToSecondOrder) {
    const auto line = sampled(11, 10, [](double t) { return 2 * t + 1; });
    const auto out = running_integral({line, 10}, 5);
    for (std::size_t i = 0; i < line.size(); ++i) {
        const double t = static_cast<double>(i) / 10;
        EXPECT_NEAR(out[i], 5 + t * t + t, 1e-14);
    }
    const auto error = [](double rate) {
        const auto size = static_cast<std::size_t>(rate) + 1;
        return running_integral({sampled(size, rate, [](double t) { return std::exp(t); }), rate}).back() -
               (std::exp(1.0) - 1);
    };
    EXPECT_NEAR(error(200) / error(100), 0.25, 1e-4);
    EXPECT_TRUE(running_integral({{}, 10}).empty());
}

TEST(SeriesTools, ResamplesAlongLines) {
    const auto line = sampled(101, 1000, [](double t) { return 7 * t - 1; });  // 0 to 0.1 s
    const auto fewer = resampled({line, 1000, 50}, 200), more = resampled({line, 1000}, 3000);
    ASSERT_EQ(fewer.size(), 21U);
    ASSERT_EQ(more.size(), 301U);
    for (std::size_t i = 0; i < fewer.size(); ++i) EXPECT_NEAR(fewer[i], 7 * static_cast<double>(i) / 200 - 1, 1e-12);
    for (std::size_t i = 0; i < more.size(); ++i) EXPECT_NEAR(more[i], 7 * static_cast<double>(i) / 3000 - 1, 1e-12);
    EXPECT_THROW(resampled({line, 1000}, 0), std::invalid_argument);
    EXPECT_THROW(resampled({{}, 1000}, 100), std::length_error);
}

// Steps of any length, a jump at one instant.
TEST(SeriesTools, MakesInstantsUniform) {
    const std::vector<double> times{3, 3.5, 4.5, 4.5, 5}, values{0, 1, 3, 10, 12};
    const auto out = resampled(times, values, 4);
    const std::vector<double> expected{0, 0.5, 1, 1.5, 2, 2.5, 10, 11, 12};
    ASSERT_EQ(out.size(), expected.size());
    for (std::size_t i = 0; i < out.size(); ++i) EXPECT_NEAR(out[i], expected[i], 1e-14) << i;
    EXPECT_THROW(resampled(std::vector<double>{1, 0}, std::vector<double>{1, 2}, 4), std::invalid_argument);
    EXPECT_THROW(resampled(times, std::vector<double>(4), 4), std::invalid_argument);
}

}  // namespace
}  // namespace hamilcar
