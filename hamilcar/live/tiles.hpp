// Patches of an uneven road on their way to pages: which are near the car, and each computed only once for all.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/live/ride.hpp"

namespace hamilcar::live {

using Message = std::shared_ptr<const std::string>;  // text or bytes, the same for many pages
using TilePlace = std::pair<int, int>;               // ix, iy

// Tiles that are not farther than `reach` from a point, the nearest first.
std::vector<TilePlace> tiles_near(double x, double y, double reach);

// From a point to the nearest of a tile [m].
double tile_distance(double x, double y, TilePlace place);

class Tiles {
public:
    // One that was made before, or null.
    Message find(TilePlace place) const;
    Message make(const Ride& ride, TilePlace place);
    void clear() { made_.clear(); }

private:
    std::map<TilePlace, Message> made_;
};

}  // namespace hamilcar::live
