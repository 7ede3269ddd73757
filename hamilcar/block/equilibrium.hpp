// Static equilibrium on the road, part of the Initial Process: Newton's method on the full model at rest, with heave, roll,
// pitch and every V as unknowns.
#pragma once

#include <vector>

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

struct EquilibriumResult {
    bool found = false;
    double residual = 0;  // largest unbalanced force or moment [N, N m]
};

// Settles a state at rest: heave, roll, pitch and V such that all forces balance; on a slope tire deflections and
// brakes hold the car if the brakes can. Heading and ground position are kept, and the coordinates of suspensions that are `held`.
EquilibriumResult settle(const Model<double>& model, Input<double> input, State<double>& state,
                         const std::vector<bool>& held = {});

}  // namespace hamilcar
