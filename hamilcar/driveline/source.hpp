// Torque sources: a combustion engine with governor and starter, or an electric motor (docs/models/driveline.md).
#pragma once

#include <concepts>
#include <tuple>
#include <variant>
#include <vector>

#include "hamilcar/description/powertrain.hpp"
#include "hamilcar/math/curve.hpp"
#include "hamilcar/scalar/dispatch.hpp"

namespace hamilcar {

template <class T>
struct CombustionEngine {
    // Shares of the idle speed: the governor opens the throttle over the band below it; combustion fades out between the next
    // two, so that a stalled engine gives no torque; the starter acts up to the last.
    static constexpr double governor_band = 0.3, full_combustion = 0.5, no_combustion = 0.3, starter_release = 0.6;
    static constexpr double starter_share = 0.3;  // of the full torque at the lowest speed
    std::vector<T> level, inverse_rise;           // throttle levels after the first: start, 1 / width [1]
    std::vector<Curve<T>> torque;                 // per level, overrun first
    T idle_speed, inverse_idle_speed;
    T starter_torque;
    static constexpr auto members() {
        using E = CombustionEngine;
        return std::tuple(&E::level, &E::inverse_rise, &E::torque, &E::idle_speed, &E::inverse_idle_speed,
                          &E::starter_torque);
    }

    CombustionEngine() = default;
    explicit CombustionEngine(const EngineDescription& d)
        : idle_speed(d.idle_speed),
          inverse_idle_speed(1 / d.idle_speed),
          starter_torque(starter_share * d.torque.back().torque.front()) {
        for (std::size_t i = 0; i < d.torque.size(); ++i) {
            torque.emplace_back(d.torque[i].speed, d.torque[i].torque);
            if (i + 1 == d.torque.size()) break;
            level.push_back(T(d.throttle[i]));
            inverse_rise.push_back(T(1 / (d.throttle[i + 1] - d.throttle[i])));
        }
    }

    // Torque on the rotor [N m] at a pedal position [1] and a speed [rad/s].
    T at(const T& pedal, const T& speed) const {
        const T share = speed * inverse_idle_speed;
        const T governed = clamp(T((T(1) - share) * T(1 / governor_band)), T(0), T(1));
        const T throttle = max(clamp(pedal, T(0), T(1)), governed);
        T sum = torque[0].at(speed), below = sum;
        for (std::size_t i = 0; i < level.size(); ++i) {
            const T above = torque[i + 1].at(speed);
            sum += (above - below) * clamp(T((throttle - level[i]) * inverse_rise[i]), T(0), T(1));
            below = above;
        }
        const T fires = clamp(T((share - T(no_combustion)) * T(1 / (full_combustion - no_combustion))), T(0), T(1));
        const T starter =
            starter_torque *
            clamp(T((T(starter_release) - share) * T(1 / (starter_release - full_combustion))), T(0), T(1));
        // Without combustion the engine drags; the drag vanishes at rest.
        const T drag = torque[0].at(speed) * clamp(T(share * T(1 / no_combustion)), T(-1), T(1));
        return fires * sum + (T(1) - fires) * drag + starter;
    }
};

template <class T>
struct ElectricMotor {
    static constexpr double fade_band = 0.05;          // share of the top speed over which the torque fades out [1]
    static constexpr double full_regeneration = 0.02;  // share of the top speed above which regeneration is full [1]
    T max_torque, max_power, max_speed, inverse_max_speed, regeneration;
    static constexpr auto members() {
        using M = ElectricMotor;
        return std::tuple(&M::max_torque, &M::max_power, &M::max_speed, &M::inverse_max_speed, &M::regeneration);
    }

    ElectricMotor() = default;
    explicit ElectricMotor(const MotorDescription& d)
        : max_torque(d.max_torque),
          max_power(d.max_power),
          max_speed(d.max_speed),
          inverse_max_speed(1 / d.max_speed),
          regeneration(d.regeneration) {}

    T at(const T& pedal, const T& speed) const {
        const T turning = abs(speed), share = speed * inverse_max_speed;
        const T strongest = min(max_torque, T(max_power / max(turning, T(1e-3))));
        const T throttle = clamp(pedal, T(0), T(1));
        const T driving = clamp(T((T(1) - share) * T(1 / fade_band)), T(0), T(1));
        const T braking = regeneration * clamp(T(share * T(1 / full_regeneration)), T(-1), T(1));
        return strongest * (throttle * driving - (T(1) - throttle) * braking);
    }
};

template <class T>
using Source = std::variant<CombustionEngine<T>, ElectricMotor<T>>;

// Torque on the rotor [N m] at a pedal position [1] and a speed [rad/s].
template <class Model, class T>
concept TorqueSource = requires(const Model source, const T& pedal, const T& speed) {
    { source.at(pedal, speed) } -> std::same_as<T>;
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
