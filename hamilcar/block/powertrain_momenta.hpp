// The powertrain in the Velocity and Momenta blocks: rotors add their momenta to the chassis, shafts apply torques to wheels.
//
//     h_chassis = J v_1 + sum (0 ; e p_e),   p_e' = torque about e       // formulation, section 7
#pragma once

#include "hamilcar/block/suspension_momenta.hpp"

namespace hamilcar {

// Angular velocities of the driven wheels relative to the bodies that carry their differentials [rad/s].
template <class T, class S>
std::array<T, max_driven_wheels> shaft_speeds(const Vehicle<T>& vehicle, const State<T>& state,
                                              const Velocity<T, S>& velocity) {
    std::array<T, max_driven_wheels> speeds;
    for (std::size_t i = 0; i < vehicle.powertrain.wheels.size(); ++i) {
        const auto [s, w] = locate_wheel(vehicle, vehicle.powertrain.wheels[i]);
        const Suspension<T>& suspension = vehicle.suspensions[s];
        const SuspensionWheel<T>& wheel = suspension.wheels[w];
        const SuspensionVelocity<T>& at = velocity.suspensions[s];
        const T p_s = suspension.wheel_state(static_cast<int>(w), state.values.data()).spin_momentum;
        speeds[i] = p_s * wheel.wheel.inverse_spin_inertia - at.axis[w].dot(angular(at.motion[wheel.reaction]));
    }
    return speeds;
}

// Torques on all wheels [N m]. Adds the power of the torques between rotors and chassis to the work rate; that of the shafts
// is counted where they act on the wheels.
template <class T, class S>
void powertrain_momenta(const Vehicle<T>& vehicle, const State<T>& state, const Input<T>& input,
                        const Velocity<T, S>& velocity, PowertrainMomenta<T>& out,
                        std::array<T, max_vehicle_wheels>& shafts, T& work_rate) {
    const Powertrain<T>& powertrain = vehicle.powertrain;
    for (const Suspension<T>& suspension : vehicle.suspensions) {
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            shafts[static_cast<std::size_t>(suspension.first_wheel) + w] = T(0);
        }
    }
    if (!powertrain.exists()) return;
    const auto speeds = shaft_speeds(vehicle, state, velocity);
    const PowertrainInput<T> told{input.throttle, input.clutch, input.gear, input.commands};
    powertrain.evaluate(told, Vec3<T>(angular(velocity.chassis)), speeds, state.values.data(), out);
    for (std::size_t i = 0; i < powertrain.wheels.size(); ++i) {
        shafts[static_cast<std::size_t>(powertrain.wheels[i])] = out.wheels[i];
    }
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) work_rate += out.units[i].rotor * out.units[i].spin;
}

template <class T>
void write_powertrain_rates(const Powertrain<T>& powertrain, const PowertrainMomenta<T>& momenta, State<T>& rate) {
    T* values = rate.values.data();
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        const auto to = powertrain.unit_state(i, values);
        to.momentum = momenta.units[i].rotor;
        to.windup = momenta.units[i].windup_rate;
        to.throttle = momenta.units[i].throttle_rate;
        to.oil_torque = momenta.units[i].oil_torque_rate;
    }
    for (std::size_t d = 0; d < powertrain.differentials.size(); ++d) {
        powertrain.windup(d, values) = momenta.differentials[d].windup_rate;
    }
    powertrain.supplied(values) = momenta.supplied;
}

}  // namespace hamilcar
