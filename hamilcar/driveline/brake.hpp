// A brake that holds: dry friction behind a wind-up spring, so that a locked wheel neither creeps nor chatters
// (docs/models/forces.md, "Wheel spin, drive and brake").
#pragma once

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
struct Brake {
    static constexpr double return_rate = 100;  // of wind-up beyond the limit while slipping [1/s]
    T max_torque, stiffness, damping;

    struct Output {
        T torque;       // on the wheel about its axis [N m]
        T windup_rate;  // [rad/s]
    };
    Output evaluate(const T& command, const T& spin, const T& windup) const {
        const T limit = command * max_torque, held = limit / stiffness;
        const T windup_rate = spin - T(return_rate) * (windup - clamp(windup, T(-held), held));
        return {-clamp(T(stiffness * windup + damping * windup_rate), T(-limit), limit), windup_rate};
    }
};

}  // namespace hamilcar
