// Heights beyond the grid of an OpenCRG road, at its ends and in its gaps, computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "road/crg_shapes.hpp"

namespace hamilcar {
namespace {

using test::ramp, test::straight;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// At u = 5.5, 1.5 m beyond the end, and at v = 2.5, 0.5 m beyond the left edge.
TEST(CrgBorder, Borders) {
    struct Case {
        CrgBorder border;
        double beyond_end, before_start, beyond_left, beyond_right;  // at u = 5.5, -0.5, v = 2.5, -1.5
    };
    const double offset = 0.25;
    for (const Case& c :
         {Case{CrgBorder::none, 0, 0, 0, 0}, Case{CrgBorder::zero, offset, offset, offset, offset},
          Case{CrgBorder::keep, ramp(4, 0) + offset, ramp(0, 0) + offset, ramp(2, 2) + offset, ramp(2, -1) + offset},
          Case{CrgBorder::repeat, ramp(1.5, 0), ramp(3.5, 0), ramp(2, -0.5), ramp(2, 1.5)},
          Case{CrgBorder::reflect, ramp(2.5, 0), ramp(0.5, 0), ramp(2, 1.5), ramp(2, -0.5)}}) {
        CrgDescription d = straight(ramp);
        d.border_u = d.border_v = c.border;
        d.border_offset_u = d.border_offset_v = offset;
        const CrgRoad road(d);
        SCOPED_TRACE(static_cast<int>(c.border));
        EXPECT_NEAR(road.height(5.5, 0.0), c.beyond_end, 1e-12);
        EXPECT_NEAR(road.height(-0.5, 0.0), c.before_start, 1e-12);
        EXPECT_NEAR(road.height(2.0, 2.5), c.beyond_left, 1e-12);
        EXPECT_NEAR(road.height(2.0, -1.5), c.beyond_right, 1e-12);
        EXPECT_NEAR(road.height(4.0, 2.0), ramp(4, 2), 1e-12) << "the corner belongs to the grid";
        EXPECT_FALSE(road.covers(5.5, 0) || road.covers(-0.5, 0) || road.covers(2, 2.5) || road.covers(2, -1.5));
        EXPECT_TRUE(road.covers(4, 2) && road.covers(0, -1) && road.covers(2.2, 0.3));
        for (const double far : {1e3, -1e5, 1e9}) EXPECT_TRUE(std::isfinite(road.height(far, -0.7 * far)));
    }
}

TEST(CrgBorder, BordersRepeatMoreThanOnce) {
    CrgDescription d = straight(ramp);
    d.border_u = CrgBorder::reflect, d.border_v = CrgBorder::repeat;
    const CrgRoad road(d);
    EXPECT_NEAR(road.height(9.0, 0.0), ramp(1, 0), 1e-12) << "8 m is a full period";
    EXPECT_NEAR(road.height(-5.0, 0.0), ramp(3, 0), 1e-12);
    EXPECT_NEAR(road.height(1.0, 7.5), ramp(1, 1.5), 1e-12);
    EXPECT_NEAR(road.height(1.0, -7.5), ramp(1, 1.5), 1e-12);
}

// Both borders at once, as OpenCRG's library has it: both offsets count.
TEST(CrgBorder, BordersTogether) {
    CrgDescription d = straight(ramp);
    d.border_u = CrgBorder::keep, d.border_v = CrgBorder::zero;
    d.border_offset_u = 0.25, d.border_offset_v = 0.5;
    EXPECT_NEAR(CrgRoad(d).height(5.0, 3.0), 0.75, 1e-12);
    d.z = 2;
    EXPECT_NEAR(CrgRoad(d).height(5.0, 3.0), 2.75, 1e-12) << "beyond the end the line's elevation stays";
    EXPECT_NEAR(CrgRoad(d).height(2.0, 3.0), 0.5, 1e-12) << "beside the road it does not";
    d.border_u = CrgBorder::zero, d.border_v = CrgBorder::keep;
    EXPECT_NEAR(CrgRoad(d).height(5.0, 3.0), 0.75, 1e-12);
    d.border_u = CrgBorder::repeat;
    EXPECT_NEAR(CrgRoad(d).height(5.0, 3.0), 2 + ramp(1, 2) + 0.75, 1e-12);
    d.z = 0, d.border_u = d.border_v = CrgBorder::keep;
    EXPECT_NEAR(CrgRoad(d).height(5.0, 3.0), ramp(4, 2) + 0.75, 1e-12);
}

// Where both reach, the one at the end counts.
TEST(CrgBorder, SmoothZonesMayOverlap) {
    CrgDescription d = straight([](double, double) { return 0.4; });
    d.smooth_start = 4, d.smooth_end = 3;
    const CrgRoad road(d);
    EXPECT_NEAR(road.height(0.5, 0.0), 0.05, 1e-12);
    EXPECT_NEAR(road.height(2.5, 0.0), 0.2, 1e-12);
}

TEST(CrgBorder, SmoothsInAndOut) {
    CrgDescription d = straight([](double, double) { return 0.4; });
    d.z = 1;
    d.smooth_start = 2, d.smooth_end = 1;
    const CrgRoad road(d);
    EXPECT_NEAR(road.height(0.0, 0.0), 1, 1e-12);
    EXPECT_NEAR(road.height(0.5, 0.0), 1.1, 1e-12);
    EXPECT_NEAR(road.height(2.5, 0.0), 1.4, 1e-12);
    EXPECT_NEAR(road.height(3.5, 0.0), 1.2, 1e-12);
    EXPECT_NEAR(road.height(6.0, 0.0), 1, 1e-12);
}

TEST(CrgBorder, MissingHeights) {
    CrgDescription d = straight([](double, double) { return 0.2; });
    d.z = 1;
    d.heights[3 * 2 + 2] = nan;                         // u = 2, v = 2
    d.heights[3 * 4 + 0] = d.heights[3 * 4 + 1] = nan;  // u = 4, v = -1 and 0
    d.heights[3 * 4 + 2] = 0.5;
    d.missing_offset = 0.1;
    const auto height = [&](CrgMissing missing, double u, double v) {
        CrgDescription other = d;
        other.missing = missing;
        return CrgRoad(other).height(u, v);
    };
    EXPECT_NEAR(height(CrgMissing::none, 2, 2), 1, 1e-12);
    EXPECT_NEAR(height(CrgMissing::zero, 2, 2), 1.1, 1e-12);
    EXPECT_NEAR(height(CrgMissing::keep, 2, 2), 1.3, 1e-12);
    EXPECT_NEAR(height(CrgMissing::keep, 4, -1), 1.6, 1e-12) << "the next one to the left";
    EXPECT_NEAR(height(CrgMissing::keep, 4, 2), 1.5, 1e-12);
    const CrgRoad road(d);
    EXPECT_FALSE(road.covers(2, 1.9) || road.covers(1.5, 0.5) || road.covers(3.5, 1.5));
    EXPECT_TRUE(road.covers(2, 0) && road.covers(1, 2) && road.covers(2.5, -0.5));
}

}  // namespace
}  // namespace hamilcar
