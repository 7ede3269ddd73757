// A brake that holds: dry friction behind a wind-up spring, so that a locked wheel neither creeps nor chatters
// (docs/models/forces.md, "Wheel spin, drive and brake").
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
struct Brake {
    static constexpr double return_rate = 100;  // of wind-up beyond the limit while slipping [1/s]
    T max_torque, stiffness, damping;
    T compliance;  // 1 / stiffness; zero where there is no brake

    explicit Brake(const BrakeDescription& d)
        : max_torque(d.max_torque),
          stiffness(d.windup_stiffness),
          damping(d.windup_damping),
          compliance(d.windup_stiffness > 0 ? 1 / d.windup_stiffness : 0) {}

    struct Output {
        T torque;       // on the wheel about its axis [N m]
        T windup_rate;  // [rad/s]
    };
    Output evaluate(const T& command, const T& spin, const T& windup) const {
        const T limit = command * max_torque, held = limit * compliance;
        const T windup_rate = spin - T(return_rate) * (windup - clamp(windup, T(-held), held));
        return {-clamp(T(stiffness * windup + damping * windup_rate), T(-limit), limit), windup_rate};
    }
};

}  // namespace hamilcar
