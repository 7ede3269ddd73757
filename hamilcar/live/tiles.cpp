#include "hamilcar/live/tiles.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/live/messages.hpp"

namespace hamilcar::live {

namespace {

constexpr std::size_t most_kept = 512;  // 8 MB

}  // namespace

double tile_distance(double x, double y, TilePlace place) {
    const double dx = x - tile_size * place.first, dy = y - tile_size * place.second;
    return std::hypot(dx - std::clamp(dx, 0.0, tile_size), dy - std::clamp(dy, 0.0, tile_size));
}

std::vector<TilePlace> tiles_near(double x, double y, double reach) {
    std::vector<TilePlace> places;
    for (int ix = tile_at(x - reach); ix <= tile_at(x + reach); ++ix) {
        for (int iy = tile_at(y - reach); iy <= tile_at(y + reach); ++iy) {
            if (tile_distance(x, y, {ix, iy}) <= reach) places.emplace_back(ix, iy);
        }
    }
    std::sort(places.begin(), places.end(),
              [&](TilePlace a, TilePlace b) { return tile_distance(x, y, a) < tile_distance(x, y, b); });
    return places;
}

Message Tiles::find(TilePlace place) const {
    const auto found = made_.find(place);
    return found == made_.end() ? nullptr : found->second;
}

Message Tiles::make(const Ride& ride, TilePlace place) {
    if (made_.size() >= most_kept) made_.clear();
    const RoadTile tile = road_tile(ride.road(), ride.surface(), place.first, place.second);
    return made_[place] = std::make_shared<const std::string>(tile_message(ride.number(), tile));
}

}  // namespace hamilcar::live
