// A rotor mounted in the chassis that drives a shaft through a clutch or torque converter and a gearbox.
//
//     rotor  p_e' = source - clutch - pump,  spin = p_e / I - e.omega          // formulation, section 7
//     clutch friction behind the torsion of the whole driveline in the present gear (dry_friction.hpp)
//     shaft  turns at in / ratio and receives ratio (in - loss)
// Between two gears the ratio is interpolated, as for a gearbox that shifts under load.
#pragma once

#include <tuple>
#include <variant>
#include <vector>

#include "hamilcar/driveline/commands.hpp"
#include "hamilcar/driveline/source.hpp"
#include "hamilcar/force/dry_friction.hpp"
#include "hamilcar/math/spatial.hpp"
#include "hamilcar/scalar/dispatch.hpp"

namespace hamilcar {

// Pump torque = capacity(speed ratio) pump speed^2; where the turbine overruns the pump, their roles are exchanged. The oil torque
// follows with a lag: without it, the steep end of the curve and the small inertia of wheels behind a low gear would be too stiff
// for an explicit step.
template <class T>
struct Converter {
    static constexpr double oil_rate = 50;  // at which the torque follows the speeds [1/s]
    Curve<T> torque_ratio, capacity;        // over turbine speed / pump speed
    T present{0};                           // 1, or 0 without a converter
    T lockup_min_speed{0};                  // turbine speed above which the lockup clutch may close [rad/s]
    static constexpr auto members() {
        using C = Converter;
        return std::tuple(&C::torque_ratio, &C::capacity, &C::present, &C::lockup_min_speed);
    }

    struct Output {
        T pump;            // steady torque against the rotor [N m]
        T multiplication;  // turbine over pump
    };
    // Engagement of the lockup clutch [1]: closed where pump and turbine turn at nearly the same speed, and fast enough not to
    // stall the engine. Always 1 without a converter.
    T lockup(const T& pump_speed, const T& turbine_speed) const {
        constexpr double opens = 0.85, closes = 0.95;  // speed ratios
        const T nu = turbine_speed / max(pump_speed, T(1));
        const T synchronous = clamp(T((nu - T(opens)) * T(1 / (closes - opens))), T(0), T(1));
        const T fast =
            clamp(T((turbine_speed - lockup_min_speed) / max(T(0.25) * lockup_min_speed, T(1e-3))), T(0), T(1));
        return T(1) - present * (T(1) - synchronous * fast);
    }

    Output evaluate(const T& pump_speed, const T& turbine_speed) const {
        constexpr double min_speed = 1;  // lower bound on the divisor of speed ratios [rad/s]
        const T ahead = max(pump_speed, T(min_speed)), behind = max(turbine_speed, T(min_speed));
        const T nu = clamp(T(turbine_speed / ahead), T(0), T(1));
        const T driving = max(pump_speed, T(0)) * ahead * capacity.at(nu);
        const T nu_back = clamp(T(pump_speed / behind), T(0), T(1));
        const T braking = max(turbine_speed, T(0)) * behind * capacity.at(nu_back);
        const auto drives = pump_speed >= turbine_speed;
        return {present * select(drives, driving, T(-braking)), select(drives, torque_ratio.at(nu), T(1))};
    }
};

// Quantities that depend on the gear, indexed from reverse (gear -1): 0 is reverse, 1 neutral, 2 first.
template <class T>
struct Gears {
    static constexpr double loss_rate = 100;  // maximum rate at which friction stops the parts behind the gearbox [1/s]
    std::vector<T> ratio, stiffness, damping;
    std::vector<T> viscosity;  // of the friction near zero input speed [N m s/rad]
    std::vector<T> connected;  // 1; 0 in neutral and for gears that do not exist
    static constexpr auto members() {
        return std::tuple(&Gears::ratio, &Gears::stiffness, &Gears::damping, &Gears::viscosity, &Gears::connected);
    }

    struct Engaged {
        T ratio, stiffness, damping;
        T viscosity, connected;
    };
    Engaged at(const T& gear) const {
        const T position = clamp(T(gear + T(1)), T(0), T(static_cast<double>(ratio.size() - 1)));
        Engaged out{ratio[0], stiffness[0], damping[0], viscosity[0], connected[0]};
        for (std::size_t i = 0; i + 1 < ratio.size(); ++i) {
            const T passed = clamp(T(position - T(static_cast<double>(i))), T(0), T(1));
            out.ratio += (ratio[i + 1] - ratio[i]) * passed;
            out.stiffness += (stiffness[i + 1] - stiffness[i]) * passed;
            out.damping += (damping[i + 1] - damping[i]) * passed;
            out.viscosity += (viscosity[i + 1] - viscosity[i]) * passed;
            out.connected += (connected[i + 1] - connected[i]) * passed;
        }
        return out;
    }
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
    T loss_share;  // of the torque through the gearbox [1]
    int output;    // differential that it drives
    int command;   // index of its first command; -1: it takes none
    static constexpr auto members() {
        using P = PowerUnit;
        return std::tuple(&P::source, &P::inertia, &P::inverse_inertia, &P::axis, &P::response_rate, &P::capacity,
                          &P::converter, &P::gears, &P::loss_share, &P::output, &P::command);
    }

    struct Output {
        T spin, shaft_speed;              // of the rotor, of the gearbox's input [rad/s]
        T throttle;                       // effective [1]
        T source, clutch, pump, turbine;  // torques [N m]; the clutch's and the pump's are against the rotor
        T rotor;                          // total on the rotor
        T out;                            // on the gearbox output
        T ratio;                          // in the present gear [1]
        T windup_rate, throttle_rate, oil_torque_rate;
        T loss;  // power [W]
    };
    // The pedal within the limits that controllers set.
    T limited(const T& pedal, const T* commands) const {
        if (!commands || command < 0) return pedal;
        return min(max(pedal, commands[command + UnitCommand::min_throttle]),
                   commands[command + UnitCommand::max_throttle]);
    }
    // `shaft`: speed of the gearbox output [rad/s]; `clutch`: pedal; `followed`: throttle with its response lag.
    Output evaluate(const T& pedal, const T& clutch, const T& gear, const T& spin, const T& shaft, const T& windup,
                    const T& followed, const T& oil_torque) const {
        Output o;
        const auto engaged = gears.at(gear);
        o.spin = spin, o.ratio = engaged.ratio, o.shaft_speed = engaged.ratio * shaft;
        const auto at_once = response_rate == T(0);
        o.throttle = select(at_once, clamp(pedal, T(0), T(1)), followed);
        o.throttle_rate = response_rate * (clamp(pedal, T(0), T(1)) - followed);
        o.source = dispatch(source, [&](const auto& kind) -> T { return kind.at(o.throttle, spin); });
        const T closed = (T(1) - clamp(clutch, T(0), T(1))) * converter.lockup(spin, o.shaft_speed);
        const T limit = capacity * closed * engaged.connected;
        const auto clutch_friction = DryFriction<T>::evaluate(limit, T(spin - o.shaft_speed), windup, engaged.stiffness,
                                                              engaged.damping, T(T(1) / engaged.stiffness));
        o.clutch = -clutch_friction.torque, o.windup_rate = clutch_friction.windup_rate;
        const auto fluid = converter.evaluate(spin, o.shaft_speed);
        o.pump = oil_torque, o.turbine = oil_torque * fluid.multiplication;
        o.oil_torque_rate = T(Converter<T>::oil_rate) * (fluid.pump * engaged.connected - oil_torque);
        o.rotor = o.source - o.clutch - o.pump;
        const T in = o.clutch + o.turbine;
        // Opposes the rotation; viscous near standstill, with a slope that an explicit step can follow.
        const T max_friction = loss_share * abs(in);
        const T friction = clamp(T(engaged.viscosity * o.shaft_speed), T(-max_friction), max_friction);
        o.out = engaged.ratio * (in - friction);
        o.loss =
            o.clutch * (spin - o.shaft_speed) + o.pump * spin - o.turbine * o.shaft_speed + friction * o.shaft_speed;
        return o;
    }

    // Torque with the pedal released and fully pressed, for drivers.
    std::array<T, 2> torque_range(const T& spin) const {
        return dispatch(source, [&](const auto& kind) -> std::array<T, 2> {
            return {kind.at(T(0), spin), kind.at(T(1), spin)};
        });
    }
};

}  // namespace hamilcar
