// The disc on the plane: its lowest point found by search, orthonormal axes, and an exact rate of the depth for any motion of wheel
// and chassis, so that the vertical spring is conservative.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "hamilcar/math/rotation.hpp"
#include "hamilcar/tire/contact.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

constexpr double radius = 0.2948;
constexpr double exact = 1e-14;  // some ten roundings of numbers near one

TangentPlane<double> sloping_road() {
    return {Vec3<double>(-0.12, 0.08, 1).normalized(), 0.07, 1};
}

struct Wheel {
    Vec3<double> center, axis;
};

Vec3<double> lowest_of(const ContactFrame<double>& f) {
    return f.point - f.normal * f.depth;
}

// Upright, cambered, steered, nearly over: every camber up to 80 degrees.
std::array<Wheel, 5> wheels() {
    const auto axis = [](double camber, double steer) {
        return Vec3<double>(-std::sin(steer) * std::cos(camber), std::cos(steer) * std::cos(camber), std::sin(camber));
    };
    return {Wheel{{0, 0.7, 0.28}, axis(0, 0)}, Wheel{{0.1, -0.7, 0.33}, axis(0.05, 0.3)},
            Wheel{{-2.5, 0.7, 0.2}, axis(-0.4, -0.6)}, Wheel{{-2.5, -0.6, 0.5}, axis(1.0, 2.5)},
            Wheel{{0, 0.7, 0.1}, axis(-1.4, 0.1)}};
}

TEST(ContactFrame, HasOrthonormalAxesForwardLeftUp) {
    const TangentPlane<double> road = sloping_road();
    for (const auto& [center, axis] : wheels()) {
        const auto f = contact_frame<double>(road, center, axis, radius);
        Mat3<double> axes;
        axes << f.longitudinal, f.lateral, f.normal;
        EXPECT_LE((axes.transpose() * axes - Mat3<double>::Identity()).norm(), exact);
        EXPECT_NEAR(axes.determinant(), 1, exact);
        EXPECT_LE((f.normal - road.normal).norm(), exact);
        EXPECT_NEAR(f.longitudinal.dot(axis), 0, exact) << "rolling is across the spin axis";
        EXPECT_GT(f.lateral.dot(axis), 0) << "lateral points to the side of the spin axis";
    }
}

// A search over the rim needs no formula: the lowest of many points, refined by a parabola through it and its neighbors.
TEST(ContactFrame, FindsTheLowestPointOfTheDisc) {
    const TangentPlane<double> road = sloping_road();
    for (const auto& [center, axis] : wheels()) {
        const Vec3<double> a = axis.unitOrthogonal(), b = axis.cross(a);
        const auto height = [&, center = center](double turn) {
            return road.normal.dot(center + radius * (std::cos(turn) * a + std::sin(turn) * b)) - road.offset;
        };
        constexpr int points = 3600;
        constexpr double spacing = 2 * std::numbers::pi / points;
        int best = 0;
        for (int i = 1; i < points; ++i) best = height(i * spacing) < height(best * spacing) ? i : best;
        const double h0 = height((best - 1) * spacing), h1 = height(best * spacing), h2 = height((best + 1) * spacing);
        const double lowest = h1 - (h2 - h0) * (h2 - h0) / (8 * (h0 - 2 * h1 + h2));
        const auto f = contact_frame<double>(road, center, axis, radius);
        EXPECT_NEAR(f.depth, -lowest, 1e-9) << "spacing^3 times the radius";
        EXPECT_NEAR(road.normal.dot(lowest_of(f)) - road.offset, -f.depth, exact);
        EXPECT_NEAR((lowest_of(f) - center).norm(), radius, exact) << "on the rim";
        EXPECT_NEAR((lowest_of(f) - center).dot(axis), 0, exact) << "in the wheel's plane";
        EXPECT_NEAR(road.normal.dot(f.point), road.offset, exact) << "on the road";
        EXPECT_NEAR((f.point - lowest_of(f)).cross(road.normal).norm(), 0, exact) << "straight above the lowest point";
    }
}

// The lever turns spin into speed of the disc's material at P; upright it is the loaded radius.
TEST(ContactFrame, LeverIsTheSpeedPerSpinOfTheMaterialAtTheContact) {
    const TangentPlane<double> road = sloping_road();
    for (const auto& [center, axis] : wheels()) {
        const auto f = contact_frame<double>(road, center, axis, radius);
        const auto spun = [&, c = center, e = axis](double angle) {
            return Vec3<double>(c + axis_rotation<double>(e, angle) * (f.point - c));
        };
        const Vec3<double> velocity = test::derivative(spun, 0.0);
        EXPECT_NEAR(f.longitudinal.dot(velocity), -f.lever, 1e-12) << "spinning forward moves the contact backward";
    }
    const TangentPlane<double> flat{Vec3<double>::UnitZ(), 0, 1};
    EXPECT_NEAR(contact_frame<double>(flat, {0, 0, 0.28}, Vec3<double>::UnitY(), radius).lever, 0.28, exact);
}

// The wheel moves along a screw relative to a chassis that moves along another one, over a fixed road.
TEST(ContactFrame, DepthRateIsMinusTheNormalVelocityOfTheLowestPoint) {
    const PlaneRoad<double> road(0.12, -0.08, 1);
    const Vec3<double> wheel_spin(0.5, 0.2, 1.2), wheel_velocity(0.1, -0.3, 0.8), chassis_spin(0.7, -0.4, 0.9),
        chassis_velocity(12, 2, -0.6);
    for (const auto& [center, axis] : wheels()) {
        const auto turned = [](const Vec3<double>& spin, double t) {
            return axis_rotation<double>(spin.normalized(), spin.norm() * t);
        };
        const auto frame_at = [&, c = center, e = axis](double t) {
            const auto seen = road.seen_from(chassis_velocity * t, turned(chassis_spin, t));
            const Mat3<double> R = turned(wheel_spin, t);
            return contact_frame<double>(seen, c + wheel_velocity * t, R * e, radius);
        };
        const auto f = frame_at(0);
        const double rate = test::derivative([&](double t) { return frame_at(t).depth; }, 0.0);
        const Vec3<double> in_chassis = wheel_velocity + wheel_spin.cross(lowest_of(f) - center);
        const Vec3<double> velocity = in_chassis + chassis_velocity + chassis_spin.cross(lowest_of(f));
        EXPECT_NEAR(rate, -f.normal.dot(velocity), 1e-10);
        EXPECT_GT(std::abs(rate), 0.01);
    }
}

TEST(ContactFrame, StaysFiniteForAWheelLyingFlat) {
    const TangentPlane<double> road = sloping_road();
    for (const double tilt : {0.0, 1e-12, 1e-6, 1e-3}) {
        for (const double side : {1.0, -1.0}) {
            const Vec3<double> axis = axis_rotation<double>(road.normal.unitOrthogonal(), tilt) * (side * road.normal);
            const auto f = contact_frame<double>(road, {0, 0.7, 0.1}, axis, radius);
            for (const Vec3<double>& v : {lowest_of(f), f.point, f.longitudinal, f.lateral, f.normal}) {
                EXPECT_TRUE(v.allFinite());
                EXPECT_LE(v.norm(), 2);
            }
            EXPECT_LE(std::abs(f.depth), 1);
            EXPECT_LE(std::abs(f.lever), radius + std::abs(f.depth));
        }
    }
}

}  // namespace
}  // namespace hamilcar
