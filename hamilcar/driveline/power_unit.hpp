// A rotor mounted in the chassis that drives a shaft through a clutch or torque converter and a gearbox.
//
//     rotor  p_e' = source - clutch - pump,  spin = p_e / I - e.omega          // formulation, section 7
//     clutch friction behind the torsion of the whole driveline in the present gear (dry_friction.hpp)
//     shaft  turns at in / ratio and receives ratio (in - loss)
// Between two gears the ratio is interpolated, as for a gearbox that shifts under load. A gearbox may have an inertia of its own, with
// shafts that wind up behind it; and a unit on a wheel's carrier turns with the wheel.
#pragma once

#include <tuple>
#include <variant>
#include <vector>

#include "hamilcar/driveline/commands.hpp"
#include "hamilcar/driveline/converter.hpp"
#include "hamilcar/driveline/gears.hpp"
#include "hamilcar/driveline/source.hpp"
#include "hamilcar/force/dry_friction.hpp"
#include "hamilcar/math/spatial.hpp"
#include "hamilcar/scalar/dispatch.hpp"

namespace hamilcar {

// What the driver and controllers tell power units.
template <class T>
struct PowertrainInput {
    T pedal, clutch, gear;  // as in Input
    const T* commands;      // of all actuators, or null where they are at rest
};

// References into the values of a state.
template <class Number>
struct PowerUnitState {
    Number &momentum, &windup, &throttle, &oil_torque;  // p_e [kg m^2/s], [rad], [1], [N m]
    Number* shafts;                                     // momentum and wind-up, where there are shafts with an inertia
};

template <class T>
struct PowerUnit {
    Source<T> source;
    T inertia, inverse_inertia;  // [kg m^2]
    Vec3<T> axis;                // e, chassis axes
    T response_rate;             // of the throttle to the pedal [1/s]; zero: immediate
    T capacity;                  // of the clutch, or of the converter's lockup clutch [N m]
    Converter<T> converter;
    Gears<T> gears;
    Shafts<T> shafts;
    T loss_share;       // of the torque through the gearbox [1]
    int output;         // that it drives: index of a driven wheel, or -1 - index of a differential
    int rotor_is_free;  // 0: it turns with the wheel on whose carrier the unit sits
    int command;        // index of its first command; -1: it takes none
    int place;          // of its numbers in a state
    static constexpr auto members() {
        using P = PowerUnit;
        return std::tuple(&P::source, &P::inertia, &P::inverse_inertia, &P::axis, &P::response_rate, &P::capacity,
                          &P::converter, &P::gears, &P::shafts, &P::loss_share, &P::output, &P::rotor_is_free,
                          &P::command, &P::place);
    }

    template <class Number>
    PowerUnitState<Number> state(Number* values) const {
        Number* at = values + place;
        return {at[0], at[1], at[2], at[3], at + 4};
    }
    bool is_electric() const { return std::holds_alternative<ElectricMotor<T>>(source); }

    // What it asks of its source.
    struct Demand {
        T spin;           // of the rotor [rad/s]
        T throttle;       // effective [1]
        T throttle_rate;  // [1/s]
        T torque;         // [N m]
        T regenerated;    // by how much it brakes more, in place of friction [N m]
        T power;          // from a battery [W]
        // Of a motor for the battery's limits: 1 where it drives or stands, and down to 0 where it brakes, over some of its speed; and the
        // power that its torque counts as at least then. So an empty battery holds no torque at a standstill, and limits are no steeper
        // over the speed than a rotor can follow.
        T drives, least_power;
    };
    // `shaft`: speed of what it drives [rad/s]; `chassis`: angular velocity; `voltage`: of the battery; `brake`: torque at what it drives
    // that the brake pedal asks for [N m].
    Demand demand(const PowertrainInput<T>& told, const PowerUnitState<const T>& at, const T& shaft,
                  const Vec3<T>& chassis, const T& voltage, const T& brake) const {
        Demand out;
        const T pedal = limited(told.pedal, told.commands);
        out.spin = rotor_is_free ? T(at.momentum * inverse_inertia - axis.dot(chassis))
                                 : T(at_gear(gears.ratio, told.gear) * shaft);
        out.throttle = select(response_rate == T(0), clamp(pedal, T(0), T(1)), at.throttle);
        out.throttle_rate = response_rate * (clamp(pedal, T(0), T(1)) - at.throttle);
        out.torque = dispatch(source, [&](const auto& kind) -> T { return kind.at(out.throttle, out.spin, voltage); });
        if (!rotor_is_free) out.torque = out.torque * at_gear(gears.connected, told.gear);
        out.regenerated = out.power = out.drives = out.least_power = T(0);
        if (is_electric()) add_motor_demand(told, voltage, brake, out);
        return out;
    }

    struct Output {
        T spin, shaft_speed;              // of the rotor, of the gearbox's input [rad/s]
        T throttle;                       // effective [1]
        T source, clutch, pump, turbine;  // torques [N m]; the clutch's and the pump's are against the rotor
        T rotor;                          // total on the rotor
        T gearbox;                        // total on the gearbox's input, where it has an inertia
        T out;                            // on the gearbox output
        T ratio;                          // in the present gear [1]
        T windup_rate, throttle_rate, oil_torque_rate, shafts_windup_rate;
        T loss;            // power [W]
        T electric_power;  // taken from a battery, negative where it gives back [W]
        T regenerated;     // torque that takes the place of brakes, on the gearbox output [N m]
    };
    // `share`: of the torque that it asked for.
    Output evaluate(const Demand& asked, const T& share, const PowertrainInput<T>& told,
                    const PowerUnitState<const T>& at, const Vec3<T>& chassis, const T& shaft) const {
        Output o;
        const auto engaged = gears.at(told.gear);
        o.spin = asked.spin, o.ratio = engaged.ratio, o.throttle = asked.throttle;
        o.throttle_rate = asked.throttle_rate;
        o.source = asked.torque, o.electric_power = asked.power, o.regenerated = T(0);
        if (is_electric()) {
            o.source = asked.torque * share, o.electric_power = electric_power(o.source, o.spin);
            o.regenerated = asked.regenerated * share * abs(engaged.ratio);
        }
        if (rotor_is_free) {
            couple(engaged, told, at, chassis, shaft, o);
        } else {
            o.shaft_speed = o.spin, o.clutch = o.source;
            o.pump = o.turbine = o.rotor = o.gearbox = T(0);
            o.windup_rate = o.oil_torque_rate = o.shafts_windup_rate = T(0);
            const T friction = friction_of(engaged, o.clutch, o.shaft_speed);
            o.out = engaged.ratio * (o.clutch - friction), o.loss = friction * o.shaft_speed;
        }
        return o;
    }

    // What a motor takes from a battery for a torque [W].
    T electric_power(const T& torque, const T& spin) const {
        return is_electric() ? std::get<ElectricMotor<T>>(source).electric_power(torque, spin) : T(0);
    }
    bool has_efficiency_map() const {
        return is_electric() && std::get<ElectricMotor<T>>(source).efficiency_map.exists();
    }

    // Torque with the pedal released and fully pressed, for drivers.
    std::array<T, 2> torque_range(const T& spin, const T& voltage) const {
        return dispatch(source, [&](const auto& kind) -> std::array<T, 2> {
            return {kind.at(T(0), spin, voltage), kind.at(T(1), spin, voltage)};
        });
    }

private:
    // The pedal within the limits that controllers set.
    T limited(const T& pedal, const T* commands) const {
        if (!commands || command < 0) return pedal;
        return min(max(pedal, commands[command + UnitCommand::min_throttle]),
                   commands[command + UnitCommand::max_throttle]);
    }

    // What controllers add, and what the brake pedal asks for, within what the motor has.
    void add_motor_demand(const PowertrainInput<T>& told, const T& voltage, const T& brake, Demand& out) const {
        const auto& motor = std::get<ElectricMotor<T>>(source);
        const bool commanded = told.commands && command >= 0;
        const T strongest = motor.strongest(out.spin, voltage);
        const T ratio = abs(at_gear(gears.ratio, told.gear)), connected = at_gear(gears.connected, told.gear);
        if (commanded) {
            T added = told.commands[command + UnitCommand::added_torque] * motor.max_torque;
            added = select(added * out.spin > T(0), T(added * motor.driving(abs(out.spin))), added);
            if (!rotor_is_free) added = added * connected;
            out.torque = clamp(T(out.torque + added), T(-strongest), strongest);
        }
        const T let = commanded ? told.commands[command + UnitCommand::max_regeneration] : T(1);
        const T asked = min(T(brake / max(ratio, T(1e-3))), T(motor.brake_regeneration * let * strongest));
        const T held = rotor_is_free ? T(capacity * (T(1) - clamp(told.clutch, T(0), T(1)))) : asked;
        const T braking = min(asked, held) * connected * motor.braking(out.spin);
        const T before = out.torque;
        out.torque = clamp(T(before - braking), T(-strongest), strongest);
        out.regenerated = abs(before - out.torque);
        out.power = motor.electric_power(out.torque, out.spin);
        constexpr double band = 0.05;  // of the top speed
        const T slow = T(band) * motor.max_speed;
        const T along = select(out.torque >= T(0), out.spin, T(-out.spin));
        out.drives = clamp(T(T(1) + along / slow), T(0), T(1));
        out.least_power = abs(out.torque) * slow * out.drives;
    }

    // Opposes the rotation; viscous near standstill, with a slope that an explicit step can follow.
    T friction_of(const typename Gears<T>::Engaged& engaged, const T& in, const T& speed) const {
        const T max_friction = loss_share * abs(in);
        return clamp(T(engaged.viscosity * speed), T(-max_friction), max_friction);
    }

    // From a rotor that turns on its own through clutch or converter to the gearbox, and behind it.
    void couple(const typename Gears<T>::Engaged& engaged, const PowertrainInput<T>& told,
                const PowerUnitState<const T>& at, const Vec3<T>& chassis, const T& shaft, Output& o) const {
        const T& spin = o.spin;
        const T driven = engaged.ratio * shaft;
        o.shaft_speed = shafts.exist() ? T(at.shafts[0] * shafts.inverse_inertia - axis.dot(chassis)) : driven;
        const T closed = (T(1) - clamp(told.clutch, T(0), T(1))) * converter.lockup(spin, o.shaft_speed);
        const T reached = shafts.exist() ? T(1) : engaged.connected;
        const T limit = capacity * closed * reached;
        const auto clutch_friction = DryFriction<T>::evaluate(
            limit, T(spin - o.shaft_speed), at.windup, engaged.stiffness, engaged.damping, T(T(1) / engaged.stiffness));
        o.clutch = -clutch_friction.torque, o.windup_rate = clutch_friction.windup_rate;
        const auto fluid = converter.evaluate(spin, o.shaft_speed);
        o.pump = at.oil_torque, o.turbine = at.oil_torque * fluid.multiplication;
        o.oil_torque_rate = T(Converter<T>::oil_rate) * (fluid.pump * reached - at.oil_torque);
        o.rotor = o.source - o.clutch - o.pump;
        const T in = o.clutch + o.turbine;
        const T friction = friction_of(engaged, in, o.shaft_speed);
        o.gearbox = o.shafts_windup_rate = T(0);
        T passed = in - friction;
        if (shafts.exist()) {
            const auto twisted = shafts.evaluate(told.gear, engaged.connected, T(o.shaft_speed - driven), at.shafts[1]);
            o.gearbox = passed - twisted.torque, o.shafts_windup_rate = twisted.windup_rate;
            passed = twisted.torque;
        }
        o.out = engaged.ratio * passed;
        o.loss =
            o.clutch * (spin - o.shaft_speed) + o.pump * spin - o.turbine * o.shaft_speed + friction * o.shaft_speed;
    }
};

}  // namespace hamilcar
