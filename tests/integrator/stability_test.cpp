// The growth of every method over the complex plane, by running the method itself on y' = lambda y, and against the limits that are
// printed in the literature.
#include "hamilcar/integrator/stability.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "hamilcar/integrator/integrator.hpp"

namespace hamilcar {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

struct Plane {
    std::array<double, 2> values{};  // real and imaginary part
};

double size_of(const Plane& y) {
    return std::hypot(y.values[0], y.values[1]);
}

// By which the method multiplies |y| in a step of one, on the average of many, once its start is forgotten. The past is shrunk
// with the present, so that numbers stay in their range.
double measured_growth(const Method& method, Complex z) {
    Integrator<Plane> integrator(method, 1, 2, 1e300);  // a tolerance that never divides a step
    Plane y{{1, 0.3}};
    const auto rate_of = [z](double, const Plane& at, Plane& rate) {
        const Complex there = z * Complex(at.values[0], at.values[1]);
        rate.values = {there.real(), there.imag()};
    };
    constexpr int settling = 10000, counted = 10000;
    double logarithm = 0;
    for (int i = 0; i < settling + counted; ++i) {
        const double before = size_of(y);
        integrator.advance(rate_of, i, y);
        if (i >= settling) logarithm += std::log(size_of(y) / before);
        const double scale = 1 / size_of(y);
        for (double& one : y.values) one *= scale;
        integrator.change_past([scale](Plane& rate) {
            for (double& one : rate.values) one *= scale;
        });
    }
    return std::exp(logarithm / counted);
}

TEST(Growth, IsWhatTheMethodDoes) {
    for (const Method& method : methods) {
        for (const double angle : {0.5 * pi, 0.6 * pi, 0.75 * pi, 0.9 * pi, pi}) {
            for (const double share : {0.3, 0.9, 1.3}) {
                const Complex z = std::polar(share * method.real_axis_limit, angle);
                const double expected = growth(method, z);
                EXPECT_NEAR(measured_growth(method, z) / expected, 1, 2e-3)
                    << method.name << ' ' << angle << ' ' << share;
            }
        }
    }
}

TEST(Growth, PassesOneAtTheStatedLimitOfEveryMethod) {
    for (const Method& method : methods) {
        const double limit = method.real_axis_limit;
        EXPECT_LT(growth(method, -limit * (1 - 1e-4)), 1) << method.name;
        EXPECT_GT(growth(method, -limit * (1 + 1e-4)), 1) << method.name;
    }
}

// Hairer, Wanner II, IV.2 and V.1; Butcher 2016: classical Runge-Kutta holds 2 sqrt(2) of an oscillation without damping, third-order
// Adams-Bashforth 0.7236, the first two orders none.
TEST(Growth, HasThePrintedLimitsOfOscillationsWithoutDamping) {
    const auto at = [](const char* name, double frequency) { return growth(*find_method(name), {0, frequency}); };
    EXPECT_LT(at("rk4", 2.828), 1);
    EXPECT_GT(at("rk4", 2.829), 1);
    EXPECT_LT(at("ab3", 0.723), 1);
    EXPECT_GT(at("ab3", 0.725), 1);
    EXPECT_GT(at("ab1", 0.1), 1);
    EXPECT_GT(at("ab2", 0.1), 1);
}

TEST(StableStep, IsTheLimitOverTheFastestDecay) {
    const std::array<Complex, 3> modes{Complex(-2000, 0), Complex(-3, 8), Complex(0, 0)};
    for (const Method& method : methods) {
        const double limit = method.real_axis_limit / 2000;
        EXPECT_TRUE(is_stable(method, 0.99 * limit, modes)) << method.name;
        EXPECT_FALSE(is_stable(method, 1.01 * limit, modes)) << method.name;
        EXPECT_NEAR(stable_step(method, 5 * limit, modes), limit, 1e-2 * limit) << method.name;
        EXPECT_EQ(stable_step(method, 0.5 * limit, modes), 0.5 * limit) << method.name;
    }
}

// What grows by itself, as a car that oversteers, is no fault of the step.
TEST(StableStep, DoesNotBlameTheStepForWhatGrowsByItself) {
    const std::array<Complex, 2> modes{Complex(4, 0), Complex(1, 6)};
    for (const Method& method : methods) EXPECT_TRUE(is_stable(method, 1e-3, modes)) << method.name;
}

}  // namespace
}  // namespace hamilcar
