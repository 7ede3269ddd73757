// The battery that motors take their power from (docs/models/driveline.md, "Battery").
//
//     current = power / voltage,   charge' = -current / capacity
//     voltage' = 200/s (open-circuit voltage - resistance current - voltage)
// The voltage at the terminals follows with a lag, as behind the capacitors of inverters: then power, current and voltage need no
// equation to be solved.
#pragma once

#include <tuple>

#include "hamilcar/math/curve.hpp"

namespace hamilcar {

// References into the values of a state.
template <class Number>
struct BatteryState {
    Number &charge, &voltage;  // [1], [V]
};

template <class T>
struct BatteryMomenta {
    T power;    // at the terminals, positive where it discharges [W]
    T current;  // [A]
    T heat;     // in its resistance [W]
    T charge_rate, voltage_rate;
};

// By which motors' torques are cut so that the battery's limits hold [1].
template <class T>
struct BatteryShares {
    T driving{1}, braking{1};
    // `drives`: of a motor, 1 where it drives or stands, 0 where it brakes.
    T of(const T& drives) const { return braking + (driving - braking) * drives; }
};

template <class T>
struct Battery {
    static constexpr double voltage_rate = 200;  // [1/s]
    static constexpr double end_band = 0.05;     // of charge, over which power fades out before empty and full [1]
    int present = 0;
    int place = 0;  // in a state: charge, voltage
    T inverse_capacity{0}, resistance{0};
    Curve<T> open_voltage;                                  // over charge
    T max_discharge{0}, max_charge{0}, auxiliary_power{0};  // [W]
    T initial_charge{0};                                    // [1]
    static constexpr auto members() {
        using B = Battery;
        return std::tuple(&B::present, &B::place, &B::inverse_capacity, &B::resistance, &B::open_voltage,
                          &B::max_discharge, &B::max_charge, &B::auxiliary_power, &B::initial_charge);
    }

    bool exists() const { return present != 0; }

    template <class Number>
    BatteryState<Number> state(Number* values) const {
        return {values[place], values[place + 1]};
    }

    // `drawn`, `returned`: by all motors, both positive [W]. What some of them return others may draw.
    BatteryShares<T> shares(const T& drawn, const T& returned, const T& charge) const {
        constexpr double least = 1;  // divisor of the shares [W]
        const T left = clamp(T(charge * T(1 / end_band)), T(0), T(1));
        const T room = clamp(T((T(1) - charge) * T(1 / end_band)), T(0), T(1));
        const T discharge = max_discharge * left - auxiliary_power + returned;
        const T charging = max_charge * room + auxiliary_power + drawn;
        return {clamp(T(discharge / max(drawn, T(least))), T(0), T(1)),
                clamp(T(charging / max(returned, T(least))), T(0), T(1))};
    }
    // `power`: of all motors together [W].
    BatteryMomenta<T> evaluate(const T& power, const BatteryState<const T>& at) const {
        constexpr double least = 1;  // divisor of the current [V]
        BatteryMomenta<T> out;
        out.power = power + auxiliary_power;
        out.current = out.power / max(at.voltage, T(least));
        out.heat = resistance * out.current * out.current;
        const T rate = -out.current * inverse_capacity;
        out.charge_rate = select(at.charge > T(0), rate, max(rate, T(0)));
        out.voltage_rate = T(voltage_rate) * (open_voltage.at(at.charge) - resistance * out.current - at.voltage);
        return out;
    }
};

}  // namespace hamilcar
