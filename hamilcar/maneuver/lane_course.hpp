// Courses of lanes between rows of cones along x, as in ISO 3888: the cones, the line that is easiest to drive, and how a car
// got through.
#pragma once

#include <array>
#include <vector>

#include "hamilcar/analysis/easiest_line.hpp"
#include "hamilcar/maneuver/test_run.hpp"

namespace hamilcar {

// Cones, boundaries and the driver's line, which runs straight ahead before the first lane and behind the last one.
Course lane_course(const std::vector<Lane>& lanes, const Footprint& box);

// How a drive went.
struct Passage {
    double clearance;   // least distance of the vehicle from a boundary beside it; negative: across it [m]
    double place;       // x of the center of mass there [m]
    std::size_t cones;  // that were run over
    bool complete;      // whether the box and every trailer came out of the last lane
    bool too_slow() const { return !complete && clearance >= 0 && cones == 0; }  // it stopped on the way
    bool better_than(const Passage& other) const {
        return complete != other.complete ? complete : clearance > other.clearance;
    }
    bool clean() const { return complete && clearance >= 0 && cones == 0; }
};
// The box stands for the motor vehicle, the tires on the ground for trailers.
Passage passage(const VehicleDescription& vehicle, const std::vector<Lane>& lanes, const Recording& recording);

}  // namespace hamilcar
