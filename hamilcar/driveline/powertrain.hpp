// Power units, and the tree of differentials from them to the wheels. Speeds propagate up the tree and torques down, each in one
// pass, since every differential comes after its outputs.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/driveline/battery.hpp"
#include "hamilcar/driveline/differential.hpp"
#include "hamilcar/driveline/power_unit.hpp"

namespace hamilcar {

inline constexpr int max_driven_wheels = 2 * max_differentials;

template <class T>
struct PowertrainMomenta {
    std::array<typename PowerUnit<T>::Output, max_power_units> units;
    std::array<typename Differential<T>::Output, max_differentials> differentials;
    std::array<T, max_differentials> inputs;  // torque into each differential [N m]
    std::array<T, max_driven_wheels> wheels;  // torque on each driven wheel [N m]
    // Part of it that takes the place of the wheel's brake, positive [N m].
    std::array<T, max_driven_wheels> regenerated;
    BatteryMomenta<T> battery;  // where there is one
    T supplied;                 // by the sources [W]
    PowertrainMomenta() {}
};

// How the car moves, and what the brake pedal asks for.
template <class T>
struct PowertrainMotion {
    Vec3<T> chassis;                          // angular velocity
    std::array<T, max_driven_wheels> wheels;  // speeds relative to the part that carries the differential [rad/s]
    // Of the axle that carries a differential against the chassis, about the differential's input [rad/s].
    std::array<T, max_differentials> axle_turns;
    std::array<T, max_driven_wheels> brakes;  // torque that each wheel's brake would hold [N m]
    PowertrainMotion() {}
};

template <class T>
struct Powertrain {
    std::vector<PowerUnit<T>> units;
    std::vector<Differential<T>> differentials;
    std::vector<int> wheels;  // driven ones, by their indices in the vehicle
    Battery<T> battery;
    T supply_voltage{0};  // of motors without a battery [V]
    int regenerates = 0;  // whether the brake pedal asks motors to brake
    // In a state (vehicle/state_layout.hpp): of the first differential's number, of the energy supplied.
    int differential_place = 0, supplied_place = 0;
    static constexpr auto members() {
        using P = Powertrain;
        return std::tuple(&P::units, &P::differentials, &P::wheels, &P::battery, &P::supply_voltage, &P::regenerates,
                          &P::differential_place, &P::supplied_place);
    }

    bool exists() const { return !units.empty(); }

    template <class Number>
    Number& windup(std::size_t differential, Number* values) const {
        HAMILCAR_ASSERT(differential < differentials.size());
        return values[differential_place + static_cast<int>(differential)];
    }
    template <class Number>
    Number& supplied(Number* values) const {
        return values[supplied_place];
    }

    // The element that an output refers to: a driven wheel, or a differential.
    template <class Wheels, class Inner>
    static auto& value(int output, Wheels& wheels, Inner& differentials) {
        return output >= 0 ? wheels[static_cast<std::size_t>(output)]
                           : differentials[static_cast<std::size_t>(-1 - output)];
    }

    // Speeds of the differentials' inputs where they are driven from [rad/s].
    std::array<T, max_differentials> input_speeds(const PowertrainMotion<T>& at) const {
        std::array<T, max_differentials> speeds;
        const auto of = [&](int output) -> const T& { return value(output, at.wheels, speeds); };
        for (std::size_t d = 0; d < differentials.size(); ++d) {
            const Differential<T>& one = differentials[d];
            speeds[d] = one.input_speed(of(one.outputs[0]), of(one.outputs[1]));
            if (one.on_axle >= 0) speeds[d] += at.axle_turns[d];
        }
        return speeds;
    }

    void evaluate(const PowertrainInput<T>& told, const PowertrainMotion<T>& at, const T* values,
                  PowertrainMomenta<T>& out) const {
        const std::array<T, max_differentials> speeds = input_speeds(at);
        out.inputs.fill(T(0));
        for (std::size_t i = 0; i < wheels.size(); ++i) out.wheels[i] = out.regenerated[i] = T(0);
        supply(told, at, speeds, values, out);
        for (const PowerUnit<T>& unit : units) {
            value(unit.output, out.wheels, out.inputs) += out.units[index_of(unit)].out;
        }
        for (std::size_t d = differentials.size(); d-- > 0;) {
            const Differential<T>& one = differentials[d];
            const auto& [a, b] = one.outputs;
            out.differentials[d] = one.evaluate(out.inputs[d], value(a, at.wheels, speeds), value(b, at.wheels, speeds),
                                                windup(d, values));
            value(a, out.wheels, out.inputs) += out.differentials[d].a;
            value(b, out.wheels, out.inputs) += out.differentials[d].b;
        }
        if (regenerates) share_regeneration(out);
    }

private:
    std::size_t index_of(const PowerUnit<T>& unit) const { return static_cast<std::size_t>(&unit - units.data()); }

    // All power units, within what a battery has.
    void supply(const PowertrainInput<T>& told, const PowertrainMotion<T>& at,
                const std::array<T, max_differentials>& speeds, const T* values, PowertrainMomenta<T>& out) const {
        std::array<typename PowerUnit<T>::Demand, max_power_units> demands;
        const T voltage = battery.exists() ? battery.state(values).voltage : supply_voltage;
        std::array<T, max_differentials> brakes;
        if (regenerates) brakes = input_brakes(at);
        for (std::size_t i = 0; i < units.size(); ++i) {
            const PowerUnit<T>& unit = units[i];
            const T brake = regenerates ? value(unit.output, at.brakes, brakes) : T(0);
            demands[i] = unit.demand(told, unit.state(values), value(unit.output, at.wheels, speeds), at.chassis,
                                     voltage, brake);
        }
        BatteryShares<T> shares;
        if (battery.exists()) shares = battery_shares(demands, battery.state(values).charge);
        T power(0);
        out.supplied = T(0);
        for (std::size_t i = 0; i < units.size(); ++i) {
            const PowerUnit<T>& unit = units[i];
            const T share = battery.exists() && unit.is_electric() ? shares.of(demands[i].drives) : T(1);
            out.units[i] = unit.evaluate(demands[i], share, told, unit.state(values), at.chassis,
                                         value(unit.output, at.wheels, speeds));
            out.supplied += out.units[i].source * out.units[i].spin;
            power += out.units[i].electric_power;
        }
        if (battery.exists()) out.battery = battery.evaluate(power, battery.state(values));
    }

    // By which all motors' torques are cut so that their power is what the battery has. An efficiency that is a map changes with the torque,
    // so a share of the torque is not that share of the power: a few rounds settle it.
    BatteryShares<T> battery_shares(const std::array<typename PowerUnit<T>::Demand, max_power_units>& demands,
                                    const T& charge) const {
        constexpr int rounds_with_maps = 4;
        const bool has_maps = std::ranges::any_of(units, &PowerUnit<T>::has_efficiency_map);
        BatteryShares<T> shares;
        for (int round = 0; round < (has_maps ? rounds_with_maps : 1); ++round) {
            T drawn(0), returned(0);
            for (std::size_t i = 0; i < units.size(); ++i) {
                T power = demands[i].power, least = demands[i].least_power;
                if (round > 0) {
                    const T share = shares.of(demands[i].drives);
                    power = units[i].electric_power(demands[i].torque * share, demands[i].spin);
                    least = least * share;
                }
                drawn += max(power, least), returned += max(T(-power), T(0));
            }
            const BatteryShares<T> further = battery.shares(drawn, returned, charge);
            shares.driving = round == 0 ? further.driving : T(shares.driving * further.driving);
            shares.braking = round == 0 ? further.braking : T(shares.braking * further.braking);
        }
        return shares;
    }

    // What the brake pedal asks for at the differentials' inputs.
    std::array<T, max_differentials> input_brakes(const PowertrainMotion<T>& at) const {
        std::array<T, max_differentials> brakes;
        for (std::size_t d = 0; d < differentials.size(); ++d) {
            const auto& [a, b] = differentials[d].outputs;
            brakes[d] = differentials[d].input_torque(value(a, at.brakes, brakes), value(b, at.brakes, brakes));
        }
        return brakes;
    }

    // Down the tree as with open differentials.
    void share_regeneration(PowertrainMomenta<T>& out) const {
        std::array<T, max_differentials> inputs;
        inputs.fill(T(0));
        for (const PowerUnit<T>& unit : units) {
            value(unit.output, out.regenerated, inputs) += out.units[index_of(unit)].regenerated;
        }
        for (std::size_t d = differentials.size(); d-- > 0;) {
            const Differential<T>& one = differentials[d];
            const T passed = one.ratio * inputs[d];
            value(one.outputs[0], out.regenerated, inputs) += one.share * passed;
            value(one.outputs[1], out.regenerated, inputs) += (T(1) - one.share) * passed;
        }
    }
};

}  // namespace hamilcar
