// Forces along a line against closed forms: the linear spring, the piecewise linear damper with its outer slopes, the stop that is
// inactive in its gap; spring and stop are minus the derivative of their potential.
#include <gtest/gtest.h>

#include "hamilcar/force/axial.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

TEST(Spring, IsALineThroughTheForceAtDesign) {
    const Spring<double> spring{26200, 2951, 0.53};
    EXPECT_EQ(spring.force(0.53), 2951);
    EXPECT_NEAR(spring.force(0.50), 2951 + 26200 * 0.03, 1e-10) << "compressed: pushes its ends apart harder";
    EXPECT_NEAR(spring.force(0.80), 2951 - 26200 * 0.27, 1e-10) << "pulls once longer than free";
}

TEST(Spring, IsMinusTheDerivativeOfItsPotential) {
    const Spring<double> spring{26200, 2951, 0.53};
    EXPECT_EQ(spring.potential(0.53), 0);
    for (const double length : {0.4, 0.53, 0.6, 0.8}) {
        const double slope = test::derivative([&](double l) { return spring.potential(l); }, length);
        EXPECT_NEAR(spring.force(length), -slope, 1e-8) << "quadratic: only round-off of 1 kJ over 1e-3 m";
    }
}

// Degressive in rebound, soft in compression: five points, four slopes.
const DamperDescription curve{{-1.0, -0.3, 0.0, 0.2, 0.9}, {-900, -400, 0, 700, 1300}};
constexpr double newton = 1e-10;  // rounding of a few products of a thousand

TEST(Damper, PassesThroughItsPointsAndOpposesTheRate) {
    const Damper<double> damper(curve);
    for (std::size_t i = 0; i < curve.velocity.size(); ++i) {
        EXPECT_NEAR(damper.force(curve.velocity[i]), -curve.force[i], newton);
    }
    for (double rate = -3; rate < 3; rate += 0.01) EXPECT_LE(damper.force(rate) * rate, newton);
}

TEST(Damper, IsStraightBetweenItsPoints) {
    const Damper<double> damper(curve);
    for (std::size_t i = 0; i + 1 < curve.velocity.size(); ++i) {
        for (const double share : {0.2, 0.5, 0.9}) {
            const double rate = curve.velocity[i] + share * (curve.velocity[i + 1] - curve.velocity[i]);
            const double drawn = curve.force[i] + share * (curve.force[i + 1] - curve.force[i]);
            EXPECT_NEAR(damper.force(rate), -drawn, newton);
        }
    }
}

TEST(Damper, ContinuesWithTheOuterSlopes) {
    const Damper<double> damper(curve);
    EXPECT_NEAR(damper.force(-1.5), 900 + 0.5 * 500 / 0.7, newton);
    EXPECT_NEAR(damper.force(2.9), -1300 - 2.0 * 600 / 0.7, newton);
}

TEST(Damper, WithTwoPointsIsLinear) {
    const Damper<double> damper(DamperDescription{{-1, 1}, {-2093, 2093}});
    for (const double rate : {-4.0, -1.0, -0.3, 0.0, 0.7, 1.0, 5.0})
        EXPECT_NEAR(damper.force(rate), -2093 * rate, newton);
}

TEST(Damper, AcceptsTheMaximumNumberOfPoints) {
    DamperDescription many;
    for (std::size_t i = 0; i <= Damper<double>::max_segments; ++i) {
        many.velocity.push_back(static_cast<double>(i) - 3);
        many.force.push_back(std::pow(static_cast<double>(i) - 3, 3));
    }
    const Damper<double> damper(many);
    for (std::size_t i = 0; i < many.velocity.size(); ++i) {
        EXPECT_NEAR(damper.force(many.velocity[i]), -many.force[i], newton);
    }
}

TEST(Damper, RejectsTooManyPoints) {
    DamperDescription many;
    for (std::size_t i = 0; i <= Damper<double>::max_segments + 1; ++i) {
        many.velocity.push_back(static_cast<double>(i));
        many.force.push_back(static_cast<double>(i));
    }
    EXPECT_THROW(Damper<double>{many}, std::length_error);
}

TEST(Damper, WithoutPointsHasNoForce) {
    EXPECT_EQ(Damper<double>(DamperDescription{}).force(3), 0);
}

const Stop<double> stop{0.06, 60e3, 1e6};

TEST(Stop, IsZeroInItsGapAndResistsBeyond) {
    for (const double travel : {-0.2, 0.0, 0.059, 0.06}) {
        EXPECT_EQ(stop.force(travel), 0);
        EXPECT_EQ(stop.potential(travel), 0);
    }
    EXPECT_NEAR(stop.force(0.08), -(60e3 * 0.02 + 1e6 * 0.02 * 0.02), 1e-9) << "against the travel";
}

TEST(Stop, IsMinusTheDerivativeOfItsPotential) {
    for (const double travel : {0.03, 0.0605, 0.075, 0.1}) {
        const double slope = test::derivative([&](double z) { return stop.potential(z); }, travel, 1e-4);
        EXPECT_NEAR(stop.force(travel), -slope, 1e-9) << "cubic: only round-off of some joules over 1e-4 m";
    }
}

}  // namespace
}  // namespace hamilcar
