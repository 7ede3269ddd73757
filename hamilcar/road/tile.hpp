// An uneven road for display only: square tiles of heights. The equations of motion use the surface itself.
#pragma once

#include <vector>

namespace hamilcar {

template <class T>
struct PlaneRoad;
class Surface;

inline constexpr double tile_size = 16;                               // of a side [m]
inline constexpr int tile_nodes = 65;                                 // along a side
inline constexpr double tile_spacing = tile_size / (tile_nodes - 1);  // [m]

// From x = ix tile_size to (ix + 1) tile_size, likewise in y; heights above ground z = 0, in rows of constant y. Each node takes
// the height around it that differs most from its own, so that a cleat between two nodes is visible.
struct RoadTile {
    int ix = 0, iy = 0;
    std::vector<float> heights;  // [m]
};

RoadTile road_tile(const PlaneRoad<double>& plane, const Surface* surface, int ix, int iy);

// Which tile a coordinate lies in.
int tile_at(double coordinate);

}  // namespace hamilcar
