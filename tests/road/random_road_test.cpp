// Random roads: the class in every band and harmonic of both tracks, the coherence of an isotropic surface between
// them, a periodic table. Also the spectrum estimate, on synthetic profiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "hamilcar/math/fourier.hpp"
#include "hamilcar/road/random_road.hpp"
#include "hamilcar/road/road_spectrum.hpp"
#include "hamilcar/scalar/dual.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

constexpr double pi = std::numbers::pi;
const std::string classes = "ABCDEFGH";
// G_d(0.1 cycles/m) of ISO 8608's classes, geometric means [m^3].
constexpr std::array<double, 8> means{16e-6, 64e-6, 256e-6, 1024e-6, 4096e-6, 16384e-6, 65536e-6, 262144e-6};

const auto mean_of = [](char road_class) { return means[classes.find(road_class)]; };

// One period of a track from beyond the fade on, and then `more` samples of the next.
std::vector<double> track(const RandomRoad& road, double y, std::size_t samples, std::size_t more = 0) {
    std::vector<double> heights(samples + more);
    const double step = road.period() / static_cast<double>(samples);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = road.height(10.0 + step * static_cast<double>(i), y);
    return heights;
}

// Mean of f(x) exp(-2 pi i k x/period), as it is written down.
std::complex<double> harmonic(const std::vector<double>& period, int k) {
    const std::complex<double> turn = std::polar(1.0, -2 * pi * k / static_cast<double>(period.size()));
    std::complex<double> sum = 0, rotation = 1;
    for (const double height : period) sum += height * rotation, rotation *= turn;
    return sum / static_cast<double>(period.size());
}

// k^2 times the integral of cos(ky b) (k^2 + ky^2)^(-3/2) over ky from 0 on, with ky = k sinh t: the cross-spectrum
// of two lines on an isotropic surface over the spectrum of one.
double isotropic_coherence(double n, double b) {
    const double k = 2 * pi * n, step = 1e-4;
    double sum = 0.5;
    for (double t = step; t < 9; t += step) sum += std::cos(k * b * std::sinh(t)) / (std::cosh(t) * std::cosh(t));
    return sum * step;
}

TEST(RoadSpectrum, TransformAgreesWithTheDefinition) {
    std::mt19937 source(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<std::complex<double>> values(32);
    for (auto& value : values) value = {unit(source), unit(source)};
    auto transformed = values;
    fourier_transform(transformed);
    for (int k = 0; k < 32; ++k) {
        std::complex<double> sum = 0;
        for (int j = 0; j < 32; ++j) sum += values[static_cast<std::size_t>(j)] * std::polar(1.0, 2 * pi * j * k / 32);
        EXPECT_NEAR(std::abs(transformed[static_cast<std::size_t>(k)] - sum), 0, 1e-13);
    }
}

// On a grade, too: a sine has half its amplitude squared in the band around it and next to nothing elsewhere.
TEST(RoadSpectrum, FindsASineOnAGrade) {
    const double spacing = 0.1, amplitude = 0.02, n = 0.25;
    std::vector<double> profile(8192);
    for (std::size_t i = 0; i < profile.size(); ++i) {
        profile[i] = amplitude * std::sin(2 * pi * n * spacing * double(i) + 0.3) + 0.05 * spacing * double(i);
    }
    for (const Band& band : smoothed(spectrum(profile, spacing, 2048), 3, 0.05, 4)) {
        const double power = band.density * (band.high - band.low), whole = amplitude * amplitude / 2;
        EXPECT_NEAR(power, band.low < n && n < band.high ? whole : 0, 1e-4 * whole) << band.low;
    }
}

TEST(RoadSpectrum, HasTheBandsOfTheStandard) {
    const Spectrum flat{0.001, std::vector<double>(5000, 7.0)};
    const std::vector<Band> bands = smoothed(flat);
    EXPECT_EQ(bands.size(), 2U + 8U + 40U) << "octaves, thirds, twelfths";
    EXPECT_NEAR(bands.front().low, 0.01105, 1e-5);
    EXPECT_NEAR(bands[1].center(), 0.03125, 1e-12);
    EXPECT_NEAR(bands[9].center(), 0.25, 1e-12);
    EXPECT_NEAR(bands.back().high, 2.8284, 1e-4);
    for (const Band& band : bands) EXPECT_NEAR(band.density, 7, 1e-12);
    for (std::size_t i = 1; i < bands.size(); ++i) EXPECT_NEAR(bands[i].low, bands[i - 1].high, 1e-12);
}

TEST(RoadSpectrum, ClassLimitsAreHalfAndDouble) {
    for (const char road_class : classes) {
        EXPECT_DOUBLE_EQ(class_roughness(road_class), mean_of(road_class));
        for (const double factor : {0.501, 1.999}) EXPECT_EQ(class_of(factor * mean_of(road_class)), road_class);
    }
    EXPECT_EQ(class_of(1e-9), 'A');
    EXPECT_EQ(class_of(1e3), 'H');
    EXPECT_THROW(class_roughness('I'), std::invalid_argument);
}

// A synthetic profile of sines with random phases, rougher in long waves than any class: the fit recovers it.
TEST(RoadSpectrum, RecoversTheRoughnessOfASyntheticProfile) {
    const double roughness = 700e-6, waviness = 2.5, length = 1638.4, spacing = 0.1;
    std::mt19937 source(5);
    std::uniform_real_distribution<double> turn(0, 2 * pi);
    std::vector<std::complex<double>> lines(16384);
    for (std::size_t k = 10; k < 6000; ++k) {
        const double density = roughness * std::pow(double(k) / length / 0.1, -waviness);
        lines[k] = std::polar(std::sqrt(2 * density / length), turn(source));
    }
    fourier_transform(lines);
    std::vector<double> profile(lines.size());
    std::ranges::transform(lines, profile.begin(), [](const auto& value) { return value.real(); });
    const Roughness found = fitted(smoothed(spectrum(profile, spacing, 2048)));
    EXPECT_NEAR(found.waviness, waviness, 0.05);
    EXPECT_NEAR(found.at_reference, roughness, 0.1 * roughness) << "an open record: its ends have less weight";
    EXPECT_EQ(classify(profile, spacing), 'D');
}

// The squared windows add up to a constant over the period, so the estimate has no scatter: what remains is the width
// of the window. Few samples fall on knots.
TEST(RandomRoad, HasItsClassInEveryBandOfBothTracks) {
    const std::size_t samples = 15360, segment = 4096;
    double worst = 0;
    for (const char road_class : classes)
        for (const std::uint64_t seed : {1U, 2U, 3U})
            for (const double y : {0.75, -0.75}) {
                const RandomRoad road({.road_class = road_class, .seed = seed});
                const auto profile = track(road, y, samples, 3 * segment / 4);
                const double spacing = road.period() / samples;
                const std::vector<Band> bands = smoothed(spectrum(profile, spacing, segment), 3, 0.0175, 2.6);
                EXPECT_EQ(bands.size(), 21U);
                for (const Band& band : bands) {
                    const double expected = mean_of(road_class) * 0.01 / (band.low * band.high);  // mean of n^-2
                    worst = std::max(worst, std::abs(band.density / expected - 1));
                }
                EXPECT_EQ(classify(profile, spacing), road_class) << seed;
                EXPECT_EQ(classify({profile.begin(), profile.begin() + 5000}, spacing), road_class) << "550 m of it";
            }
    EXPECT_LT(worst, 0.03) << "1.6 percent in the lowest band";
}

TEST(RandomRoad, HasItsClassInEveryHarmonicAndNothingElse) {
    const RandomRoad road({.road_class = 'D', .seed = 7, .spacing = 0.1});
    ASSERT_DOUBLE_EQ(road.period(), 1638.4);
    for (const double y : {0.75, -0.75}) {
        const auto period = track(road, y, 16384);  // at knots: the spline meets the harmonics' sum there
        for (const int k : {19, 20, 50, 164, 1000, 4000, 4636}) {
            const double n = k / 1638.4, amplitude = std::sqrt(2 * 1024e-6 * std::pow(n / 0.1, -2) / 1638.4);
            EXPECT_NEAR(2 * std::abs(harmonic(period, k)), amplitude, 1e-9 * amplitude) << k;
        }
        for (const int k : {0, 1, 18, 4637, 5000, 8192}) EXPECT_LT(std::abs(harmonic(period, k)), 1e-12) << k;
    }
}

// The real part of the coherence is that of every single harmonic; the imaginary part is a mean of random signs and its
// standard deviation sqrt((1 - gamma^2)/count), of which four are allowed.
TEST(RandomRoad, TracksAreCoherentAsOnAnIsotropicSurface) {
    for (const double width : {1.2, 1.8})
        for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
            const RandomRoad road({.seed = seed, .track_width = width});
            const auto left = track(road, width / 2, 16384), right = track(road, -width / 2, 16384);
            for (const int first : {40, 100, 200, 400, 800, 1600}) {
                const int count = first / 4;
                std::complex<double> cross = 0;
                double auto_left = 0, auto_right = 0, expected = 0;
                for (int k = first; k < first + count; ++k) {
                    const auto a = harmonic(left, k) * double(k), b = harmonic(right, k) * double(k);
                    cross += a * std::conj(b), auto_left += std::norm(a), auto_right += std::norm(b);
                }
                for (const double part : {0.1, 0.5, 0.9})  // third order over the band
                    expected += isotropic_coherence((first + part * count) / road.period(), width) / 3;
                cross /= std::sqrt(auto_left * auto_right);
                EXPECT_NEAR(cross.real(), expected, 3e-3) << first / road.period();
                EXPECT_LT(std::abs(cross.imag()), 4 * std::sqrt((1 - expected * expected) / count)) << first;
            }
        }
}

TEST(RandomRoad, SlopesAreNormallyDistributed) {
    const RandomRoad road({.road_class = 'C'});
    const int count = 16384;
    for (const double y : {0.75, 0.0, -0.75}) {
        double second = 0, fourth = 0;
        for (int i = 0; i < count; ++i) {
            const double slope = road.height(Dual<double, 1>::variable(10 + 0.1 * i, 0), Dual<double, 1>(y)).partial(0);
            second += slope * slope / count, fourth += std::pow(slope, 4) / count;
        }
        EXPECT_NEAR(fourth / (second * second), 3, 5 * std::sqrt(24.0 / count)) << "some neighbors are alike";
    }
}

TEST(RandomRoad, IsSmoothAndPeriodic) {
    const RandomRoad road({.road_class = 'E', .start = 20, .length = 0, .fade = 4, .spacing = 0.1});
    EXPECT_EQ(road.height(20.0, 0.3), 0);
    EXPECT_EQ(road.height(-1e9, 0.3), 0);
    for (double x = 24; x < 40; x += 0.7) EXPECT_NEAR(road.height(x, 0.3), road.height(x + road.period(), 0.3), 1e-12);
    using Number = Dual<double, 2>;
    const auto slopes = [&](double x, double y) { return road.height(Number::variable(x, 0), Number::variable(y, 1)); };
    for (const double x : {20.0, 20.1, 22.03, 24.0, 24.1, 20 + road.period() - 0.1, 20 + road.period(), 5000.0})
        for (const double y : {-1.6, -1.5, -1.1, -0.75, -0.2, 0.0, 0.75, 1.3, 1.5, 9.0}) {
            const Number here = slopes(x, y), beside = slopes(x - 1e-9, y - 1e-9);
            EXPECT_NEAR(here.partial(0), test::derivative([&](double u) { return road.height(u, y); }, x, 1e-5), 1e-4);
            EXPECT_NEAR(here.partial(1), test::derivative([&](double v) { return road.height(x, v); }, y, 1e-5), 1e-6);
            EXPECT_NEAR(here.partial(0), beside.partial(0), 1e-7);
            EXPECT_NEAR(here.partial(1), beside.partial(1), 1e-8);
        }
    const RandomRoad part({.road_class = 'E', .start = 20, .length = 100, .fade = 4, .spacing = 0.1});
    EXPECT_EQ(part.height(70.0, 0.3), road.height(70.0, 0.3));
    EXPECT_EQ(part.height(120.0, 0.3), 0);
}

TEST(RandomRoad, IsLinearBetweenTheTracksAndLevelsOffOutside) {
    const RandomRoad road({.road_class = 'B', .track_width = 1.6});
    for (double x = 6; x < 30; x += 0.91) {
        const double middle = road.height(x, 0.0), rise = road.height(x, 0.8) - middle;
        for (const double y : {-0.8, -0.31, 0.5, 0.8}) EXPECT_NEAR(road.height(x, y), middle + rise * y / 0.8, 1e-15);
        for (const double y : {1.6, 1.7, 50.0}) EXPECT_NEAR(road.height(x, y), middle + 1.5 * rise, 1e-15);
        for (const double y : {-1.6, -50.0}) EXPECT_NEAR(road.height(x, y), middle - 1.5 * rise, 1e-15);
    }
}

// The same description the same bits; a change of seed (in either half), case or stream another road: the correlation
// of two that have nothing in common scatters about zero as that of as many numbers as there are waves of note.
TEST(RandomRoad, DependsOnSeedCaseAndStream) {
    const RandomRoadDescription d{.road_class = 'C', .seed = 11};
    std::array<RandomRoadDescription, 4> others{d, d, d, d};
    others[0].seed = 12, others[1].seed = 11 + (1ULL << 32), others[2].case_number = 1, others[3].stream = 1;
    const auto reference = track(RandomRoad(d), 0.75, 4096);
    EXPECT_EQ(track(RandomRoad(d), 0.75, 4096), reference);
    for (const auto& other : others) {
        const auto heights = track(RandomRoad(other), 0.75, 4096);
        double cross = 0, square = 0;
        for (std::size_t i = 0; i < heights.size(); ++i)
            cross += heights[i] * reference[i], square += reference[i] * reference[i];
        EXPECT_LT(std::abs(cross / square), 4 / std::sqrt(2 * 3 * 19.0)) << "n^-2 from harmonic 19 on: some 3 x 19";
    }
}

TEST(RandomRoad, RejectsInvalidDescriptions) {
    const std::vector<RandomRoadDescription> all{{.road_class = 'a'}, {.spacing = 0.2}, {.track_width = 0}};
    for (const auto& wrong : all) EXPECT_THROW(RandomRoad{wrong}, std::invalid_argument);
    EXPECT_EQ(RandomRoad().height(1.0, 0.0), 0);
}

}  // namespace
}  // namespace hamilcar
