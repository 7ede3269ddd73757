// A torque converter with the clutch that bridges it (docs/models/driveline.md, "Converter").
#pragma once

#include <tuple>

#include "hamilcar/math/curve.hpp"

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

}  // namespace hamilcar
