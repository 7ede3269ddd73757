// The integrator in use: every method's order measured on a smooth nonlinear equation, its stated limit on the real axis
// found by decay and growth, the adaptive method's tolerance met or its failure reported.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "hamilcar/integrator/integrator.hpp"

namespace hamilcar {
namespace {

template <std::size_t n>
struct Numbers {
    std::array<double, n> values{};
};

constexpr double any_error = 1e100;  // a tolerance that never divides a step: the adaptive method at a fixed one

// y' = y (1 - y) and z' = 2 t z^2 from y(0) = 1/10, z(0) = 1/10: a logistic curve and 1 / (10 - t^2).
const auto nonlinear = [](double t, const Numbers<2>& at, Numbers<2>& rate) {
    const auto [y, z] = at.values;
    rate.values = {y * (1 - y), 2 * t * z * z};
};
const Numbers<2> start{{0.1, 0.1}};
constexpr double duration = 2;

double error_at_end(const Numbers<2>& state) {
    return std::hypot(state.values[0] - 1 / (1 + 9 * std::exp(-duration)),
                      state.values[1] - 1 / (10 - duration * duration));
}

double error_with(const Method& method, int steps, bool restarting = false) {
    Integrator<Numbers<2>> integrator(method, duration / steps, 2, any_error);
    Numbers<2> state = start;
    for (int i = 0; i < steps; ++i) {
        if (restarting) integrator.restart();
        integrator.advance(nonlinear, i * duration / steps, state);
    }
    return error_at_end(state);
}

// Steps of the coarse run: enough for the leading term of the error to rule, few enough to stay off round-off.
int coarse_steps(const Method& method) {
    const bool adams = method.family <= MethodFamily::adams_bashforth_moulton;
    return !adams ? 40 : method.order < 6 ? 240 : 128;
}

class EveryMethod : public testing::TestWithParam<Method> {};

TEST_P(EveryMethod, HasItsOrderOnANonlinearEquation) {
    const Method& method = GetParam();
    const int steps = coarse_steps(method);
    const double coarse = error_with(method, steps), fine = error_with(method, 2 * steps);
    std::printf("%s: error %.2e, %.2e, order %.2f\n", method.name.data(), coarse, fine, std::log2(coarse / fine));
    EXPECT_GT(fine, 1e-14);
    EXPECT_NEAR(std::log2(coarse / fine), method.order, 0.25);
}

// |y| after many steps of y' = -s y at step one; stops when it has plainly grown.
double after_many_steps(const Method& method, double s) {
    Integrator<Numbers<1>> integrator(method, 1, 1, any_error);
    Numbers<1> state{{1}};
    const auto decay = [s](double, const Numbers<1>& at, Numbers<1>& rate) { rate.values[0] = -s * at.values[0]; };
    for (int i = 0; i < 40000 && std::abs(state.values[0]) < 1e6; ++i) integrator.advance(decay, i, state);
    return std::abs(state.values[0]);
}

TEST_P(EveryMethod, DecaysUpToItsRealAxisLimitAndGrowsBeyond) {
    const Method& method = GetParam();
    for (const double share : {0.2, 0.4, 0.6, 0.8, 0.99}) {
        EXPECT_LT(after_many_steps(method, share * method.real_axis_limit), 1e-6) << share;
    }
    EXPECT_GT(after_many_steps(method, 1.01 * method.real_axis_limit), 1e6);
}

// After a restart nothing of the past is left: the same bits as a new integrator, also after a jump of the state.
TEST_P(EveryMethod, ForgetsThePastOnRestart) {
    const double h = 0.05;
    Integrator<Numbers<2>> used(GetParam(), h, 2, any_error), fresh(GetParam(), h, 2, any_error);
    Numbers<2> state = start;
    for (int i = 0; i < 10; ++i) used.advance(nonlinear, i * h, state);
    state = {{0.7, 0.05}};
    Numbers<2> expected = state;
    used.restart();
    for (int i = 0; i < 10; ++i) {
        used.advance(nonlinear, i * h, state);
        fresh.advance(nonlinear, i * h, expected);
    }
    EXPECT_EQ(std::memcmp(&state, &expected, sizeof(state)), 0);
}

TEST_P(EveryMethod, LeavesNumbersBeyondItsSizeAlone) {
    Integrator<Numbers<2>> integrator(GetParam(), 0.05, 1);
    Numbers<2> state = start;
    for (int i = 0; i < 10; ++i) integrator.advance(nonlinear, i * 0.05, state);
    EXPECT_NE(state.values[0], start.values[0]);
    EXPECT_EQ(state.values[1], start.values[1]);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(methods),
                         [](const auto& method) { return std::string(method.param.name); });

// The starter of the Adams methods alone: a restart before every step of the highest of them.
TEST(Starter, HasOrderSix) {
    const Method& method = *find_method("ab7");
    const double coarse = error_with(method, 32, true), fine = error_with(method, 64, true);
    std::printf("starter: error %.2e, %.2e, order %.2f\n", coarse, fine, std::log2(coarse / fine));
    EXPECT_GT(fine, 1e-13);
    EXPECT_NEAR(std::log2(coarse / fine), 6, 0.25);
}

// y = cos t + e^(-50 t): fast, then slow, in steps far beyond what either would bear undivided. Errors decay as they are
// made, so the whole error is no more than a few steps' worth.
TEST(Adaptive, MeetsItsToleranceThroughFastAndSlow) {
    const auto forced = [](double t, const Numbers<1>& at, Numbers<1>& rate) {
        rate.values[0] = -50 * (at.values[0] - std::cos(t)) - std::sin(t);
    };
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
        Integrator<Numbers<1>> integrator(*find_method("dopri5"), 0.5, 1, tolerance);
        Numbers<1> state{{2}};
        for (int i = 0; i < 20; ++i) {
            integrator.advance(forced, 0.5 * i, state);
            const double t = 0.5 * (i + 1);
            EXPECT_NEAR(state.values[0], std::cos(t) + std::exp(-50 * t), 4 * tolerance);
        }
        EXPECT_TRUE(integrator.converged());
    }
}

// Its error per step is of order five in the estimate: a tolerance 1e5 smaller costs ten times the work.
TEST(Adaptive, PaysForToleranceByTheFifthRoot) {
    const auto work = [](double tolerance) {
        Integrator<Numbers<2>> integrator(*find_method("dopri5"), 200, 2, tolerance);
        Numbers<2> state{{1, 0}};
        double evaluations = 0;
        integrator.advance(
            [&](double, const Numbers<2>& at, Numbers<2>& rate) {
                ++evaluations;
                rate.values = {at.values[1], -at.values[0]};
            },
            0, state);
        EXPECT_NEAR(state.values[0], std::cos(200.0), 200 * tolerance);
        return evaluations;
    };
    EXPECT_NEAR(work(1e-10) / work(1e-5), 10, 1.5);
}

// Runs one step that cannot succeed; the guard ends it where the method would not.
template <std::size_t n, class F>
bool converges(const F& f) {
    struct NeverReturns {};
    Integrator<Numbers<n>> integrator(*find_method("dopri5"), 0.1, static_cast<int>(n));
    Numbers<n> state;
    state.values.fill(1);
    long evaluations = 0;
    try {
        integrator.advance(
            [&](double t, const Numbers<n>& at, Numbers<n>& rate) {
                if (++evaluations > 100000) throw NeverReturns{};
                f(t, at, rate);
            },
            0, state);
    } catch (NeverReturns) {
        ADD_FAILURE() << "still dividing the step after 100000 evaluations";
        return false;
    }
    return integrator.converged();
}

TEST(Adaptive, ReportsARateThatIsNotANumber) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(converges<1>([=](double, const auto&, auto& rate) { rate.values = {nan}; }));
    EXPECT_FALSE(converges<2>([=](double, const auto&, auto& rate) { rate.values = {1, nan}; }));
    EXPECT_FALSE(converges<2>([=](double, const auto&, auto& rate) { rate.values = {nan, 1}; }));
    EXPECT_FALSE(converges<2>([=](double t, const auto& y, auto& rate) {
        rate.values = {t > 0.05 ? nan : 1, -y.values[1]};
    }));
}

TEST(Adaptive, ReportsAnInfiniteRate) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(converges<1>([=](double, const auto&, auto& rate) { rate.values = {infinity}; }));
}

TEST(Adaptive, ConvergesWhereThereIsNothingToReport) {
    EXPECT_TRUE(converges<2>([](double, const auto& y, auto& rate) { rate.values = {-y.values[0], 0}; }));
}

}  // namespace
}  // namespace hamilcar
