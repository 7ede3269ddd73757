// The powertrain in the Velocity and Momenta blocks: rotors add their momenta to the chassis, shafts apply torques to wheels.
//
//     h_chassis = J v_1 + sum (0 ; e p_e),   p_e' = torque about e       // formulation, section 7
// The shaft to a differential on a live axle turns the axle about the shaft, and the chassis the other way.
#pragma once

#include "hamilcar/block/suspension_momenta.hpp"

namespace hamilcar {

// Angular velocities of the driven wheels relative to the bodies that carry their differentials, and of these bodies.
template <class T, class S>
PowertrainMotion<T> powertrain_motion(const Vehicle<T>& vehicle, const State<T>& state,
                                      const Velocity<T, S>& velocity) {
    const Powertrain<T>& powertrain = vehicle.powertrain;
    PowertrainMotion<T> out;
    out.chassis = angular(velocity.chassis);
    for (std::size_t i = 0; i < powertrain.wheels.size(); ++i) {
        const auto [s, w] = locate_wheel(vehicle, powertrain.wheels[i]);
        const Suspension<T>& suspension = vehicle.suspensions[s];
        const SuspensionWheel<T>& wheel = suspension.wheels[w];
        const SuspensionVelocity<T>& at = velocity.suspensions[s];
        const T p_s = suspension.wheel_state(static_cast<int>(w), state.values.data()).spin_momentum;
        out.wheels[i] = p_s * wheel.wheel.inverse_spin_inertia - at.axis[w].dot(angular(at.motion[wheel.reaction]));
        out.brakes[i] = T(0);
    }
    for (std::size_t d = 0; d < powertrain.differentials.size(); ++d) {
        const Differential<T>& one = powertrain.differentials[d];
        if (one.on_axle < 0) continue;
        const auto s = static_cast<std::size_t>(one.on_axle);
        const Vec3<T> axle = angular(velocity.suspensions[s].motion[vehicle.suspensions[s].shaft_frame]);
        out.axle_turns[d] = one.shaft_axis.dot(Vec3<T>(axle - out.chassis));
    }
    return out;
}

// Adds the power of the torques between rotors and chassis to the work rate; that of the shafts is counted where they act. What motors
// brake in place of a wheel's brake is taken from the limit of that brake.
template <class T, class S>
void powertrain_momenta(const Vehicle<T>& vehicle, const State<T>& state, const Input<T>& input,
                        const Velocity<T, S>& velocity, Momenta<T>& out, ShaftTorques<T>& shafts) {
    const Powertrain<T>& powertrain = vehicle.powertrain;
    for (const Suspension<T>& suspension : vehicle.suspensions) {
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            shafts.wheels[static_cast<std::size_t>(suspension.first_wheel) + w] = T(0);
        }
    }
    if (!powertrain.exists()) return;
    PowertrainMotion<T> motion = powertrain_motion(vehicle, state, velocity);
    const auto of_wheel = [&](std::size_t i) { return static_cast<std::size_t>(powertrain.wheels[i]); };
    for (std::size_t i = 0; i < powertrain.wheels.size(); ++i) motion.brakes[i] = out.brakes.limit[of_wheel(i)];
    const PowertrainInput<T> told{input.throttle, input.clutch, input.gear, input.commands};
    PowertrainMomenta<T>& to = out.powertrain;
    powertrain.evaluate(told, motion, state.values.data(), to);
    for (std::size_t i = 0; i < powertrain.wheels.size(); ++i) {
        shafts.wheels[of_wheel(i)] += to.wheels[i];  // several units may drive one wheel
        if (!powertrain.regenerates) continue;
        T& limit = out.brakes.limit[of_wheel(i)];
        limit = max(T(limit - to.regenerated[i]), T(0));
    }
    for (std::size_t d = 0; d < powertrain.differentials.size(); ++d) {
        const int axle = powertrain.differentials[d].on_axle;
        if (axle >= 0) shafts.axles[static_cast<std::size_t>(axle)] = to.inputs[d];
    }
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        out.work_rate += to.units[i].rotor * to.units[i].spin;
        if (powertrain.units[i].shafts.exist()) out.work_rate += to.units[i].gearbox * to.units[i].shaft_speed;
    }
}

template <class T>
void write_powertrain_rates(const Powertrain<T>& powertrain, const PowertrainMomenta<T>& momenta, State<T>& rate) {
    T* values = rate.values.data();
    for (std::size_t i = 0; i < powertrain.units.size(); ++i) {
        const PowerUnit<T>& unit = powertrain.units[i];
        const auto to = unit.state(values);
        to.momentum = momenta.units[i].rotor;
        to.windup = momenta.units[i].windup_rate;
        to.throttle = momenta.units[i].throttle_rate;
        to.oil_torque = momenta.units[i].oil_torque_rate;
        if (!unit.shafts.exist()) continue;
        to.shafts[0] = momenta.units[i].gearbox, to.shafts[1] = momenta.units[i].shafts_windup_rate;
    }
    for (std::size_t d = 0; d < powertrain.differentials.size(); ++d) {
        powertrain.windup(d, values) = momenta.differentials[d].windup_rate;
    }
    if (powertrain.battery.exists()) {
        const auto to = powertrain.battery.state(values);
        to.charge = momenta.battery.charge_rate, to.voltage = momenta.battery.voltage_rate;
    }
    powertrain.supplied(values) = momenta.supplied;
}

}  // namespace hamilcar
