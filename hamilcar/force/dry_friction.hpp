// Dry friction in series with a torsion spring, for brakes, clutches and locking differentials: a locked one neither slides
// slowly nor chatters (docs/models/forces.md, "Wheel spin, drive and brake").
#pragma once

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
struct DryFriction {
    static constexpr double return_rate = 100;     // of wind-up beyond the limit while slipping [1/s]
    static constexpr double unwinding_rate = 300;  // maximum, toward zero, per wind-up [1/s]

    struct Output {
        T torque;       // against the slip [N m]
        T windup_rate;  // [rad/s]
    };

    // `limit`: friction torque [N m]; `slip`: relative speed [rad/s]; `compliance`: 1 / stiffness, zero where there is no
    // friction element.
    static Output evaluate(const T& limit, const T& slip, const T& windup, const T& stiffness, const T& damping,
                           const T& compliance) {
        const T held = limit * compliance;
        const T outward = T(return_rate) * held;  // while slipping, wind-up grows no faster than it returns
        const T inward = T(unwinding_rate);
        const T turned =
            clamp(slip, T(-outward - inward * max(windup, T(0))), T(outward + inward * max(-windup, T(0))));
        const T windup_rate = turned - T(return_rate) * (windup - clamp(windup, T(-held), held));
        return {-clamp(T(stiffness * windup + damping * windup_rate), T(-limit), limit), windup_rate};
    }
};

}  // namespace hamilcar
