#include "hamilcar/live/tiles.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/live/messages.hpp"

namespace hamilcar::live {

namespace {

constexpr std::size_t max_kept = 512;  // 8 MB

}  // namespace

double tile_distance(double x, double y, TileIndex index) {
    const double dx = x - tile_size * index.first, dy = y - tile_size * index.second;
    return std::hypot(dx - std::clamp(dx, 0.0, tile_size), dy - std::clamp(dy, 0.0, tile_size));
}

std::vector<TileIndex> tiles_near(double x, double y, double radius) {
    std::vector<TileIndex> tiles;
    for (int ix = tile_at(x - radius); ix <= tile_at(x + radius); ++ix) {
        for (int iy = tile_at(y - radius); iy <= tile_at(y + radius); ++iy) {
            if (tile_distance(x, y, {ix, iy}) <= radius) tiles.emplace_back(ix, iy);
        }
    }
    std::sort(tiles.begin(), tiles.end(),
              [&](TileIndex a, TileIndex b) { return tile_distance(x, y, a) < tile_distance(x, y, b); });
    return tiles;
}

Message Tiles::find(TileIndex index) const {
    const auto found = made_.find(index);
    return found == made_.end() ? nullptr : found->second;
}

Message Tiles::make(const LiveSimulation& simulation, TileIndex index) {
    if (made_.size() >= max_kept) made_.clear();
    const RoadTile tile = road_tile(simulation.road(), simulation.surface(), index.first, index.second);
    return made_[index] = std::make_shared<const std::string>(tile_message(simulation.number(), tile));
}

}  // namespace hamilcar::live
