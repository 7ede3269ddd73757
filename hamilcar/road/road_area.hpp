// The ground that a road was measured on: a height grid, an OpenCRG road, or both. Beyond it heights are made up.
#pragma once

#include <memory>

#include "hamilcar/description/road.hpp"

namespace hamilcar {

struct CrgRoad;

class RoadArea {
public:
    // Takes the tables that a Surface of the same description has.
    explicit RoadArea(const RoadDescription& description);

    bool is_limited() const { return grid_ || crg_; }
    // How far a point of the ground lies outside [m]; a road that its file repeats or reflects has no end there.
    double outside(double x, double y) const;

private:
    std::shared_ptr<const HeightGridDescription> grid_;
    std::shared_ptr<const CrgDescription> crg_;
    std::shared_ptr<const CrgRoad> road_;
};

}  // namespace hamilcar
