// Sine and cosine against the C library in higher precision, over every quadrant, near its borders and for small angles.
#include "hamilcar/scalar/sincos.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hamilcar {
namespace {

// Largest error of both over many angles within `range`, in units of the last place of the result.
template <class T, class Longer>
double worst_error(Longer range) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<Longer> angles(-range, range);
    const auto error = [](T found, Longer exact) {
        const T rounded = static_cast<T>(exact);
        const Longer unit = std::nextafter(std::abs(rounded), T(2)) - std::abs(rounded);
        // Near a zero of the function the unit shrinks with it, the reduction's error does not: measured against 1 there.
        return static_cast<double>(std::abs(found - exact) /
                                   std::max(unit, static_cast<Longer>(std::numeric_limits<T>::epsilon()) / 64));
    };
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const T angle = static_cast<T>(angles(random));
        const auto [s, c] = sincos(angle);
        worst = std::max(
            {worst, error(s, std::sin(static_cast<Longer>(angle))), error(c, std::cos(static_cast<Longer>(angle)))});
    }
    return worst;
}

TEST(SineCosine, IsAccurateInDouble) {
    EXPECT_LT((worst_error<double, long double>(1.0L)), 1.5);
    EXPECT_LT((worst_error<double, long double>(100.0L)), 1.5);
    EXPECT_LT((worst_error<double, long double>(1e5L)), 2.5);
}
TEST(SineCosine, IsAccurateInFloat) {
    EXPECT_LT((worst_error<float, double>(1.0)), 1.5);
    EXPECT_LT((worst_error<float, double>(1e3)), 2.5);
}

TEST(SineCosine, KeepsSmallAnglesAndSymmetry) {
    for (const double angle : {0.0, 1e-300, 1e-20, 1e-8, 0.3, 0.8, 2.0, 3.0, 5.0, 40.0}) {
        const auto [s, c] = sincos(angle);
        const auto [s_minus, c_minus] = sincos(-angle);
        EXPECT_EQ(s_minus, -s);
        EXPECT_EQ(c_minus, c);
        EXPECT_NEAR(s * s + c * c, 1, 4e-16);
    }
    EXPECT_EQ(sincos(1e-20).sine, 1e-20);
    EXPECT_EQ(sincos(0.0).cosine, 1);
}

TEST(SineCosine, PropagatesNaNAndInfinity) {
    EXPECT_TRUE(std::isnan(sincos(std::nan("")).sine));
    EXPECT_TRUE(std::isnan(sincos(std::numeric_limits<double>::infinity()).cosine));
}

}  // namespace
}  // namespace hamilcar
