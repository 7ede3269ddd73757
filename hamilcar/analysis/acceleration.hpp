// How the vehicle accelerates: states are momenta, so that no block computes it.
#pragma once

#include <array>

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

// Acceleration of a point of the chassis in chassis axes, without gravity [m/s^2]: the motion a little later less the motion
// a little earlier along the state's own path, with an error of some 1e-8 of the acceleration's second rate. Two Velocity
// blocks.
Vec3<double> acceleration_at(const Model<double>& model, const State<double>& state, const Input<double>& input,
                             const Velocity<double>& velocity, const Momenta<double>& momenta,
                             const Vec3<double>& point);

// Longitudinal and lateral acceleration, the one meaning that the words have in channels, maneuvers and documents: of the motor
// vehicle's center of mass with its wheels, horizontal, along and across the heading (ISO 8855, intermediate axes) [m/s^2].
// A vehicle alone moves as all external forces say; what a trailer does through the hitch is in none of them, so that the
// motion of a tractor comes from `acceleration_at`.
std::array<double, 2> horizontal_acceleration(const Model<double>& model, const State<double>& state,
                                              const Input<double>& input, const Velocity<double>& velocity,
                                              const Momenta<double>& momenta);

// The state that a short time leads to at the present rates, and the input then [s].
State<double> state_after(const Model<double>& model, const State<double>& state, const State<double>& rate,
                          double time);
Input<double> input_after(const Input<double>& input, double time);

}  // namespace hamilcar
