// OpenCRG roads against closed forms: lines whose samples lie on a circle, heights that are known functions of u and v,
// and small grids computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

#include "hamilcar/road/crg_road.hpp"
#include "hamilcar/scalar/dual.hpp"
#include "road/crg_shapes.hpp"
#include "support/allocation_guard.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

using test::Arc, test::fill, test::ramp, test::straight;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(CrgRoad, DefaultConstructedIsFlat) {
    const CrgRoad road;
    EXPECT_EQ(road.height(1.0, 2.0), 0);
    EXPECT_FALSE(road.covers(0, 0));
}

TEST(CrgRoad, BilinearByHand) {
    CrgDescription d = straight([](double, double) { return 0; });
    d.heights[3 * 1 + 1] = 0.3;  // the node u = 1, v = 0
    const CrgRoad road(d);
    EXPECT_DOUBLE_EQ(road.height(1.0, 0.0), 0.3);
    EXPECT_DOUBLE_EQ(road.height(0.5, 0.0), 0.15);
    EXPECT_DOUBLE_EQ(road.height(1.25, 0.5), 0.3 * 0.75 * 0.75) << "0.5 of the 2 m to the next section";
    EXPECT_DOUBLE_EQ(road.height(1.25, -0.5), 0.3 * 0.75 * 0.5);
    EXPECT_DOUBLE_EQ(road.height(2.5, 0.0), 0);
}

TEST(CrgRoad, LineMayStartAnywhere) {
    CrgDescription d = straight([](double u, double v) { return 0.1 * u - 0.2 * v; });
    d.u_start = 0;
    d.x = 10, d.y = -20, d.z = 3, d.phi = 0.5;
    const CrgRoad road(d);
    const double u = 2.3, v = 0.7, c = std::cos(0.5), s = std::sin(0.5);
    EXPECT_NEAR(road.height(10 + u * c - v * s, -20 + u * s + v * c), 3 + 0.1 * u - 0.2 * v, 1e-12);
    const CrgPoint p = road.xy_of(u, v);
    EXPECT_NEAR(p.x, 10 + u * c - v * s, 1e-12);
    EXPECT_NEAR(p.y, -20 + u * s + v * c, 1e-12);
}

// u, v of points on an arc, and back, inside and outside.
TEST(CrgRoad, ArcAgainstItsCircle) {
    for (const double radius : {12.0, -12.0, 300.0}) {
        const Arc arc{radius, 0.25, 120};
        const auto z = [](double u, double v) { return 0.02 * u - 0.03 * v + 0.001 * u * v; };
        const CrgRoad road(arc.description({-4, -1, 0, 0.5, 3}, z));
        std::mt19937 source(1);
        std::uniform_real_distribution<double> unit(0, 1);
        for (int i = 0; i < 2000; ++i) {
            const auto segment = static_cast<std::size_t>(1 + 117 * unit(source));  // with cross sections that bisect
            const double part = unit(source), v = -4 + 7 * unit(source);
            const double u = (static_cast<double>(segment) + part) * arc.chord;
            const CrgPoint p = arc.at(segment, part, v);
            const auto place = road.uv_of(p.x, p.y);
            EXPECT_NEAR(place.u, u, 1e-10);
            EXPECT_NEAR(place.v, v, 1e-10);
            EXPECT_NEAR(road.height(p.x, p.y), z(u, v), 1e-10) << "bilinear in each cell, so exact";
            const CrgPoint back = road.xy_of(u, v);
            EXPECT_NEAR(back.x, p.x, 1e-10);
            EXPECT_NEAR(back.y, p.y, 1e-10);
        }
    }
}

// A circle about the bend's center crosses all cross sections: the height must be continuous along it, on and off the road.
TEST(CrgRoad, ContinuousAcrossSegments) {
    const Arc arc{12, 0.5, 60};
    const CrgRoad road(
        arc.description({-4, -1, 0, 0.5, 3}, [](double u, double v) { return 0.05 * std::sin(u) * std::cos(2 * v); }));
    for (const double v : {-10.0, -3.9, -1.0, 0.3, 2.9, 6.0}) {
        double before = nan;
        for (double angle = -0.2; angle < 2.6; angle += 1e-5) {
            const double r = 12 - v, height = road.height(r * std::sin(angle), 12 - r * std::cos(angle));
            EXPECT_NEAR(height, std::isnan(before) ? height : before, 6e-5) << "v " << v << " angle " << angle;
            before = height;
        }
    }
}

TEST(CrgRoad, SlopeAndBankingAddToTheGrid) {
    CrgDescription d = straight([](double, double) { return 0; });
    d.z = 1;
    d.slopes = {0.1, 0.1, -0.2, 0};
    d.bankings = {0, 0.1, 0.1, 0.2, 0};
    const CrgRoad road(d);
    EXPECT_NEAR(road.height(2.5, 0.0), 1 + 0.1 + 0.1 - 0.1, 1e-12);
    EXPECT_NEAR(road.height(2.5, 2.0), 1.1 + 2 * 0.15, 1e-12);
    EXPECT_NEAR(road.height(2.5, -1.0), 1.1 - 0.15, 1e-12);
    d.slopes.clear(), d.bankings.clear();
    d.slope = 0.05, d.banking = -0.02;
    EXPECT_NEAR(CrgRoad(d).height(2.5, 1.0), 1 + 0.125 - 0.02, 1e-12);
}

// With two segments the end is known exactly and the middle is the mean of both sums.
TEST(CrgRoad, KnownEndIsMet) {
    CrgDescription d;
    d.u_increment = 1;
    d.v = {-1, 1};
    d.headings = {0, 0};
    d.slopes = {0.1, 0.1};
    fill(d, 3, [](double, double) { return 0; });
    d.end_x = 2.02, d.end_y = 0, d.end_z = 0.24;
    const CrgRoad road(d);
    EXPECT_NEAR(road.xy_of(2, 0).x, 2.02, 1e-12);
    EXPECT_NEAR(road.xy_of(1, 0).x, 0.5 * 1 + 0.5 * 1.02, 1e-12);
    EXPECT_NEAR(road.height_uv(2.0, 0.0), 0.24, 1e-12);
}

// The weights of elevations lag behind those of x and y by one row, as in OpenCRG's library: 0 and 1/3 on the way to the end.
TEST(CrgRoad, KnownElevationOfTheEndIsMet) {
    CrgDescription d;
    d.u_increment = 1;
    d.v = {-1, 1};
    d.headings = {0, 0, 0};
    d.slopes = {0.1, 0.1, 0.1};
    fill(d, 4, [](double, double) { return 0; });
    d.end_z = 0.36;
    const CrgRoad road(d);
    EXPECT_NEAR(road.height_uv(1.0, 0.0), 0.1, 1e-12);
    EXPECT_NEAR(road.height_uv(2.0, 0.0), 2.0 / 3 * 0.2 + 1.0 / 3 * 0.26, 1e-12);
    EXPECT_NEAR(road.height_uv(3.0, 0.0), 0.36, 1e-12);
}

TEST(CrgRoad, DerivativesAreThoseOfTheSurface) {
    using Number = Dual<double, 2>;
    const Arc arc{15, 0.5, 40};
    CrgDescription d =
        arc.description({-3, -1, 0, 2}, [](double u, double v) { return 0.1 * std::sin(u) * std::cos(v); });
    d.slopes.assign(39, 0.03), d.banking = 0.05;
    std::mt19937 source(2);
    for (const CrgBorder border : {CrgBorder::keep, CrgBorder::repeat, CrgBorder::reflect}) {
        d.border_u = d.border_v = border;
        const CrgRoad road(d);
        std::uniform_real_distribution<double> across(-30, 30), along(-5, 30);
        int tried = 0;
        for (int i = 0; i < 3000; ++i) {
            const double x = across(source), y = along(source), step = 1e-6;
            if (std::hypot(x, y - 15) < 3) continue;  // where cross sections meet
            const auto along_x = [&](double t) { return road.height(t, y); };
            const auto along_y = [&](double t) { return road.height(x, t); };
            const auto kinked = [&](const auto& f, double t) {  // an edge of a cell within the difference's reach
                return std::abs(f(t + 4 * step) + f(t - 4 * step) - 2 * f(t)) > 1e-10;
            };
            if (kinked(along_x, x) || kinked(along_y, y)) continue;
            const Number z = road.height(Number::variable(x, 0), Number::variable(y, 1));
            EXPECT_EQ(z.value(), road.height(x, y));
            EXPECT_NEAR(z.partial(0), test::derivative(along_x, x, step), 1e-7) << x << ' ' << y;
            EXPECT_NEAR(z.partial(1), test::derivative(along_y, y, step), 1e-7) << x << ' ' << y;
            ++tried;
        }
        EXPECT_GT(tried, 2000);
    }
}

// A hairpin whose legs are closer than a cell: every point is assigned to its own leg.
TEST(CrgRoad, LegsNextToEachOther) {
    CrgDescription d;
    d.u_increment = 0.1;
    d.v = {-1, 1};
    const double pi = std::acos(-1.0);
    for (int i = 0; i < 300; ++i) d.headings.push_back(0);
    for (int i = 0; i < 47; ++i) d.headings.push_back(pi * (i + 0.5) / 47);
    for (int i = 0; i < 300; ++i) d.headings.push_back(pi);
    fill(d, d.headings.size() + 1, [](double u, double) { return 0.01 * u; });
    const CrgRoad road(d);
    const double width = 0.1 / std::sin(pi / 94);  // a polygon's diameter: the legs' distance
    for (double x = 0.5; x < 29; x += 0.37)
        for (const double v : {-0.9, 0.0, 0.9}) {
            EXPECT_NEAR(road.height(x, v), 0.01 * x, 1e-9);
            EXPECT_NEAR(road.height(x, width - v), 0.01 * (30 + 4.7 + 30 - x), 1e-9);
        }
}

TEST(CrgRoad, CellsAndTreeAgree) {
    // Cells extend 8 m beyond the grid's 2 m.
    const Arc arc{900, 0.5, 4000};
    const CrgRoad road(arc.description({-2, 2}, [](double u, double) { return 0.001 * u; }));
    for (const double v : {-2000.0, -200.0, -30.0, -11.0, -9.0, 0.0, 9.0, 11.0, 200.0, 700.0}) {
        for (const std::size_t segment : {5U, 300U, 1777U, 3990U}) {
            const CrgPoint p = arc.at(segment, 0.25, v);
            EXPECT_NEAR(road.uv_of(p.x, p.y).u, (static_cast<double>(segment) + 0.25) * 0.5, 1e-7) << v;
        }
    }
}

TEST(CrgRoad, EveryFinitePointHasAHeight) {
    const Arc arc{2, 0.5, 200};  // four turns on itself; its center is among the queries
    CrgDescription d = arc.description({-3, 3}, [](double u, double v) { return 0.01 * u * v; });
    for (const CrgBorder border : {CrgBorder::none, CrgBorder::keep, CrgBorder::repeat, CrgBorder::reflect}) {
        d.border_u = d.border_v = border;
        const CrgRoad road(d);
        std::mt19937 source(3);
        std::uniform_real_distribution<double> near(-8, 8);
        for (int i = 0; i < 20000; ++i) EXPECT_TRUE(std::isfinite(road.height(near(source), near(source))));
        EXPECT_TRUE(std::isfinite(road.height(0.0, 2.0)));
        road.height(nan, 0.0);  // it need only return
        road.height(1e300, -1e300);
        road.height(std::numeric_limits<double>::infinity(), 0.0);
    }
}

TEST(CrgRoad, AllocatesNothing) {
    const Arc arc{30, 0.1, 2000};
    const CrgRoad road(arc.description({-3, 3}, ramp));
    const test::AllocationGuard guard;
    double sum = 0;
    for (double x = -200; x < 200; x += 0.7) sum += road.height(x, 0.3 * x);
    EXPECT_EQ(guard.allocations(), 0);
    EXPECT_TRUE(std::isfinite(sum));
}

TEST(CrgRoad, RejectsInconsistentDescriptions) {
    const CrgDescription good = straight(ramp);
    const auto refused = [&](const std::function<void(CrgDescription&)>& change) {
        CrgDescription d = good;
        change(d);
        EXPECT_THROW(CrgRoad{d}, std::invalid_argument);
    };
    refused([](CrgDescription& d) { d.heights.pop_back(); });
    refused([](CrgDescription& d) { d.heights.resize(3); });
    refused([](CrgDescription& d) { d.v = {0, 0, 1}; });
    refused([](CrgDescription& d) { d.u_increment = 0; });
    refused([](CrgDescription& d) { d.headings = {0, 0}; });
    refused([](CrgDescription& d) { d.headings = {0, 3, 0, 0}; });
    refused([](CrgDescription& d) { d.slopes = {0}; });
    refused([](CrgDescription& d) { d.bankings = {0, 0, 0, nan, 0}; });
    refused([](CrgDescription& d) { d.end_x = 4; });
    refused([](CrgDescription& d) { d.heights[0] = std::numeric_limits<double>::infinity(); });
    EXPECT_NO_THROW(CrgRoad{good});
}

}  // namespace
}  // namespace hamilcar
