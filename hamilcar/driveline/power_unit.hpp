// A rotor fixed in the chassis, and how its torque comes to a shaft: through a clutch or a converter and a gearbox.
//
//     rotor  p_e' = source - clutch - pump,  spin = p_e / I - e.omega          // formulation, section 7
//     clutch friction behind the torsion of the whole driveline in the present gear (grip.hpp)
//     shaft  turns at in / ratio and gets ratio (in - loss)
// Between two gears the ratio is interpolated: a gearbox under load passes from one to the next that way.
#pragma once

#include <tuple>
#include <variant>
#include <vector>

#include "hamilcar/driveline/grip.hpp"
#include "hamilcar/driveline/source.hpp"
#include "hamilcar/math/spatial.hpp"
#include "hamilcar/scalar/dispatch.hpp"

namespace hamilcar {

// Pump torque = capacity(speed ratio) pump speed^2; where the turbine overruns the pump, they change places. The oil has to be
// sped up before it pushes: without that, the steep end of the curve on the small inertia of wheels behind a low gear would be
// too stiff for an explicit step.
template <class T>
struct Converter {
    static constexpr double oil_rate = 50;  // at which the torque follows the speeds [1/s]
    Curve<T> torque_ratio, capacity;        // over turbine speed / pump speed
    T present{0};                           // 1; 0: there is none
    T bridged_from{0};                      // speed of the turbine from which the lockup clutch may close [rad/s]
    static constexpr auto members() {
        using C = Converter;
        return std::tuple(&C::torque_ratio, &C::capacity, &C::present, &C::bridged_from);
    }

    struct Output {
        T pump;            // steady torque against the rotor [N m]
        T multiplication;  // turbine over pump
    };
    // How far the lockup clutch is closed [1]: where pump and turbine turn nearly alike, and fast enough not to stall the
    // engine. An ordinary clutch, where there is no converter, is always.
    T bridged(const T& pump_speed, const T& turbine_speed) const {
        constexpr double opens = 0.85, closes = 0.95;  // speed ratios
        const T nu = turbine_speed / max(pump_speed, T(1));
        const T alike = clamp(T((nu - T(opens)) * T(1 / (closes - opens))), T(0), T(1));
        const T fast = clamp(T((turbine_speed - bridged_from) / max(T(0.25) * bridged_from, T(1e-3))), T(0), T(1));
        return T(1) - present * (T(1) - alike * fast);
    }

    Output evaluate(const T& pump_speed, const T& turbine_speed) const {
        constexpr double least = 1;  // speed that ratios are formed with at least [rad/s]
        const T ahead = max(pump_speed, T(least)), behind = max(turbine_speed, T(least));
        const T nu = clamp(T(turbine_speed / ahead), T(0), T(1));
        const T driving = max(pump_speed, T(0)) * ahead * capacity.at(nu);
        const T nu_back = clamp(T(pump_speed / behind), T(0), T(1));
        const T braking = max(turbine_speed, T(0)) * behind * capacity.at(nu_back);
        const auto drives = pump_speed >= turbine_speed;
        return {present * select(drives, driving, T(-braking)), select(drives, torque_ratio.at(nu), T(1))};
    }
};

// What depends on the gear. Gear numbers count from reverse (-1) on: place 0 is reverse, 1 neutral, 2 first.
template <class T>
struct Gears {
    static constexpr double loss_rate = 100;  // at which friction may stop what hangs on the gearbox [1/s]
    std::vector<T> ratio, stiffness, damping;
    std::vector<T> viscosity;  // of the friction where the input hardly turns [N m s/rad]
    std::vector<T> connected;  // 1; 0 in neutral, and where there is no such gear
    static constexpr auto members() {
        return std::tuple(&Gears::ratio, &Gears::stiffness, &Gears::damping, &Gears::viscosity, &Gears::connected);
    }

    struct Engaged {
        T ratio, stiffness, damping;
        T viscosity, connected;
    };
    Engaged at(const T& gear) const {
        const T place = clamp(T(gear + T(1)), T(0), T(static_cast<double>(ratio.size() - 1)));
        Engaged out{ratio[0], stiffness[0], damping[0], viscosity[0], connected[0]};
        for (std::size_t i = 0; i + 1 < ratio.size(); ++i) {
            const T passed = clamp(T(place - T(static_cast<double>(i))), T(0), T(1));
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
    T response_rate;             // of the throttle to the pedal [1/s]; zero: at once
    T capacity;                  // of the clutch, or of what bridges the converter [N m]
    Converter<T> converter;
    Gears<T> gears;
    T loss_share;  // of the torque that passes the gearbox [1]
    int output;    // differential that it drives
    static constexpr auto members() {
        using P = PowerUnit;
        return std::tuple(&P::source, &P::inertia, &P::inverse_inertia, &P::axis, &P::response_rate, &P::capacity,
                          &P::converter, &P::gears, &P::loss_share, &P::output);
    }

    struct Output {
        T spin, shaft_speed;              // of the rotor, of the gearbox's input [rad/s]
        T throttle;                       // that is in force [1]
        T source, clutch, pump, turbine;  // torques [N m]; the clutch's and the pump's are against the rotor
        T rotor;                          // on the rotor, all together
        T out;                            // on what the gearbox drives
        T ratio;                          // in the present gear [1]
        T windup_rate, throttle_rate, oil_torque_rate;
        T loss;  // power [W]
    };
    // `shaft`: speed of what the gearbox drives [rad/s]; `clutch`: pedal; `followed`: throttle behind the response time.
    Output evaluate(const T& pedal, const T& clutch, const T& gear, const T& spin, const T& shaft, const T& windup,
                    const T& followed, const T& oil_torque) const {
        Output o;
        const auto engaged = gears.at(gear);
        o.spin = spin, o.ratio = engaged.ratio, o.shaft_speed = engaged.ratio * shaft;
        const auto at_once = response_rate == T(0);
        o.throttle = select(at_once, clamp(pedal, T(0), T(1)), followed);
        o.throttle_rate = response_rate * (clamp(pedal, T(0), T(1)) - followed);
        o.source = dispatch(source, [&](const auto& kind) -> T { return kind.at(o.throttle, spin); });
        const T closed = (T(1) - clamp(clutch, T(0), T(1))) * converter.bridged(spin, o.shaft_speed);
        const T limit = capacity * closed * engaged.connected;
        const auto grip = Grip<T>::evaluate(limit, T(spin - o.shaft_speed), windup, engaged.stiffness, engaged.damping,
                                            T(T(1) / engaged.stiffness));
        o.clutch = -grip.torque, o.windup_rate = grip.windup_rate;
        const auto fluid = converter.evaluate(spin, o.shaft_speed);
        o.pump = oil_torque, o.turbine = oil_torque * fluid.multiplication;
        o.oil_torque_rate = T(Converter<T>::oil_rate) * (fluid.pump * engaged.connected - oil_torque);
        o.rotor = o.source - o.clutch - o.pump;
        const T in = o.clutch + o.turbine;
        // Against the turning; where the shaft all but stands no steeper than a step can follow.
        const T most = loss_share * abs(in);
        const T friction = clamp(T(engaged.viscosity * o.shaft_speed), T(-most), most);
        o.out = engaged.ratio * (in - friction);
        o.loss =
            o.clutch * (spin - o.shaft_speed) + o.pump * spin - o.turbine * o.shaft_speed + friction * o.shaft_speed;
        return o;
    }

    // Torque with the pedal released and pressed, for drivers.
    std::array<T, 2> reach(const T& spin) const {
        return dispatch(source, [&](const auto& kind) -> std::array<T, 2> {
            return {kind.at(T(0), spin), kind.at(T(1), spin)};
        });
    }
};

}  // namespace hamilcar
