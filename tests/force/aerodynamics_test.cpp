// Air forces against closed forms: a still car in the wind is a moving car in still air, and power is force times velocity.
#include "hamilcar/force/aerodynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hamilcar {
namespace {

AerodynamicsDescription air() {
    return {.drag_area = 0.7,
            .air_density = 1.2,
            .center = {-1.2, 0, 0.6},
            .side_area = 4.0,
            .yaw_volume = 2.5,
            .lift_area = {0.1, 0.2},
            .lift_place = {0, -2.6}};
}

Spatial<double> moving(double x, double y) {
    Spatial<double> v = Spatial<double>::Zero();
    v[0] = x, v[1] = y;
    return v;
}

TEST(Aerodynamics, GrowsWithTheSquareOfTheSpeed) {
    const Aerodynamics<double> a(air());
    const auto out = a.evaluate(moving(40, 0), Vec3<double>::Zero());
    const double q = 0.5 * 1.2 * 40 * 40;
    EXPECT_NEAR(out.wrench[0], -q * 0.7, 1e-9);
    EXPECT_NEAR(out.wrench[1], 0, 1e-9);
    EXPECT_NEAR(out.wrench[2], q * 0.3, 1e-9);
    // About the origin: drag at its height, lift at both axles.
    EXPECT_NEAR(out.wrench[4], 0.6 * out.wrench[0] - q * (0.1 * 0 + 0.2 * -2.6), 1e-9);
    EXPECT_NEAR(out.power, -q * 0.7 * 40, 1e-9);
}

TEST(Aerodynamics, DependsOnTheFlowAndNotOnTheGround) {
    const Aerodynamics<double> a(air());
    const auto driving = a.evaluate(moving(30, 5), Vec3<double>::Zero());
    const auto standing = a.evaluate(moving(0, 0), Vec3<double>(-30, -5, 0));
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(driving.wrench[i], standing.wrench[i], 1e-9);
    EXPECT_EQ(standing.power, 0) << "wind does no work on a car that stands";
    const double speed = std::sqrt(30.0 * 30 + 5 * 5);
    EXPECT_NEAR(driving.wrench[1], -0.6 * speed * 4.0 * 5, 1e-9);
    EXPECT_NEAR(driving.wrench[5], -1.2 * driving.wrench[1] - 0.6 * speed * 2.5 * 5, 1e-9);
}

TEST(Aerodynamics, HasEqualDragInAllDirectionsByDefault) {
    AerodynamicsDescription plain = air();
    plain.side_area.reset(), plain.lift_area = {0, 0}, plain.yaw_volume = 0;
    const auto out = Aerodynamics<double>(plain).evaluate(moving(12, -9), Vec3<double>::Zero());
    EXPECT_NEAR(out.wrench[0] / out.wrench[1], 12.0 / -9, 1e-12);
    EXPECT_NEAR(std::hypot(out.wrench[0], out.wrench[1]), 0.6 * 0.7 * 225, 1e-9);
}

}  // namespace
}  // namespace hamilcar
