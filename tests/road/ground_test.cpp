// The plane under a wheel: on a plane road it is the road; on a surface it is the least-squares plane; its rate agrees with finite
// differences; and each lane gives the same result as a single car.
#include "hamilcar/road/traced_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "hamilcar/math/rotation.hpp"

namespace hamilcar {
namespace {

constexpr double radius = 0.3;

const Vec3<double> turning(0.02, -0.3, 0.4);

WheelOverGround<double> rolling(double x, double y, double heading, double speed) {
    const Vec3<double> axis(-std::sin(heading) * 0.999, std::cos(heading) * 0.999, std::sqrt(1 - 0.999 * 0.999));
    return {.center = {x, y, radius - 0.015},
            .velocity = {speed * std::cos(heading), speed * std::sin(heading), 0.1},
            .axis = axis,
            .axis_rate = turning.cross(axis),
            .radius = radius};
}

// For a unit at the ground's origin.
WheelGround<double> fitted(const Surface& surface, const Vec3<double>& normal, double friction,
                           const WheelOverGround<double>& wheel, double time) {
    const UnevenGround<double> ground{&surface, normal, friction, Vec3<double>::Zero(), Mat3<double>::Identity(), time};
    const auto motion = spatial<double>(wheel.velocity - turning.cross(wheel.center), turning);
    WheelGround<double> road{{normal, 0, friction}, 0};
    fit_ground<double>(ground, wheel.center, wheel.axis, motion, wheel.radius, 0, {0, 0}, road);
    return road;
}

Vec3<double> plane_normal(double grade, double bank) {
    return PlaneRoad<double>(grade, bank, 1).normal;
}

TEST(Ground, OnAPlaneRoadIsThePlane) {
    const Surface nothing{RoadDescription{}};
    const Vec3<double> n = plane_normal(0.2, -0.1);
    for (const double heading : {0.0, 0.7, 2.9}) {
        const auto found = fitted(nothing, n, 0.8, rolling(3, -2, heading, 10), 0);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(found.plane.normal[i], n[i], 1e-14);
        EXPECT_NEAR(found.plane.offset, 0, 1e-14);
        EXPECT_NEAR(found.plane.friction, 0.8, 1e-15);
        EXPECT_NEAR(found.rise, 0, 1e-12) << "a plane does not rise";
    }
}

// A grid that is itself a sloped plane.
TEST(Ground, FollowsASlopeOfTheSurface) {
    auto grid = std::make_shared<HeightGridDescription>();
    grid->x = -50, grid->y = -50, grid->spacing_x = grid->spacing_y = 1, grid->rows = grid->columns = 101;
    for (int row = 0; row < 101; ++row) {
        for (int column = 0; column < 101; ++column)
            grid->heights.push_back(0.3 + 0.1 * (column - 50) - 0.05 * (row - 50));
    }
    RoadDescription road;
    road.grid = grid;
    const Surface surface(road);
    const auto found = fitted(surface, plane_normal(0, 0), 1, rolling(4, 7, 0.4, 20), 0);
    const Vec3<double> n = plane_normal(0.1, -0.05);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found.plane.normal[i], n[i], 1e-13);
    EXPECT_NEAR(found.plane.offset, n[2] * 0.3, 1e-13);
    EXPECT_NEAR(found.rise, 0, 1e-12);
}

RoadDescription rough() {
    RoadDescription road;
    road.obstacles.push_back(
        {.shape = ObstacleShape::plateau, .start = 1, .length = 0.5, .height = 0.02, .ramp = 0.05});
    road.waves.push_back({.amplitude = 0.05, .wavelength = 3, .right_phase = 1.5});
    road.random.push_back({.road_class = 'D', .start = -100});
    road.patches.push_back({.start = -10, .end = 10, .right = 0, .left = 10, .friction = 0.2});
    return road;
}

// Least squares by normal equations, with the weights stated in the docs.
TEST(Ground, IsTheLeastSquaresPlane) {
    const Surface surface(rough());
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-2, 4), turn(-3, 3);
    for (int trial = 0; trial < 50; ++trial) {
        const double x = place(random), y = 0.3 * place(random), heading = turn(random);
        const auto found = fitted(surface, plane_normal(0, 0), 1, rolling(x, y, heading, 0), 0);
        Mat3<double> A = Mat3<double>::Zero();
        Vec3<double> b = Vec3<double>::Zero();
        double friction = 0;
        const std::array<double, 5> stations{-1, -0.5, 0, 0.5, 1}, weights{1, 3, 4, 3, 1};
        for (const double side : {-1, 1}) {
            for (std::size_t i = 0; i < 5; ++i) {
                const double along = radius / 3 * stations[i], across = radius / 4 * side, w = weights[i] / 24;
                const double at_x = x + along * std::cos(heading) - across * std::sin(heading);
                const double at_y = y + along * std::sin(heading) + across * std::cos(heading);
                const Vec3<double> row(1, at_x, at_y);
                A += w * row * row.transpose();
                b += w * row * surface.height(at_x, at_y);
                friction += w * surface.friction(at_x, at_y);
            }
        }
        const Vec3<double> fit = A.inverse() * b;  // z = fit0 + fit1 x + fit2 y
        EXPECT_NEAR(-found.plane.normal[0] / found.plane.normal[2], fit[1], 1e-9);
        EXPECT_NEAR(-found.plane.normal[1] / found.plane.normal[2], fit[2], 1e-9);
        EXPECT_NEAR(found.plane.offset / found.plane.normal[2], fit[0], 1e-9);
        EXPECT_NEAR(found.plane.friction, friction, 1e-12);
    }
}

// The stated rate of the depth of the disc's lowest point, on which the damper and the energy balance rely.
TEST(Ground, RiseAgreesWithDifferences) {
    RoadDescription road = rough();
    road.posts.height.push_back({.time = {0, 1, 2}, .value = {0, 0.1, 0}});
    const Surface surface(road);
    const auto depth = [&](double t) {
        WheelOverGround<double> wheel = rolling(0.8, 0.2, 0.3, 15);
        wheel.center += t * wheel.velocity, wheel.axis += t * wheel.axis_rate;
        wheel.axis.normalize();
        const auto found = fitted(surface, plane_normal(0.02, 0.01), 1, wheel, 0.4 + t);
        const double s = found.plane.normal.dot(wheel.axis), c = std::sqrt(1 - s * s);
        const Vec3<double> lowest = wheel.center - radius * (found.plane.normal - s * wheel.axis) / c;
        return found.plane.offset - found.plane.normal.dot(lowest);
    };
    const WheelOverGround<double> wheel = rolling(0.8, 0.2, 0.3, 15);
    const auto found = fitted(surface, plane_normal(0.02, 0.01), 1, wheel, 0.4);
    const double s = found.plane.normal.dot(wheel.axis), c = std::sqrt(1 - s * s);
    const Vec3<double> arm = -radius * (found.plane.normal - s * wheel.axis) / c;
    const double stated = found.rise - found.plane.normal.dot(Vec3<double>(wheel.velocity + turning.cross(arm)));
    constexpr double h = 1e-5;
    EXPECT_NEAR(stated, (depth(h) - depth(-h)) / (2 * h), 1e-6 * (1 + std::abs(stated)));
    EXPECT_GT(std::abs(found.rise), 0.01) << "otherwise the test is meaningless";
}

RoadDescription everything() {
    RoadDescription d;
    d.obstacles = {{.start = 2, .length = 3, .height = 0.08, .ramp = 0.5}, {.start = 4, .length = 2, .height = -0.1}};
    d.waves = {{.start = -20, .amplitude = 0.03, .wavelength = 4}};
    d.random = {{.road_class = 'C', .start = -20}};
    HeightGridDescription grid{.x = -5, .y = -3, .spacing_x = 0.5, .spacing_y = 0.5, .rows = 12, .columns = 20};
    for (std::size_t i = 0; i < grid.rows * grid.columns; ++i) grid.heights.push_back(i % 2 == 0 ? 0.05 : -0.05);
    d.grid = std::make_shared<const HeightGridDescription>(grid);
    return d;
}

// Checkered heights make the grid's cubics overshoot.
TEST(Surface, StaysBelowItsMaximumHeight) {
    const Surface surface(everything());
    std::mt19937 source(11);
    std::uniform_real_distribution<double> along(-10, 30), across(-4, 4);
    double most = 0;
    for (int i = 0; i < 200'000; ++i) most = std::max(most, surface.height(along(source), across(source)));
    EXPECT_LE(most, surface.max_height());
    EXPECT_GT(most, 0.4 * surface.max_height()) << "the bound is useful";
}

// Wheels higher above the plane than that get the plane, lower ones the surface.
TEST(Ground, HighAboveTheSurfaceIsThePlane) {
    const Surface surface(everything());
    const PlaneRoad<double> plane(0.03, 0.01, 0.9);
    const Vec3<double> position(2.7, 0.1, 0.5), center(0.2, 0.6, -0.2);
    const Mat3<double> R = axis_rotation<double>(Vec3<double>::UnitZ(), 0.4);
    const UnevenGround<double> ground{&surface, plane.normal, 0.9, position, R, 0};
    const UnitGround<double> below{plane.seen_from(position, R), &ground};
    const auto normal_for = [&](double clearance) {
        return below.under(center, Vec3<double>::UnitY(), Spatial<double>::Zero(), radius, clearance, {0, 0})
            .plane.normal;
    };
    EXPECT_EQ(normal_for(1.001 * surface.max_height()), below.plane.normal);
    EXPECT_GT((normal_for(0.999 * surface.max_height()) - below.plane.normal).norm(), 1e-3);
}

// Three cars in the lanes of a program's call, one on a plane and one high above: each gets the same result as alone.
TEST(Ground, LanesAreIndependent) {
    const Surface surface(rough());
    const PatchPose<double> place{0.7, 0.1, 0.2, 0.6, 12, 0.3, 0.8, -0.6, 0.06, 0.08, radius, 0};
    PatchPose<double> high = place;
    high.clearance = 1.001 * surface.max_height();
    std::array<double, 3 * PatchPose<double>::count> arguments;
    std::array<double, 3 * PatchPlane<double>::count> found;
    for (std::size_t l = 0; l < 3; ++l) {
        std::size_t next = l;
        PatchPose<double>::for_each(l == 2 ? high : place, [&](double n) { arguments[next] = n, next += 3; });
    }
    const std::array<const Surface*, 3> surfaces{&surface, nullptr, &surface};
    const std::vector<double> times(surfaces.size());
    const LaneSurfaces below{surfaces.data(), times.data(), 0};
    look_up_ground<double>(&below, 0, 3, arguments.data(), found.data());
    const std::array<PatchPlane<double>, 3> expected{surface.under(place, 0, 0), {}, {}};
    EXPECT_EQ(expected[0].found, 1);
    EXPECT_NE(expected[0].height, 0);
    for (std::size_t l = 0; l < 3; ++l) {
        std::size_t at = l;
        PatchPlane<double>::for_each(expected[l], [&](double right) {
            EXPECT_EQ(found[at], right);
            at += 3;
        });
    }
}

// The fast path for doubles agrees with the general path for dual numbers: on the road, at its ends, beside it.
TEST(Ground, FastPathAgreesWithTheGeneralOne) {
    RoadDescription road;
    road.random.push_back({.road_class = 'D', .start = 10, .length = 100, .fade = 5});
    const Surface surface(road);
    std::mt19937 source(3);
    std::uniform_real_distribution<double> along(8, 112), across(-2, 2), turn(-3, 3);
    using Number = Dual<double, 1>;
    for (int i = 0; i < 5000; ++i) {
        const double heading = turn(source), c = std::cos(heading), s = std::sin(heading);
        const PatchPose<double> place{-5, 2, 5 + along(source), -2 + across(source), 20, 3, c, s, -s, c, radius, 0};
        PatchPose<Number> same;
        std::vector<double> numbers;
        PatchPose<double>::for_each(place, [&](double n) { numbers.push_back(n); });
        std::size_t next = 0;
        PatchPose<Number>::for_each(same, [&](Number& n) { n = Number(numbers[next++]); });
        std::vector<double> expected;
        PatchPlane<Number>::for_each(surface.under(same, 0, 0),
                                     [&](const Number& n) { expected.push_back(n.value()); });
        next = 0;
        PatchPlane<double>::for_each(surface.under(place, 0, 0),
                                     [&](double n) { EXPECT_NEAR(n, expected[next++], 1e-11) << place.x; });
    }
}

}  // namespace
}  // namespace hamilcar
