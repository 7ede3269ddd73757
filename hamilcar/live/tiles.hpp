// Tiles of an uneven road for the pages: which ones are near the car, and a cache that computes each only once for all pages.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/live/live_simulation.hpp"

namespace hamilcar::live {

using Message = std::shared_ptr<const std::string>;  // text or bytes, the same for many pages
using TileIndex = std::pair<int, int>;               // ix, iy

// Tiles within `radius` of a point, the nearest first.
std::vector<TileIndex> tiles_near(double x, double y, double radius);

// From a point to the nearest point of a tile [m].
double tile_distance(double x, double y, TileIndex index);

class Tiles {
public:
    // A cached tile, or null.
    Message find(TileIndex index) const;
    Message make(const LiveSimulation& simulation, TileIndex index);
    void clear() { made_.clear(); }

private:
    std::map<TileIndex, Message> made_;
};

}  // namespace hamilcar::live
