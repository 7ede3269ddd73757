// Tiles of the road for display: the plane exactly, the surface at its nodes, and narrow obstacles between nodes.
#include "hamilcar/road/tile.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hamilcar/description/road.hpp"
#include "hamilcar/road/plane.hpp"
#include "hamilcar/road/surface.hpp"

namespace hamilcar {
namespace {

TEST(RoadTile, LiesOnThePlane) {
    const RoadTile tile = road_tile(PlaneRoad<double>(0.1, -0.05, 1), nullptr, -2, 3);
    ASSERT_EQ(tile.heights.size(), 65u * 65u);
    for (const int row : {0, 31, 64}) {
        for (const int column : {0, 17, 64}) {
            const double x = -32 + 0.25 * column, y = 48 + 0.25 * row;
            EXPECT_NEAR(tile.heights[static_cast<std::size_t>(65 * row + column)], 0.1 * x - 0.05 * y, 1e-5);
        }
    }
}

TEST(RoadTile, MeetsItsNeighborsAtTheEdges) {
    RoadDescription road;
    road.random.push_back({.road_class = 'D', .seed = 7});
    const auto surface = make_surface(road);
    const PlaneRoad<double> plane(0, 0, 1);
    const RoadTile here = road_tile(plane, surface.get(), 1, 0), next = road_tile(plane, surface.get(), 2, 0);
    for (std::size_t row = 0; row < 65; ++row) EXPECT_EQ(here.heights[65 * row + 64], next.heights[65 * row]);
}

TEST(RoadTile, ShowsACleatBetweenTwoNodes) {
    RoadDescription road;
    road.obstacles.push_back({.start = 4.31, .length = 0.06, .height = 0.02, .ramp = 0.005, .right = -1, .left = 1});
    const auto surface = make_surface(road);
    const RoadTile tile = road_tile(PlaneRoad<double>(0, 0, 1), surface.get(), 0, 0);
    EXPECT_NEAR(*std::ranges::max_element(tile.heights), 0.02, 1e-6);
    EXPECT_EQ(tile.heights[65 * 40 + 17], 0);  // y = 10 m: beside it
}

TEST(RoadTile, IsFoundByFloor) {
    EXPECT_EQ(tile_at(0), 0);
    EXPECT_EQ(tile_at(15.999), 0);
    EXPECT_EQ(tile_at(16), 1);
    EXPECT_EQ(tile_at(-0.001), -1);
    EXPECT_EQ(tile_at(-16.001), -2);
}

}  // namespace
}  // namespace hamilcar
