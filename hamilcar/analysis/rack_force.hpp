// What the driver's hands have to bear: the force that holds the rack on its prescribed course, without assistance.
//
// The rack's displacement is a coordinate that somebody else decides on, so that no block computes its force. It is what
// (71) lacks (unbalanced.hpp) along the linkages' prescribed motion at unit rack rate, at fixed independent coordinates, over all that
// the rack moves.
#pragma once

#include "hamilcar/block/momenta.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

// Force on the rack along its positive displacement [N]; the rack itself has no mass and no friction. `momenta` with a full
// account. h' is a difference along the state's own path, with an error of some 1e-7 N. Two Velocity blocks.
double rack_force(const Model<double>& model, const State<double>& state, const Input<double>& input,
                  const Velocity<double>& velocity, const Momenta<double>& momenta);

// Torque of the hands about the steering wheel's axis, positive to the left [N m], where the rack stands at `displacement`
// [m] and takes `force` [N]. The vehicle has a column.
double steering_torque(const Column& column, double displacement, double force);

}  // namespace hamilcar
