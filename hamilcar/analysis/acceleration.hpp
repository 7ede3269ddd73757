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

// The same of a vehicle without trailers, which moves as all external forces say.
template <class T, class SomeVelocity>
std::array<T, 2> horizontal_acceleration_alone(const Model<T>& model, const SomeVelocity& velocity,
                                               const Momenta<T>& momenta) {
    const Mat3<T>& R = velocity.R_GC;
    const Vec3<T> a = R * Vec3<T>(momenta.external.template head<3>()) / model.vehicle.total_mass;
    const T length = sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
    const T c = R(0, 0) / length, s = R(1, 0) / length;  // of the heading
    return {c * a[0] + s * a[1], c * a[1] - s * a[0]};
}

// The state that a short time leads to at the present rates, and the input then [s].
State<double> state_after(const Model<double>& model, const State<double>& state, const State<double>& rate,
                          double time);
Input<double> input_after(const Input<double>& input, double time);

}  // namespace hamilcar
