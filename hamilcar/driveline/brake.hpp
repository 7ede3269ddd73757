// A brake that holds: dry friction behind a wind-up spring, so that a locked wheel neither creeps nor chatters
// (docs/models/forces.md, "Wheel spin, drive and brake").
#pragma once

#include <tuple>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
struct Brake {
    static constexpr double return_rate = 100;     // of wind-up beyond the limit while slipping [1/s]
    static constexpr double unwinding_rate = 300;  // largest, toward zero, per wind-up [1/s]
    T max_torque, stiffness, damping;
    T compliance;  // 1 / stiffness; zero where there is no brake
    static constexpr auto members() {
        return std::tuple(&Brake::max_torque, &Brake::stiffness, &Brake::damping, &Brake::compliance);
    }

    Brake() = default;
    explicit Brake(const BrakeDescription& d)
        : max_torque(d.max_torque),
          stiffness(d.windup_stiffness),
          damping(d.windup_damping),
          compliance(d.windup_stiffness > 0 ? 1 / d.windup_stiffness : 0) {}

    struct Output {
        T torque;       // on the wheel about its axis [N m]
        T windup_rate;  // [rad/s]
    };
    HAMILCAR_CORE Output evaluate(const T& command, const T& spin, const T& windup) const {
        const T limit = command * max_torque, held = limit * compliance;
        const T outward = T(return_rate) * held;  // a slipping brake winds up no faster than it returns
        const T inward = T(unwinding_rate);
        const T turned =
            clamp(spin, T(-outward - inward * max(windup, T(0))), T(outward + inward * max(-windup, T(0))));
        const T windup_rate = turned - T(return_rate) * (windup - clamp(windup, T(-held), held));
        return {-clamp(T(stiffness * windup + damping * windup_rate), T(-limit), limit), windup_rate};
    }
};

}  // namespace hamilcar
