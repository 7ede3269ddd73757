// One quantity over another: beginnings, slopes, levels and loops of curves that are known.
#include "hamilcar/analysis/curves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hamilcar {
namespace {

std::vector<double> table(int count, const auto& f) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(f(0.1 * i));
    return out;
}
const std::vector<double> x = table(30, [](double at) { return at; });

TEST(Curves, BeginWithTheirSlopeWhateverTheyDoFartherOut) {
    const auto base = table(30, [](double at) { return std::cos(at); });
    const auto y = table(30, [](double at) { return at > 2 ? 1e3 : 2 * std::cos(at) + 3 * at - at * at; });
    const auto [f, s] = fit_from_zero(base, x, y, 2);
    EXPECT_NEAR(f, 2, 1e-9);
    EXPECT_NEAR(s, 3, 1e-9);
    EXPECT_TRUE(std::isnan(fit_from_zero(base, x, y, 0.3)[1])) << "four points are too few";
}

TEST(Curves, HaveTheSlopeOfTheirNeighborhood) {
    const auto slopes = local_slopes(x, table(30, [](double at) { return at * at; }), 0.25);
    EXPECT_NEAR(slopes.at(10), 2, 1e-9);
    EXPECT_NEAR(slopes.at(20), 4, 1e-9);
    EXPECT_TRUE(std::isnan(local_slopes(x, x, 0.05).at(10))) << "a point alone has no slope";
}

TEST(Curves, HaveTheSlopeOfAParabolaAtAPlace) {
    const auto y = table(30, [](double at) { return 3 + 2 * at - 0.5 * at * at; });
    EXPECT_NEAR(slope_at(x, y, 1, 0.5), 1, 1e-9);
    EXPECT_NEAR(slope_at(x, y, 2.03, 0.5), -0.03, 1e-9) << "between points, and with more of them on one side";
    EXPECT_NEAR(slope_at(x, y, 2.75, 0.5), -0.75, 1e-9) << "near the end";
    EXPECT_TRUE(std::isnan(slope_at(x, y, 2.9, 0.5)) && std::isnan(slope_at(x, y, 0, 0.5))) << "at an end";
    EXPECT_TRUE(std::isnan(slope_at(x, y, 3.5, 0.5)) && std::isnan(slope_at({}, {}, 1, 1))) << "beyond";
    EXPECT_TRUE(std::isnan(slope_at(x, y, 1, 0.14))) << "three points are too few";
}

TEST(Curves, AreReadOffWithinTheirEndsOnly) {
    const std::vector<double> y{4, 2, 3, 0}, at{0, 1, 2, 3};
    EXPECT_DOUBLE_EQ(value_at(at, y, 0.5), 3);
    EXPECT_TRUE(std::isnan(value_at(at, y, 3.5)) && std::isnan(value_at({}, {}, 0)));
    EXPECT_DOUBLE_EQ(falls_through(at, y, 2.5), 0.75) << "the first time";
    EXPECT_DOUBLE_EQ(falls_through(at, y, 1), 2 + 2.0 / 3);
    EXPECT_TRUE(std::isnan(falls_through(at, y, -1)));
}

TEST(Curves, OfPhasesGoOnBeyondHalfATurn) {
    std::vector<std::complex<double>> response;
    for (const double turn : {-0.1, -0.4, -0.6, -0.9, -1.2}) {
        response.push_back(std::polar(2.0, 2 * std::numbers::pi * turn));
    }
    const std::vector<double> found = phases(response);
    for (const auto& [i, expected] : std::vector<std::pair<std::size_t, double>>{{0, -36}, {2, -216}, {4, -432}}) {
        EXPECT_NEAR(found.at(i), expected, 1e-9);
    }
}

// y lags behind x by a tenth of a turn.
TEST(Curves, ThatAreLoopsHaveTwoBranches) {
    constexpr int rows = 2000;
    std::vector<double> in, out;
    for (int i = 0; i < rows; ++i) {
        const double turns = 4.0 * i / rows;
        in.push_back(std::sin(2 * std::numbers::pi * turns));
        out.push_back(3 * std::sin(2 * std::numbers::pi * (turns - 0.1)));
    }
    const Loop loop(in, out);
    const double lag = 0.2 * std::numbers::pi;
    EXPECT_NEAR(loop.at(0, true), -3 * std::sin(lag), 1e-3);
    EXPECT_NEAR(loop.at(0, false), 3 * std::sin(lag), 1e-3);
    EXPECT_NEAR(loop.width(0), 6 * std::sin(lag), 1e-3);
    EXPECT_NEAR(loop.slope(0, 0.1), 3 * std::cos(lag), 0.01);
    EXPECT_NEAR(loop.slope_aside(0.5, 0.05), 3 * std::cos(lag), 0.01) << "what the branches have apart cancels out";
    EXPECT_TRUE(std::isnan(loop.at(2, true)) && std::isnan(loop.slope(5, 0.1))) << "never there";
}

}  // namespace
}  // namespace hamilcar
