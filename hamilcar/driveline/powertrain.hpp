// Power units, and the tree of differentials from them to the wheels. Speeds propagate up the tree and torques down, each in one
// pass, since every differential comes after its outputs.
#pragma once

#include <array>
#include <vector>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/driveline/differential.hpp"
#include "hamilcar/driveline/power_unit.hpp"

namespace hamilcar {

inline constexpr int max_driven_wheels = 2 * max_differentials;

// References into the values of a state.
template <class Number>
struct PowerUnitState {
    Number &momentum, &windup, &throttle, &oil_torque;  // p_e [kg m^2/s], [rad], [1], [N m]
};

template <class T>
struct PowertrainMomenta {
    std::array<typename PowerUnit<T>::Output, max_power_units> units;
    std::array<typename Differential<T>::Output, max_differentials> differentials;
    std::array<T, max_driven_wheels> wheels;  // torque on each driven wheel [N m]
    T supplied;                               // by the sources [W]
    PowertrainMomenta() {}
};

// What the driver and controllers tell it.
template <class T>
struct PowertrainInput {
    T pedal, clutch, gear;  // as in Input
    const T* commands;      // of all actuators, or null where they are at rest
};

template <class T>
struct Powertrain {
    std::vector<PowerUnit<T>> units;
    std::vector<Differential<T>> differentials;
    std::vector<int> wheels;  // driven ones, by their indices in the vehicle
    // In a state (vehicle/state_layout.hpp): of the first unit's numbers, of the first differential's, of the energy supplied.
    int unit_place = 0, differential_place = 0, supplied_place = 0;
    static constexpr auto members() {
        using P = Powertrain;
        return std::tuple(&P::units, &P::differentials, &P::wheels, &P::unit_place, &P::differential_place,
                          &P::supplied_place);
    }

    bool exists() const { return !units.empty(); }

    template <class Number>
    PowerUnitState<Number> unit_state(std::size_t i, Number* values) const {
        HAMILCAR_ASSERT(i < units.size());
        constexpr int numbers = 4;  // of a unit
        Number* at = values + unit_place + numbers * static_cast<int>(i);
        return {at[0], at[1], at[2], at[3]};
    }
    template <class Number>
    Number& windup(std::size_t differential, Number* values) const {
        HAMILCAR_ASSERT(differential < differentials.size());
        return values[differential_place + static_cast<int>(differential)];
    }
    template <class Number>
    Number& supplied(Number* values) const {
        return values[supplied_place];
    }

    // Speeds of the differentials' inputs from those of the driven wheels [rad/s].
    std::array<T, max_differentials> input_speeds(const std::array<T, max_driven_wheels>& wheel_speeds) const {
        std::array<T, max_differentials> speeds;
        const auto of = [&](int output) -> const T& { return value(output, wheel_speeds, speeds); };
        for (std::size_t d = 0; d < differentials.size(); ++d) {
            speeds[d] = differentials[d].input_speed(of(differentials[d].outputs[0]), of(differentials[d].outputs[1]));
        }
        return speeds;
    }

    // The element that an output of a differential refers to: a driven wheel, or an earlier differential.
    template <class Wheels, class Inner>
    static auto& value(int output, Wheels& wheels, Inner& differentials) {
        return output >= 0 ? wheels[static_cast<std::size_t>(output)]
                           : differentials[static_cast<std::size_t>(-1 - output)];
    }

    // Torques on the driven wheels; `wheel_speeds`: relative to the part that carries the differential; `chassis`: angular
    // velocity of the chassis.
    void evaluate(const PowertrainInput<T>& told, const Vec3<T>& chassis,
                  const std::array<T, max_driven_wheels>& wheel_speeds, const T* values,
                  PowertrainMomenta<T>& out) const {
        const std::array<T, max_differentials> speeds = input_speeds(wheel_speeds);
        std::array<T, max_differentials> torques;
        torques.fill(T(0));
        for (std::size_t i = 0; i < wheels.size(); ++i) out.wheels[i] = T(0);
        out.supplied = T(0);
        for (std::size_t i = 0; i < units.size(); ++i) {
            const PowerUnit<T>& unit = units[i];
            const auto state = unit_state(i, values);
            const auto output = static_cast<std::size_t>(unit.output);
            const T spin = state.momentum * unit.inverse_inertia - unit.axis.dot(chassis);
            out.units[i] = unit.evaluate(unit.limited(told.pedal, told.commands), told.clutch, told.gear, spin,
                                         speeds[output], state.windup, state.throttle, state.oil_torque);
            torques[output] += out.units[i].out;
            out.supplied += out.units[i].source * spin;
        }
        for (std::size_t d = differentials.size(); d-- > 0;) {
            const Differential<T>& one = differentials[d];
            const auto& [a, b] = one.outputs;
            out.differentials[d] = one.evaluate(torques[d], value(a, wheel_speeds, speeds),
                                                value(b, wheel_speeds, speeds), windup(d, values));
            value(a, out.wheels, torques) += out.differentials[d].a;
            value(b, out.wheels, torques) += out.differentials[d].b;
        }
    }
};

}  // namespace hamilcar
