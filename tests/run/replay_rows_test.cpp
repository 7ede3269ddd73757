// What a page is given of a run: all rows of a short one, every second, fourth, ... of a long one, and the road that it drove on.
#include "hamilcar/run/replay_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "hamilcar/run/channels.hpp"

namespace hamilcar {
namespace {

Channel channel(const char* name) {
    return {{name, "m", "of a test"}, [](const Sample&) { return 0.0; }};
}

io::PageRun replay_of(int rows, std::size_t most) {
    ReplayRows replay("test", "", {channel("a"), channel("b")}, most);
    for (int i = 0; i < rows; ++i) replay.add(0.001 * i, std::vector<double>{double(i), -double(i)});
    return replay.take();
}

TEST(ReplayRows, KeepsEveryRowOfAShortRun) {
    const io::PageRun run = replay_of(100, 100);
    ASSERT_EQ(run.values.size(), 3u);
    ASSERT_EQ(run.values[0].size(), 100u);
    EXPECT_EQ(run.values[0][99], 0.099);
    EXPECT_EQ(run.values[2][57], -57);
}

TEST(ReplayRows, ThinsALongRunEvenlyAndKeepsItsEnds) {
    for (const int rows : {101, 102, 200, 201, 1000, 1023, 1025, 4999}) {
        const io::PageRun run = replay_of(rows, 100);
        const std::vector<double>& kept = run.values[1];
        EXPECT_LE(kept.size(), 101u) << rows;
        EXPECT_GE(kept.size(), 50u) << rows;
        EXPECT_EQ(kept.front(), 0) << rows;
        EXPECT_EQ(kept.back(), rows - 1) << rows;
        const double stride = kept[1] - kept[0];
        EXPECT_EQ(std::exp2(std::round(std::log2(stride))), stride) << rows;
        for (std::size_t i = 1; i + 1 < kept.size(); ++i) EXPECT_EQ(kept[i], stride * double(i)) << rows;
        EXPECT_EQ(run.values[0].size(), kept.size());
    }
}

TEST(ReplayRows, ThinsWhatWasReadBackTheSameWay) {
    io::PageRun run = replay_of(1025, 10000);
    thin(run, 100);
    EXPECT_EQ(run.values[1], replay_of(1025, 100).values[1]);
}

TEST(ReplayRows, HasTheRoadThatThePathLeadsOverAndWhatLiesBeside) {
    RoadDescription road;
    road.obstacles.push_back({.start = 20, .length = 1, .height = 0.1});
    const auto surface = make_surface(road);
    const PlaneRoad<double> plane(0, 0, 1);
    const std::vector<double> x{0, 5, 10, 15, 20, 25, 30, 35, 40}, y(9, 8.0);
    std::set<std::pair<int, int>> tiles;
    for (const RoadTile& tile : tiles_along(plane, surface.get(), x, y)) {
        EXPECT_TRUE(tiles.emplace(tile.ix, tile.iy).second) << "twice";
    }
    for (const double at : x) {
        for (const double beside : {-1.9, 8.0, 17.9}) EXPECT_TRUE(tiles.contains({tile_at(at), tile_at(beside)}));
    }
    EXPECT_FALSE(tiles.contains({tile_at(20), tile_at(40)}));
    EXPECT_TRUE(tiles_along(plane, nullptr, x, y).empty());
}

}  // namespace
}  // namespace hamilcar
