// Torque sources: a combustion engine with governor and starter, or an electric motor (docs/models/driveline.md).
#pragma once

#include <concepts>
#include <tuple>
#include <variant>
#include <vector>

#include "hamilcar/description/powertrain.hpp"
#include "hamilcar/math/curve_family.hpp"
#include "hamilcar/scalar/dispatch.hpp"

namespace hamilcar {

template <class T>
struct CombustionEngine {
    // Shares of the idle speed: the governor opens the throttle over the band below it; combustion fades out between the next
    // two, so that a stalled engine gives no torque; the starter acts up to the last.
    static constexpr double governor_band = 0.3, full_combustion = 0.5, no_combustion = 0.3, starter_release = 0.6;
    static constexpr double starter_share = 0.3;  // of the full torque at the lowest speed
    CurveFamily<T> torque;                        // over speed, at levels of the throttle, overrun first
    T idle_speed, inverse_idle_speed;
    T starter_torque;
    static constexpr auto members() {
        using E = CombustionEngine;
        return std::tuple(&E::torque, &E::idle_speed, &E::inverse_idle_speed, &E::starter_torque);
    }

    CombustionEngine() = default;
    explicit CombustionEngine(const EngineDescription& d)
        : idle_speed(d.idle_speed),
          inverse_idle_speed(1 / d.idle_speed),
          starter_torque(starter_share * d.torque.back().torque.front()) {
        for (std::size_t i = 0; i < d.torque.size(); ++i) {
            torque.add(d.throttle[i], i > 0 ? d.throttle[i - 1] : 0, d.torque[i].speed, d.torque[i].torque);
        }
    }

    // Torque on the rotor [N m] at a pedal position [1] and a speed [rad/s].
    T at(const T& pedal, const T& speed, const T&) const {
        const T share = speed * inverse_idle_speed;
        const T governed = clamp(T((T(1) - share) * T(1 / governor_band)), T(0), T(1));
        const T throttle = max(clamp(pedal, T(0), T(1)), governed);
        const T sum = torque.at(throttle, speed);
        const T fires = clamp(T((share - T(no_combustion)) * T(1 / (full_combustion - no_combustion))), T(0), T(1));
        const T starter =
            starter_torque *
            clamp(T((T(starter_release) - share) * T(1 / (starter_release - full_combustion))), T(0), T(1));
        // Without combustion the engine drags; the drag vanishes at rest.
        const T drag = torque.curves[0].at(speed) * clamp(T(share * T(1 / no_combustion)), T(-1), T(1));
        return fires * sum + (T(1) - fires) * drag + starter;
    }
};

template <class T>
struct ElectricMotor {
    static constexpr double fade_band = 0.05;          // share of the top speed over which the torque fades out [1]
    static constexpr double full_regeneration = 0.02;  // share of the top speed above which regeneration is full [1]
    T max_torque, max_power, max_speed, inverse_max_speed, regeneration, brake_regeneration;
    CurveFamily<T> torque;  // the largest over speed, at voltages; or none
    T efficiency;
    CurveFamily<T> efficiency_map;  // over speed, at torques; or none
    static constexpr auto members() {
        using M = ElectricMotor;
        return std::tuple(&M::max_torque, &M::max_power, &M::max_speed, &M::inverse_max_speed, &M::regeneration,
                          &M::brake_regeneration, &M::torque, &M::efficiency, &M::efficiency_map);
    }

    ElectricMotor() = default;
    explicit ElectricMotor(const MotorDescription& d)
        : max_torque(d.max_torque),
          max_power(d.max_power),
          max_speed(d.max_speed),
          inverse_max_speed(1 / d.max_speed),
          regeneration(d.regeneration),
          brake_regeneration(d.brake_regeneration),
          torque(family(d.torque)),
          efficiency(d.efficiency),
          efficiency_map(family(d.efficiency_map)) {}

    // The largest that field and current allow, whichever way it acts [N m].
    T strongest(const T& speed, const T& voltage) const {
        const T turning = abs(speed);
        if (torque.exists()) return torque.at(voltage, turning);
        return min(max_torque, T(max_power / max(turning, T(1e-3))));
    }
    // Share of it that may speed the motor up further.
    T driving(const T& speed) const {
        return clamp(T((T(1) - speed * inverse_max_speed) * T(1 / fade_band)), T(0), T(1));
    }
    // Share of it that may brake, with the sign of the speed.
    T braking(const T& speed) const {
        return clamp(T(speed * inverse_max_speed * T(1 / full_regeneration)), T(-1), T(1));
    }
    T at(const T& pedal, const T& speed, const T& voltage) const {
        const T throttle = clamp(pedal, T(0), T(1));
        return strongest(speed, voltage) *
               (throttle * driving(speed) - (T(1) - throttle) * (regeneration * braking(speed)));
    }
    // Taken from its supply, negative where it gives back [W].
    T electric_power(const T& acting, const T& speed) const {
        const T mechanical = acting * speed;
        const T share = efficiency_map.exists() ? efficiency_map.at(abs(acting), abs(speed)) : efficiency;
        return select(mechanical > T(0), T(mechanical / share), T(mechanical * share));
    }

private:
    static CurveFamily<T> family(const MapDescription& map) {
        CurveFamily<T> out;
        for (std::size_t i = 0; i < map.level.size(); ++i) {
            out.add(map.level[i], i > 0 ? map.level[i - 1] : 0, map.speed[i], map.value[i]);
        }
        return out;
    }
};

template <class T>
using Source = std::variant<CombustionEngine<T>, ElectricMotor<T>>;

// Torque on the rotor [N m] at a pedal position [1], a speed [rad/s] and the voltage of what feeds it [V].
template <class Model, class T>
concept TorqueSource = requires(const Model source, const T& pedal, const T& speed, const T& voltage) {
    { source.at(pedal, speed, voltage) } -> std::same_as<T>;
    Model::members();
};
static_assert(every_alternative(std::type_identity<Source<double>>(),
                                []<class Model>() { return TorqueSource<Model, double>; }));

template <class T>
Source<T> make_source(const EngineDescription& d) {
    return CombustionEngine<T>(d);
}
template <class T>
Source<T> make_source(const MotorDescription& d) {
    return ElectricMotor<T>(d);
}

}  // namespace hamilcar
