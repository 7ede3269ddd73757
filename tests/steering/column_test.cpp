// Steering columns: one ratio, and one that varies, against their tables and by differences.
#include "hamilcar/steering/column.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hamilcar {
namespace {

SteeringDescription varying() {
    return {.rack_per_revolution = 0, .rack_travel = 0.08, .angle = {0, 1, 3, 6}, .rack = {0, 0.006, 0.021, 0.051}};
}

TEST(Column, WithOneRatioIsStraight) {
    const Column column({.rack_per_revolution = 0.05, .rack_travel = 0.08});
    EXPECT_NEAR(column.rack(std::numbers::pi).displacement, 0.025, 1e-15);
    EXPECT_NEAR(column.angle(-0.05), -2 * std::numbers::pi, 1e-12);
    EXPECT_EQ(column.rack(2).curvature, 0);
    EXPECT_FALSE(Column(SteeringDescription{}).exists());
}

TEST(Column, InterpolatesItsTableOnBothSides) {
    const Column column(varying());
    for (std::size_t i = 0; i < varying().angle.size(); ++i) {
        EXPECT_NEAR(column.rack(varying().angle[i]).displacement, varying().rack[i], 1e-15);
        EXPECT_NEAR(column.rack(-varying().angle[i]).displacement, -varying().rack[i], 1e-15);
    }
    EXPECT_NEAR(column.rack(7).displacement, 0.051 + 0.01, 1e-12) << "on with the last slope";
    EXPECT_NEAR(column.center_ratio(), 0.006, 1e-12);
}

TEST(Column, HasCorrectDerivativesAndInverse) {
    const Column column(varying());
    constexpr double h = 1e-5;
    for (double angle = -7.03; angle < 7; angle += 0.317) {
        const auto at = [&](double a) { return column.rack(a).displacement; };
        EXPECT_NEAR(column.rack(angle).slope, (at(angle + h) - at(angle - h)) / (2 * h), 1e-9);
        EXPECT_NEAR(column.rack(angle).curvature,
                    (column.rack(angle + h).slope - column.rack(angle - h).slope) / (2 * h), 1e-6);
        EXPECT_NEAR(column.angle(at(angle)), angle, 1e-9);
        EXPECT_GT(column.rack(angle).slope, 0);
    }
}

// Where the ratio changes tenfold from one piece to the next a cubic through the mean slopes would turn back.
TEST(Column, NeverTurnsBackHoweverTheRatioChanges) {
    const Column column({.rack_per_revolution = 0,
                         .rack_travel = 0.08,
                         .angle = {0, 1, 2, 3, 4},
                         .rack = {0, 0.001, 0.041, 0.042, 0.082}});
    double before = column.rack(-4).displacement;
    for (double angle = -4 + 0.01; angle < 4; angle += 0.01) {
        const Column::Rack at = column.rack(angle);
        EXPECT_GT(at.displacement, before) << angle;
        EXPECT_GE(at.slope, 0) << angle;
        before = at.displacement;
    }
}

TEST(Column, MovesTheRackByTheChainRule) {
    const Column column(varying());
    const auto angle = [](double t) { return 2 + 3 * t - 0.5 * t * t; };
    constexpr double h = 1e-4;
    const SignalValue<double> moving = column.rack_motion({angle(0.2), 3 - 0.2, -1});
    const auto at = [&](double t) { return column.rack(angle(t)).displacement; };
    EXPECT_NEAR(moving.value, at(0.2), 1e-15);
    EXPECT_NEAR(moving.rate, (at(0.2 + h) - at(0.2 - h)) / (2 * h), 1e-8);
    EXPECT_NEAR(moving.acceleration, (at(0.2 + h) - 2 * at(0.2) + at(0.2 - h)) / (h * h), 1e-6);
}

}  // namespace
}  // namespace hamilcar
