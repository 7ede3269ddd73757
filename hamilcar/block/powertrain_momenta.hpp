// What drives the wheels, as the two blocks see it: rotors add their momenta to the chassis, shafts their torques to wheels.
//
//     h_chassis = J v_1 + sum (0 ; e p_e),   p_e' = torque about e       // formulation, section 7
#pragma once

#include "hamilcar/block/composed_momenta.hpp"

namespace hamilcar {

// Torques of shafts on wheels, corners and those of composed suspensions, by their numbers [N m].
template <class T>
struct ShaftTorques {
    std::array<T, max_spokes> corners;
    std::array<T, max_composed_wheels> composed;
    ShaftTorques() {}
};

// Turning of the driven wheels against what carries their differential [rad/s].
template <class T, class VelocityRef>
std::array<T, max_driven_wheels> shaft_speeds(const Vehicle<T>& vehicle, const State<T>& state,
                                              const VelocityRef& velocity,
                                              const std::array<Vec3<T>, max_spokes>& spin_axes) {
    std::array<T, max_driven_wheels> speeds;
    for (std::size_t i = 0; i < vehicle.powertrain.wheels.size(); ++i) {
        const int number = vehicle.powertrain.wheels[i];
        if (number < vehicle.spoke_count()) {
            const Spoke<T>& spoke = vehicle.spokes[static_cast<std::size_t>(number)];
            speeds[i] = state.spoke(number).spin_momentum * spoke.wheel.inverse_spin_inertia -
                        spin_axes[static_cast<std::size_t>(number)].dot(angular(velocity.hub));
            continue;
        }
        const auto [s, w] = composed_wheel(vehicle, number - vehicle.spoke_count());
        const ComposedSpoke<T>& spoke = vehicle.composed[s];
        const ComposedWheel<T>& wheel = spoke.wheels[w];
        const ComposedVelocity<T>& at = velocity.composed.spokes[s];
        const T p_s = spoke.wheel_state(static_cast<int>(w), state.values.data()).spin_momentum;
        speeds[i] = p_s * wheel.wheel.inverse_spin_inertia - at.axis[w].dot(angular(at.motion[wheel.reaction]));
    }
    return speeds;
}

// Axes of the corners' wheels, whatever number carries the spokes.
template <class T, class S, class VelocityRef>
std::array<Vec3<T>, max_spokes> corner_axes(const Vehicle<T>& vehicle, const VelocityRef& velocity) {
    std::array<Vec3<T>, max_spokes> axes;
    vehicle.template for_each_row<S>([&](const auto& row, int i) {
        visit_spoke(row.spokes, velocity, i, [&](const auto&, const auto&, const auto& at) {
            for (int l = 0; l < row.count; ++l) {
                Vec3<T>& axis = axes[static_cast<std::size_t>(row.index[static_cast<std::size_t>(l)])];
                for (int k = 0; k < 3; ++k) axis[k] = at_place<T>(at.spin_axis[k], l);
            }
        });
    });
    return axes;
}

// Adds to the work: what the torques between rotors and chassis do. That of the shafts is counted where they push.
template <class T, class VelocityRef>
void powertrain_momenta(const Vehicle<T>& vehicle, const State<T>& state, const Input<T>& input,
                        const VelocityRef& velocity, const std::array<Vec3<T>, max_spokes>& spin_axes,
                        PowertrainMomenta<T>& out, ShaftTorques<T>& shafts, T& work_rate) {
    const Powertrain<T>& powertrain = vehicle.powertrain;
    const auto speeds = shaft_speeds(vehicle, state, velocity, spin_axes);
    powertrain.evaluate(input.throttle, input.clutch, input.gear, Vec3<T>(angular(velocity.hub)), speeds,
                        state.values.data(), out);
    for (int i = 0; i < vehicle.spoke_count(); ++i) shafts.corners[static_cast<std::size_t>(i)] = T(0);
    for (const ComposedSpoke<T>& spoke : vehicle.composed) {
        for (std::size_t w = 0; w < spoke.wheels.size(); ++w) {
            shafts.composed[static_cast<std::size_t>(spoke.first_wheel) + w] = T(0);
        }
    }
    for (std::size_t i = 0; i < powertrain.wheels.size(); ++i) {
        const int number = powertrain.wheels[i], composed = number - vehicle.spoke_count();
        (composed < 0 ? shafts.corners[static_cast<std::size_t>(number)]
                      : shafts.composed[static_cast<std::size_t>(composed)]) = out.wheels[i];
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
