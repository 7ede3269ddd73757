// Where the independent coordinates of suspensions and hitches, and their momenta, stand in a state.
#pragma once

#include <vector>

#include "hamilcar/block/model.hpp"

namespace hamilcar {

struct StateFreedom {
    int coordinate, momentum;  // indices into State::values
    bool hitch_yaw;            // of a trailer: no force depends on it at rest
    int suspension;            // -1: of a hitch
};

// Suspensions first, then hitches.
std::vector<StateFreedom> state_freedoms(const Vehicle<double>& vehicle);

}  // namespace hamilcar
