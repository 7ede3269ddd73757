// The hull on the road: pressed at rest its wrench is minus the gradient of its potential in all six directions; in motion
// friction opposes the slip and energy is only dissipated.
#include <gtest/gtest.h>

#include <random>

#include "hamilcar/force/hull.hpp"
#include "hamilcar/math/rotation.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

constexpr double stiffness = 150e3, damping = 0.5, friction = 0.5;
const PlaneRoad<double> road(0.1, -0.05, 0.8);

Hull<double> hull_of(std::vector<Point> points) {
    return Hull<double>(HullDescription{std::move(points), stiffness, damping, friction});
}
const std::vector<Point> box{
    {0.75, 0.7, 0.45}, {-3.5, 0.7, 0.45}, {0.75, -0.7, 0.45}, {-3.5, -0.7, 0.45}, {-1, 0.5, 1.4}};

// On its side, one side of the box below the road.
const Mat3<double> R_GC = axis_rotation<double>(Vec3<double>(1, 0.1, 0.2).normalized(), 1.7);
const Vec3<double> above(0.3, -0.2, 0.55);

Spatial<double> random_motion(std::mt19937& source) {
    std::uniform_real_distribution<double> unit(-1, 1);
    Spatial<double> motion;
    for (int i = 0; i < 3; ++i) motion[i] = 5 * unit(source), motion[i + 3] = 3 * unit(source);
    return motion;
}

TEST(Hull, HasNoForceAboveTheRoad) {
    const auto hull = hull_of(box);
    std::mt19937 source(1);
    const auto plane = road.seen_from(Vec3<double>(0, 0, 0.5), Mat3<double>::Identity());
    EXPECT_EQ(hull.contact(plane, random_motion(source)).wrench.norm(), 0);
    EXPECT_EQ(hull.contact(plane, random_motion(source)).lost_power, 0);
    EXPECT_EQ(hull.potential(plane), 0);
}

TEST(Hull, AtRestIsMinusTheGradientOfItsPotential) {
    const auto hull = hull_of(box);
    const auto wrench = hull.contact(road.seen_from(above, R_GC), Spatial<double>::Zero()).wrench;
    for (int i = 0; i < 6; ++i) {
        const auto potential = [&](double moved) {  // along one spatial axis of the chassis
            const Vec3<double> axis = Vec3<double>::Unit(i % 3);
            const Vec3<double> shift = i < 3 ? Vec3<double>(R_GC * axis * moved) : Vec3<double>::Zero();
            const Mat3<double> R = i < 3 ? R_GC : Mat3<double>(R_GC * axis_rotation<double>(axis, moved));
            return hull.potential(road.seen_from(above + shift, R));
        };
        EXPECT_NEAR(wrench[i], -test::derivative(potential, 0.0, 1e-4), 1e-6) << "round-off of 10 kJ over 1e-4";
        EXPECT_GT(std::abs(wrench[i]), 1) << "a direction that is not tested";
    }
}

// One point: the force splits into a normal part with Hunt and Crossley's factor and a tangential one against the slip.
// What decides whether the points are looked at: the box around them is never higher than the lowest of them.
TEST(Hull, IsInsideItsBoxHoweverItTurns) {
    const auto hull = hull_of(box);
    std::mt19937 source(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 500; ++i) {
        const Vec3<double> axis = Vec3<double>(unit(source), unit(source), unit(source)).normalized();
        const auto plane =
            road.seen_from(Vec3<double>(0, 0, 2 * unit(source)), axis_rotation<double>(axis, 3 * unit(source)));
        double lowest = 1e9;
        for (const Vec3<double>& point : hull.points) lowest = std::min(lowest, plane.normal.dot(point) - plane.offset);
        EXPECT_LE(hull.clearance(plane), lowest + 1e-12);
        EXPECT_TRUE(lowest > 0 || hull.may_touch(plane));
    }
}

TEST(Hull, FrictionOpposesTheSlip) {
    const Vec3<double> point(0.75, -0.7, 0.45);
    const auto hull = hull_of({{0.75, -0.7, 0.45}});
    const auto plane = road.seen_from(above, R_GC);
    const double depth = -road.normal.dot(above + R_GC * point);
    ASSERT_GT(depth, 0.01);
    std::mt19937 source(2);
    int pressing = 0;
    for (int i = 0; i < 100; ++i) {
        const Spatial<double> motion = random_motion(source);
        const Vec3<double> v = motion.head<3>() + Vec3<double>(motion.tail<3>()).cross(point);
        const Vec3<double> slip = v - plane.normal * plane.normal.dot(v);
        const Spatial<double> wrench = hull.contact(plane, motion).wrench;
        const Vec3<double> force = wrench.head<3>(), moment = wrench.tail<3>();
        const double normal = force.dot(plane.normal);
        const Vec3<double> rubbing = force - plane.normal * normal;
        EXPECT_NEAR(normal, std::max(0.0, stiffness * depth * (1 - damping * plane.normal.dot(v))), 1e-8);
        EXPECT_NEAR(rubbing.norm(), friction * road.friction * normal * slip.norm() / std::hypot(slip.norm(), 0.1),
                    1e-8);
        EXPECT_NEAR(rubbing.dot(slip), -rubbing.norm() * slip.norm(), 1e-8 * (1 + slip.norm()));
        EXPECT_LE((moment - point.cross(force)).norm(), 1e-8);
        pressing += normal > 0;
    }
    EXPECT_GT(pressing, 50);
    EXPECT_LT(pressing, 100) << "a separating hull must not be held";
}

// The power of the contact is its lost power minus the rate of the stored energy, and the lost power is never positive.
TEST(Hull, OnlyDissipatesEnergy) {
    const auto hull = hull_of(box);
    const auto plane = road.seen_from(above, R_GC);
    std::mt19937 source(3);
    for (int i = 0; i < 1000; ++i) {
        const Spatial<double> motion = random_motion(source);
        const auto contact = hull.contact(plane, motion);
        EXPECT_LT(contact.lost_power, 0);
        const Vec3<double> v = motion.head<3>(), w = motion.tail<3>();
        const auto potential = [&](double t) {
            const Mat3<double> turned = R_GC * axis_rotation<double>(w.normalized(), w.norm() * t);
            return hull.potential(road.seen_from(above + R_GC * v * t, turned));
        };
        const double stored = test::derivative(potential, 0.0, 1e-5);
        EXPECT_NEAR(contact.wrench.dot(motion), contact.lost_power - stored, 1e-3) << "of some 100 kW";
    }
}

}  // namespace
}  // namespace hamilcar
