// Where the independent coordinates of suspensions and hitches, and their momenta, stand in a state.
#pragma once

#include <vector>

#include "hamilcar/block/model.hpp"

namespace hamilcar {

struct StateFreedom {
    int coordinate, momentum;  // places in State::values
    bool hitch_yaw;            // of a trailer: indifferent while the combination stands
};

// Suspensions, hitches.
std::vector<StateFreedom> state_freedoms(const Vehicle<double>& vehicle);

}  // namespace hamilcar
