// The brakes in the Momenta block: what each can hold before the wheels are evaluated, and afterwards the rates of pressures and
// temperatures (docs/models/brakes.md).
#pragma once

#include "hamilcar/block/velocity.hpp"

namespace hamilcar {

template <class T>
struct BrakeMomenta {
    std::array<T, max_vehicle_wheels> limit;  // of every wheel in the vehicle's order [N m]
    // Where there is a brake system.
    std::array<T, max_trailers + 1> control_rate;  // of the units [Pa/s]
    std::array<BrakeLineMomenta<T>, max_brake_lines> lines;
    BrakeMomenta() {}
};

// Speed of a wheel against its carrier [rad/s].
template <class T, class S>
T carrier_spin(const Vehicle<T>& vehicle, const State<T>& state, const Velocity<T, S>& velocity, int number) {
    const auto [s, w] = locate_wheel(vehicle, number);
    const Suspension<T>& suspension = vehicle.suspensions[s];
    const SuspensionWheel<T>& wheel = suspension.wheels[w];
    const SuspensionVelocity<T>& at = velocity.suspensions[s];
    const T p_s = suspension.wheel_state(static_cast<int>(w), state.values.data()).spin_momentum;
    return p_s * wheel.wheel.inverse_spin_inertia - at.axis[w].dot(angular(at.motion[wheel.frame]));
}

template <class T, class S>
void brake_limits(const Vehicle<T>& vehicle, const State<T>& state, const Input<T>& input,
                  const Velocity<T, S>& velocity, BrakeMomenta<T>& out) {
    const BrakeSystem<T>& brakes = vehicle.brakes;
    for (const Suspension<T>& suspension : vehicle.suspensions) {
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            out.limit[static_cast<std::size_t>(suspension.first_wheel) + w] =
                brakes.exists() ? T(0) : suspension.wheels[w].brake.limit(input.brake);
        }
    }
    const T* values = state.values.data();
    for (std::size_t i = 0; i < brakes.lines.size(); ++i) {
        const BrakeLine<T>& line = brakes.lines[i];
        out.lines[i].spin = carrier_spin(vehicle, state, velocity, line.wheel);
        out.lines[i].limit = line.limit(brakes.pressure(i, values), brakes.temperature(i, values), out.lines[i].spin);
        out.limit[static_cast<std::size_t>(line.wheel)] = out.lines[i].limit;
    }
}

// What the parking brake holds, beside the pedal's brakes and at rest as in motion.
template <class T>
void add_parking_brakes(const Vehicle<T>& vehicle, const Input<T>& input, BrakeMomenta<T>& out) {
    for (const Suspension<T>& suspension : vehicle.suspensions) {
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            const Brake<T>& brake = suspension.wheels[w].brake;
            if (!brake.has_parking) continue;
            out.limit[static_cast<std::size_t>(suspension.first_wheel) + w] +=
                input.parking_brake * brake.parking_torque;
        }
    }
}

// `torque(number)`: of a wheel's brake on it [N m].
template <class T, class Torque>
void brake_rates(const BrakeSystem<T>& brakes, const State<T>& state, const Input<T>& input, const Torque& torque,
                 BrakeMomenta<T>& out) {
    const T* values = state.values.data();
    for (std::size_t unit = 0; unit < brakes.response_rate.size(); ++unit) {
        const int source = brakes.source[unit];
        const T target = source < 0 ? brakes.pedal_pressure.at(input.brake)
                                    : T(brakes.control(static_cast<std::size_t>(source), values));
        out.control_rate[unit] = brakes.response_rate[unit] * (target - brakes.control(unit, values));
    }
    const T share = brakes.share_of_pump(input.commands);
    for (std::size_t i = 0; i < brakes.lines.size(); ++i) {
        const BrakeLine<T>& line = brakes.lines[i];
        BrakeLineMomenta<T>& to = out.lines[i];
        to.pressure_rate = brakes.pressure_rate(line, brakes.valves(i, input.commands, share),
                                                brakes.control(static_cast<std::size_t>(line.unit), values),
                                                brakes.pressure(i, values));
        to.power = -torque(line.wheel) * to.spin;
        to.temperature_rate = line.temperature_rate(to.power, brakes.temperature(i, values), to.spin);
    }
}

template <class T>
void write_brake_rates(const BrakeSystem<T>& brakes, const BrakeMomenta<T>& momenta, State<T>& rate) {
    T* values = rate.values.data();
    for (std::size_t unit = 0; unit < brakes.response_rate.size(); ++unit) {
        brakes.control(unit, values) = momenta.control_rate[unit];
    }
    for (std::size_t i = 0; i < brakes.lines.size(); ++i) {
        brakes.pressure(i, values) = momenta.lines[i].pressure_rate;
        brakes.temperature(i, values) = momenta.lines[i].temperature_rate;
    }
}

}  // namespace hamilcar
