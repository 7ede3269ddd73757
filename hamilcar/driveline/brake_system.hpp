// From the pedal to the torque that every wheel's brake can hold: pressures, valves and the heat of discs and drums
// (docs/models/brakes.md).
//
//     pedal ─► control pressure p_u of each unit ─► line: inlet, outlet, pump ─► p at the wheel ─► limit of its dry friction
//
// A wheel's pressure follows a difference by an orifice's law, k x / sqrt(|x| + x_0): x_0 bounds its rate near x = 0 to what an
// explicit step follows. Air flows in proportion to the difference.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/driveline/commands.hpp"
#include "hamilcar/math/curve.hpp"

namespace hamilcar {

// Rate of a line's pressure near equilibrium at most [1/s].
inline constexpr double fastest_pressure_rate = 250;
inline constexpr std::size_t max_brake_lines = std::size_t{2} * std::size_t{max_suspensions};
inline constexpr double ambient_temperature = 20;  // of brakes at the start, and of the air that cools them [degree C]

// Of one braked wheel.
template <class T>
struct BrakeLine {
    int wheel, unit;                    // its number in the vehicle; whose control pressure it follows
    int command;                        // index of its first command; -1: no valves
    T supplied;                         // 0 where its circuit has failed, else 1
    T fill, release;                    // fluid: k [Pa^0.5/s]; air: 1 / time constant [1/s]
    T softness;                         // x_0 [Pa]
    T pump_rate;                        // of the pressure by the whole pump's flow against none [Pa/s]
    T valve_pressure, valve_reduction;  // of a proportioning valve: from where, by which share of the growth
    T torque_per_pressure;              // [N m/Pa]
    Curve<T> friction;                  // relative, over temperature [degree C]
    T friction_loss;                    // per spin of the wheel [s/rad]
    T self_energizing;
    T inverse_capacity, cooling, cooling_per_spin;  // [K/J], [W/K], [W s/(K rad)]
    static constexpr auto members() {
        using L = BrakeLine;
        return std::tuple(&L::wheel, &L::unit, &L::command, &L::supplied, &L::fill, &L::release, &L::softness,
                          &L::pump_rate, &L::valve_pressure, &L::valve_reduction, &L::torque_per_pressure, &L::friction,
                          &L::friction_loss, &L::self_energizing, &L::inverse_capacity, &L::cooling,
                          &L::cooling_per_spin);
    }

    // Torque that the brake can hold [N m]; at a speed of the disc the pads rub a little less.
    T limit(const T& pressure, const T& temperature, const T& spin) const {
        constexpr double least_friction = 0.1;
        const T relative = friction.at(temperature) * max(T(least_friction), T(T(1) - friction_loss * abs(spin)));
        const T amplified = relative * (T(1) - self_energizing) / (T(1) - self_energizing * relative);
        return torque_per_pressure * max(pressure, T(0)) * amplified;
    }
    T temperature_rate(const T& power, const T& temperature, const T& spin) const {
        return inverse_capacity * (power - cooling_power(temperature, spin));
    }
    T cooling_power(const T& temperature, const T& spin) const {
        return (cooling + cooling_per_spin * abs(spin)) * (temperature - T(ambient_temperature));
    }
    // What reaches the line from a control pressure.
    T supply(const T& control) const {
        return supplied * (control - valve_reduction * max(T(control - valve_pressure), T(0)));
    }
};

// A wheel's valves as they stand.
template <class T>
struct ValvePositions {
    T inlet, outlet, pump;  // pump: share of its flow, which all wheels together do not exceed
};

template <class T>
struct BrakeSystem {
    std::vector<BrakeLine<T>> lines;
    std::vector<T> response_rate;  // of each unit's control pressure [1/s]
    std::vector<int> source;       // of each unit: whose control pressure it follows; -1: the pedal
    Curve<T> pedal_pressure;       // over the pedal's command [Pa]
    T inverse_pump_pressure;       // [1/Pa]
    int is_air = 0;
    int place = 0;  // in a state: control pressures, then pressure and temperature of each line
    static constexpr auto members() {
        using B = BrakeSystem;
        return std::tuple(&B::lines, &B::response_rate, &B::source, &B::pedal_pressure, &B::inverse_pump_pressure,
                          &B::is_air, &B::place);
    }

    bool exists() const { return !lines.empty(); }

    template <class Number>
    Number& control(std::size_t unit, Number* values) const {
        return values[place + static_cast<int>(unit)];
    }
    template <class Number>
    Number& pressure(std::size_t line, Number* values) const {
        return values[place + static_cast<int>(response_rate.size() + 2 * line)];
    }
    template <class Number>
    Number& temperature(std::size_t line, Number* values) const {
        return values[place + static_cast<int>(response_rate.size() + 2 * line) + 1];
    }

    // `commands`: of all actuators, or null where they are at rest. What all wheels ask of a
    // pump is cut to its flow; reservoirs of air give every wheel what it asks for.
    T share_of_pump(const T* commands) const {
        if (is_air) return T(1);
        T asked(0);
        for (const BrakeLine<T>& line : lines) {
            if (commands && line.command >= 0) asked += commands[line.command + BrakeCommand::pump];
        }
        return T(1) / max(asked, T(1));
    }
    ValvePositions<T> valves(std::size_t line, const T* commands, const T& share_of_pump) const {
        if (!commands || lines[line].command < 0) return {T(1), T(0), T(0)};
        const T* own = commands + lines[line].command;
        return {own[BrakeCommand::inlet], own[BrakeCommand::outlet], T(own[BrakeCommand::pump] * share_of_pump)};
    }

    T flow(const T& rate, const T& softness, const T& difference) const {
        return is_air ? T(rate * difference) : T(rate * over_root(difference, abs(difference) + softness));
    }
    T pressure_rate(const BrakeLine<T>& line, const ValvePositions<T>& valve, const T& control,
                    const T& pressure) const {
        const T difference = line.supply(control) - pressure;
        const T in_rate = is_air ? T(select(difference > T(0), line.fill, line.release)) : line.fill;
        T rate = valve.inlet * flow(in_rate, line.softness, difference);
        if (line.command < 0) return rate;
        rate -= valve.outlet * flow(line.release, line.softness, pressure);
        return rate + valve.pump * line.pump_rate * max(T(0), T(T(1) - pressure * inverse_pump_pressure));
    }
};

template <class T>
struct BrakeLineMomenta {
    T limit;  // [N m]
    T pressure_rate, temperature_rate;
    T spin;   // of the wheel against its carrier [rad/s]
    T power;  // turned to heat [W]
};

}  // namespace hamilcar
