// Paths against closed forms: lines, circles, a clothoid; and the nearest point on them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "hamilcar/driver/path.hpp"
#include "support/allocation_guard.hpp"

namespace hamilcar {
namespace {

constexpr double pi = std::numbers::pi;

PathDescription circle(double radius, int count) {
    PathDescription path{.closed = true};
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * pi * i / count;
        path.points.push_back({radius * std::sin(angle), radius * (1 - std::cos(angle))});
    }
    return path;
}

TEST(Path, ThroughTwoPointsIsAnInfiniteLine) {
    const Path path({.points = {{1, 2}, {4, 6}}});
    EXPECT_NEAR(path.length(), 5, 1e-12);
    for (const double station : {-10.0, 0.0, 2.0, 5.0, 30.0}) {
        const PathPoint point = path.at(station);
        EXPECT_NEAR(point.x, 1 + 0.6 * station, 1e-11);
        EXPECT_NEAR(point.y, 2 + 0.8 * station, 1e-11);
        EXPECT_NEAR(point.heading(), std::atan2(4, 3), 1e-14);
        EXPECT_EQ(point.curvature, 0);
        const PathPlace place = path.nearest(point.x - 0.8 * 1.5, point.y + 0.6 * 1.5, station - 3);
        EXPECT_NEAR(place.station, station, 1e-9);
        EXPECT_NEAR(place.offset, 1.5, 1e-11) << "to the left";
    }
}

TEST(Path, PassesThroughItsPointsWithoutAKink) {
    const PathDescription description{.points = {{0, 0}, {10, 1}, {12, 6}, {30, 6}, {31, 2}, {20, -9}}};
    const Path path(description);
    PathPlace place;
    for (const auto& [x, y] : description.points) {
        place = path.nearest(x, y, place.station);
        EXPECT_NEAR(place.offset, 0, 1e-9);
        const PathPoint before = path.at(place.station - 1e-6), after = path.at(place.station + 1e-6);
        EXPECT_NEAR(std::remainder(before.heading() - after.heading(), 2 * pi), 0, 1e-5);
        EXPECT_NEAR(before.curvature, after.curvature, 1e-4);
    }
    EXPECT_NEAR(path.at(0).curvature, 0, 1e-12);
    EXPECT_NEAR(path.at(path.length()).curvature, 0, 1e-12);
}

// Heading and curvature are the derivatives of the position by the station, so a station is a length.
TEST(Path, StationIsArcLength) {
    const Path path({.points = {{0, 0}, {10, 1}, {14, 6}, {30, 7}, {33, 2}, {20, -9}}});
    const double h = 1e-4;
    for (double station = 0.5; station < path.length(); station += 0.7) {
        const PathPoint before = path.at(station - h), here = path.at(station), after = path.at(station + h);
        EXPECT_NEAR((after.x - before.x) / (2 * h), here.tangent_x, 1e-3);
        EXPECT_NEAR((after.y - before.y) / (2 * h), here.tangent_y, 1e-3);
        EXPECT_NEAR(std::remainder(after.heading() - before.heading(), 2 * pi) / (2 * h), here.curvature, 1e-3);
    }
}

TEST(Path, ClosedThroughACircleIsThatCircle) {
    const double radius = 100;
    const Path path(circle(radius, 36));
    EXPECT_NEAR(path.length(), 2 * pi * radius, 2e-3);
    for (double station = 0; station < 3 * path.length(); station += 37.1) {
        const PathPoint point = path.at(station);
        EXPECT_NEAR(std::hypot(point.x, point.y - radius), radius, 2e-3);
        EXPECT_NEAR(point.curvature, 1 / radius, 1e-4);
        EXPECT_NEAR(point.x, radius * std::sin(station / radius), 0.01);
    }
}

// The error of a cubic spline falls with the fourth power of its spacing, that of its curvature with the second.
TEST(Path, ConvergesToAClothoid) {
    const auto error = [](int count) {
        const double length = 80, sharpness = 4e-4;  // curvature over station
        PathDescription description;
        double x = 0, y = 0;
        const int fine = 2000;
        for (int i = 0; i <= count * fine; ++i) {
            if (i % fine == 0) description.points.push_back({x, y});
            const double step = length / (count * fine), s = (i + 0.5) * step;
            x += step * std::cos(0.5 * sharpness * s * s), y += step * std::sin(0.5 * sharpness * s * s);
        }
        return std::abs(Path(description).at(length / 2).curvature - sharpness * length / 2);
    };
    EXPECT_LT(error(8), 1e-3);
    EXPECT_LT(error(32), error(8) / 10);
}

TEST(Path, CountsLaps) {
    const Path path(circle(30, 24));
    PathPlace place = path.nearest_of_all(0, 0, 0);
    for (int i = 0; i <= 3600; ++i) {
        const double angle = i * pi / 600;  // three times around, a meter to the right of the path
        place = path.nearest(31 * std::sin(angle), 30 - 31 * std::cos(angle), place.station);
        EXPECT_NEAR(place.offset, -1, 1e-3);
        EXPECT_NEAR(place.station, angle * 30, 0.02 + 1e-4 * place.station);
    }
    EXPECT_NEAR(place.station, 3 * path.length(), 0.01);
}

TEST(Path, FindsTheBranchInTheDirectionOfTravel) {
    const Path there_and_back({.points = {{0, 0}, {50, 0}, {60, 3}, {50, 6}, {0, 6}}});
    EXPECT_LT(there_and_back.nearest_of_all(20, 3.2, 0).station, 25);
    EXPECT_GT(there_and_back.nearest_of_all(20, 2.8, pi).station, 80);
}

TEST(Path, DoesNotLoseACarThatCutsAHairpin) {
    const Path path({.points = {{0, 0}, {20, 0}, {24, 2}, {24, 4}, {20, 6}, {0, 6}}});
    double station = path.nearest_of_all(15, 0, 0).station;
    for (double y = 0; y <= 6; y += 0.05) station = path.nearest(20, y, station).station;
    EXPECT_GT(station, 25);
    for (double x = 20; x > 0; x -= 0.2) station = path.nearest(x, 6, station).station;
    EXPECT_NEAR(station, path.length(), 0.5);
}

// The direction is defined even where the spline's speed is nearly zero.
TEST(Path, HasADirectionEverywhere) {
    const Path hairpin({.points = {{0, 0}, {20, 0}, {0.5, 2.5}}});
    for (double station = 0; station < hairpin.length(); station += 0.01) {
        const PathPoint point = hairpin.at(station);
        ASSERT_NEAR(std::hypot(point.tangent_x, point.tangent_y), 1, 1e-9) << station;
        ASSERT_TRUE(std::isfinite(point.curvature)) << station;
    }
}

TEST(Path, QueriesAllocateNothing) {
    const Path path(circle(40, 16));
    const test::AllocationGuard guard;
    path.at(1000);
    path.nearest(1, 2, path.nearest_of_all(1, 2, 0.5).station);
    EXPECT_EQ(guard.allocations(), 0);
}

std::string mistake(const PathDescription& description) {
    try {
        const Path path(description);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

TEST(Path, RejectsInvalidPoints) {
    EXPECT_EQ(mistake({.points = {{0, 0}}}), "a path needs at least 2 points, found 1");
    EXPECT_EQ(mistake({.points = {{0, 0}, {1, 0}}, .closed = true}),
              "a path needs at least 3 points to be closed, found 2");
    EXPECT_EQ(mistake({.points = {{0, 0}, {1, 0}, {1, 0}}}), "points 2 and 3 of the path coincide");
    EXPECT_THAT(mistake({.points = {{0, 0}, {1, 0}, {0, 0}}, .closed = true}),
                testing::HasSubstr("points 3 and 1 of the path coincide; do not repeat"));
    EXPECT_EQ(mistake({.points = {{0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0}}}),
              "point 2 of the path is not a number");
    EXPECT_EQ(mistake({.points = {{0, 0}, {1e12, 0}}}),
              "point 2 of the path lies at 1e+12 m; expected within 1e+06 m of the origin");
    EXPECT_EQ(mistake({.points = {{0, -1e200}, {1, 0}}}),
              "point 1 of the path lies at -1e+200 m; expected within 1e+06 m of the origin");
    EXPECT_EQ(mistake({.points = {{0, 0}, {20, 0}, {0, 0}}}), "the path turns back on itself at point 2");
    EXPECT_EQ(mistake({.points = {{0, 0}, {10, 0}, {20, 0}, {5, 0.5}}}), "the path turns back on itself at point 3");
    EXPECT_EQ(mistake({.points = {{0, 0}, {10, 0}, {20, 0}}, .closed = true}),
              "the path turns back on itself at point 3");
    PathDescription meander;
    for (double y = 0; y < 100; y += 2) {
        for (const double x : {-1e6, 0.0, 1e6}) meander.points.push_back({std::fmod(y, 4) == 0 ? x : -x, 1e3 * y});
    }
    EXPECT_THAT(mistake(meander), testing::HasSubstr("m long; expected at most 1e+07 m"));
}

TEST(Path, SearchesTheLongestPathQuickly) {
    const Path path({.points = {{-1e6, -1e6}, {1e6, 1e6}}});
    const auto begin = std::chrono::steady_clock::now();
    const PathPlace place = path.nearest_of_all(1000, 1010, 0.5);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    EXPECT_NEAR(place.station, std::sqrt(2) * (1e6 + 1005), 1e-3);
    EXPECT_NEAR(place.offset, 5 * std::sqrt(2), 1e-6);
    EXPECT_LT(taken.count(), 2.0);
}

}  // namespace
}  // namespace hamilcar
