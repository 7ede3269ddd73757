// How the chassis accelerates, for accelerometers: states are momenta, so that no block computes it.
#pragma once

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// Acceleration of a point of the chassis in chassis axes, without gravity [m/s^2]: the motion a little later less the motion
// a little earlier along the state's own path, with an error of some 1e-8 of the acceleration's second rate. Two Velocity
// blocks.
Vec3<double> acceleration_at(const Model<double>& model, const State<double>& state, const Input<double>& input,
                             const Velocity<double>& velocity, const Momenta<double>& momenta,
                             const Vec3<double>& point);

// The state that a short time leads to at the present rates, and the input then [s].
State<double> state_after(const Model<double>& model, const State<double>& state, const State<double>& rate,
                          double time);
Input<double> input_after(const Input<double>& input, double time);

}  // namespace hamilcar
