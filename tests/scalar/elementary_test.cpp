// Arc tangent, sine, exponential and logarithm against the C library in higher precision, on doubles, floats and lanes, with
// derivatives against differences.
#include "hamilcar/scalar/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hamilcar/math/dual.hpp"
#include "hamilcar/program/executable.hpp"
#include "hamilcar/scalar/traced.hpp"

namespace hamilcar {
namespace {

struct Range {
    double least, most;
};

// Largest error over many arguments, in units of the last place of the result or of `floor`, whichever is larger.
template <class T, class Found, class Exact>
double worst_error(const Range& range, double floor, const Found& found, const Exact& exact) {
    using Longer = std::conditional_t<std::is_same_v<T, float>, double, long double>;
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> arguments(range.least, range.most);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const T x = static_cast<T>(arguments(random));
        const Longer right = exact(static_cast<Longer>(x));
        const T size = std::max(static_cast<T>(std::abs(right)), static_cast<T>(floor));
        const T unit = std::nextafter(size, std::numeric_limits<T>::max()) - size;
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<Longer>(found(x)) - right) / unit));
    }
    return worst;
}

const auto any_arctangent = [](auto x) { return arctangent(x); };
const auto any_sine = [](auto x) { return sine(x); };
const auto any_cosine = [](auto x) { return cosine(x); };
const auto any_exponential = [](auto x) { return exponential(x); };
const auto any_logarithm = [](auto x) { return logarithm(x); };

TEST(Elementary, AreAccurateToAFewUlpInDouble) {
    const auto atan_ = [](auto x) { return std::atan(x); };
    EXPECT_LT(worst_error<double>({-0.5, 0.5}, 0, any_arctangent, atan_), 4);
    EXPECT_LT(worst_error<double>({-5, 5}, 0, any_arctangent, atan_), 4);
    EXPECT_LT(worst_error<double>({-1e6, 1e6}, 0, any_arctangent, atan_), 4);
    // Near a zero of the function the unit shrinks with it, the reduction's error does not: measured against 1 there.
    const auto sin_ = [](auto x) { return std::sin(x); };
    const auto cos_ = [](auto x) { return std::cos(x); };
    EXPECT_LT(worst_error<double>({-1.6, 1.6}, 1e-2, any_sine, sin_), 4);
    EXPECT_LT(worst_error<double>({-50, 50}, 0.5, any_sine, sin_), 4);
    EXPECT_LT(worst_error<double>({-50, 50}, 0.5, any_cosine, cos_), 4);
    EXPECT_LT(worst_error<double>({-5, 5}, 0, any_exponential, [](auto x) { return std::exp(x); }), 60)
        << "three squarings double an error three times";
    EXPECT_LT(worst_error<double>({0.5, 2}, 1, any_logarithm, [](auto x) { return std::log(x); }), 60);
    EXPECT_LT(worst_error<double>({0.01, 100}, 1, any_logarithm, [](auto x) { return std::log(x); }), 60);
}

TEST(Elementary, AreAccurateToAFewUlpInFloat) {
    EXPECT_LT(worst_error<float>({-5, 5}, 0, any_arctangent, [](auto x) { return std::atan(x); }), 3);
    EXPECT_LT(worst_error<float>({-8, 8}, 0.5, any_sine, [](auto x) { return std::sin(x); }), 3);
    EXPECT_LT(worst_error<float>({-8, 8}, 0.5, any_cosine, [](auto x) { return std::cos(x); }), 3);
    EXPECT_LT(worst_error<float>({-3, 3}, 0, any_exponential, [](auto x) { return std::exp(x); }), 60);
    EXPECT_LT(worst_error<float>({0.1, 10}, 1, any_logarithm, [](auto x) { return std::log(x); }), 60);
}

TEST(Elementary, HaveTheRightLimits) {
    EXPECT_EQ(arctangent(0.0), 0);
    EXPECT_DOUBLE_EQ(arctangent(1e300), std::acos(0.0));
    EXPECT_DOUBLE_EQ(arctangent(-1e300), -std::acos(0.0));
    EXPECT_EQ(sine(0.0), 0);
    EXPECT_DOUBLE_EQ(cosine(0.0), 1);
    EXPECT_EQ(exponential(0.0), 1);
    EXPECT_EQ(logarithm(1.0), 0);
    EXPECT_DOUBLE_EQ(exponential(-1000.0), exponential(-40.0)) << "clamped, not zero and not infinite";
}

// Recorded, and run with a different argument in each lane.
TEST(Elementary, RecordedProgramsComputeTheBitsOfDoubles) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> arguments(-4, 4);
    const auto same = [&](const auto& f) {
        program::Graph graph;
        const Tracing tracing(graph);
        graph.output(1, 0, f(Traced<>::of(graph.input(0, 0))).id());
        const auto executable = program::backends().back().compile(graph, true);
        std::vector<double> x(static_cast<std::size_t>(executable->lanes())), y(x.size());
        program::Frame frame;
        frame.arrays[0] = x.data(), frame.arrays[1] = y.data();
        for (int i = 0; i < 3000; ++i) {
            for (double& one : x) one = (i % 2 == 0 ? 1 : 30) * arguments(random);
            executable->run(frame);
            for (std::size_t l = 0; l < x.size(); ++l) ASSERT_EQ(y[l], f(x[l])) << x[l];
        }
    };
    same(any_arctangent), same(any_sine), same(any_cosine), same(any_exponential);
    same([](auto x) { return sincos(x).sine; }), same([](auto x) { return sincos(x).cosine; });
}

TEST(Elementary, DerivativesAgreeWithDifferences) {
    using D = Dual<double, 1>;
    for (const double x : {-3.0, -1.1, -0.2, 0.3, 0.7, 1.9, 2.6}) {
        const auto expect = [x](const auto& f, double at) {
            constexpr double h = 1e-5;
            const double difference = (f(at + h) - f(at - h)) / (2 * h);
            EXPECT_NEAR(f(D::variable(at, 0)).partial(0), difference, 1e-8 * (1 + std::abs(difference))) << x;
        };
        expect(any_arctangent, x), expect(any_sine, x), expect(any_cosine, x), expect(any_exponential, x);
        expect(any_logarithm, std::abs(x));
    }
}

}  // namespace
}  // namespace hamilcar
