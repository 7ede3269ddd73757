// Gains of the constraint stabilization: every rule keeps a violation decaying, and a gain that does not is refused.
#include "hamilcar/integrator/stabilization.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hamilcar/integrator/stability.hpp"

namespace hamilcar {
namespace {

SolverDescription solver(std::string_view method, StabilizationRule rule, double gain = 0) {
    return {.step = 2e-3,
            .integrator = std::string(method),
            .constraints = ConstraintMode::stabilized,
            .stabilization = rule,
            .stabilization_gain = gain};
}

// The violation's own equation, Phi' = -alpha Phi, stepped by the method.  // (27)
double growth_of_violation(const Method& method, double gain) {
    return growth(method, std::complex<double>(-2e-3 * gain));
}

TEST(StabilizationGain, ByTheMethodsLimitLetsAViolationDecay) {
    for (const Method& method : methods) {
        const GainChoice choice = stabilization_gain(solver(method.name, StabilizationRule::limit));
        EXPECT_TRUE(choice.expectation.empty()) << method.name;
        EXPECT_LT(growth_of_violation(method, choice.gain), 0.99) << method.name;
        EXPECT_GT(growth_of_violation(method, 1.6 * choice.gain), 1) << method.name << ": it could hardly be larger";
    }
}

TEST(StabilizationGain, ByThePapersTableIsItsLimitOverTheStep) {
    EXPECT_DOUBLE_EQ(stabilization_gain(solver("ab3", StabilizationRule::paper)).gain, 0.4 / 2e-3);  // Table 3
    EXPECT_THAT(stabilization_gain(solver("rk4", StabilizationRule::paper)).expectation, testing::HasSubstr("Table 3"));
}

TEST(StabilizationGain, BeyondTheLimitIsRefused) {
    for (const Method& method : methods) {
        if (method.family == MethodFamily::embedded_runge_kutta) continue;  // chooses its steps itself
        const double limit = method.real_axis_limit / 2e-3;
        EXPECT_TRUE(
            stabilization_gain(solver(method.name, StabilizationRule::value, 0.99 * limit)).expectation.empty());
        EXPECT_THAT(stabilization_gain(solver(method.name, StabilizationRule::value, 1.01 * limit)).expectation,
                    testing::HasSubstr("unstable"))
            << method.name;
    }
}

}  // namespace
}  // namespace hamilcar
