#include "hamilcar/road/tile.hpp"

#include <array>
#include <cmath>

#include "hamilcar/road/plane.hpp"
#include "hamilcar/road/surface.hpp"

namespace hamilcar {

namespace {

// Offsets from a node along x and y, at fifths of the spacing, so that a cleat of 5 cm is hit.
constexpr std::array<double, 4> offsets{-0.4 * tile_spacing, -0.2 * tile_spacing, 0.2 * tile_spacing,
                                        0.4 * tile_spacing};

double height_around(const Surface& surface, double x, double y) {
    const double own = surface.height(x, y);
    double extreme = own;
    const auto sample = [&](double there_x, double there_y) {
        const double height = surface.height(there_x, there_y);
        if (std::abs(height - own) > std::abs(extreme - own)) extreme = height;
    };
    for (const double offset : offsets) sample(x + offset, y), sample(x, y + offset);
    return extreme;
}

}  // namespace

int tile_at(double coordinate) {
    return static_cast<int>(std::floor(coordinate / tile_size));
}

RoadTile road_tile(const PlaneRoad<double>& plane, const Surface* surface, int ix, int iy) {
    RoadTile tile{ix, iy, {}};
    tile.heights.reserve(std::size_t{tile_nodes} * std::size_t{tile_nodes});
    const Vec3<double>& n = plane.normal;
    for (int row = 0; row < tile_nodes; ++row) {
        for (int column = 0; column < tile_nodes; ++column) {
            const double x = ix * tile_size + column * tile_spacing, y = iy * tile_size + row * tile_spacing;
            const double above = surface ? height_around(*surface, x, y) : 0;
            tile.heights.push_back(static_cast<float>(above - (n[0] * x + n[1] * y) / n[2]));
        }
    }
    return tile;
}

}  // namespace hamilcar
