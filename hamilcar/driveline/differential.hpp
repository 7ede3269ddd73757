// One shaft into two: speeds in = ratio (s a + (1 - s) b), and a lock that passes torque from the faster output to the
// slower one. Open, locked, limited, torque biasing and viscous differ in what the lock can hold.
#pragma once

#include <tuple>

#include "hamilcar/driveline/grip.hpp"

namespace hamilcar {

template <class T>
struct Differential {
    T ratio, share;
    T preload, locking_drive, locking_coast;  // what the lock holds: [N m], and shares of the outgoing torque [1]
    T viscosity;                              // [N m s/rad]
    T stiffness, damping, compliance;         // of the torsion between the outputs
    std::array<int, 2> outputs{};             // a wheel's number among those driven, or -1 - differential
    static constexpr auto members() {
        using D = Differential;
        return std::tuple(&D::ratio, &D::share, &D::preload, &D::locking_drive, &D::locking_coast, &D::viscosity,
                          &D::stiffness, &D::damping, &D::compliance, &D::outputs);
    }

    T input_speed(const T& a, const T& b) const { return ratio * (share * a + (T(1) - share) * b); }

    struct Output {
        T a, b;  // on the outputs [N m]
        T lock;  // from a to b [N m]
        T windup_rate;
        T loss;  // [W]
    };
    Output evaluate(const T& torque, const T& a, const T& b, const T& windup) const {
        const T out = ratio * torque;
        const T slip = a - b;
        // Ramps and worms feel the torque's sign, a fluid the slip; all of it behind the shafts' torsion, so that no viscosity
        // is too much for a step.
        const T limit = preload + abs(out) * select(out >= T(0), locking_drive, locking_coast) + viscosity * abs(slip);
        const auto grip = Grip<T>::evaluate(limit, slip, windup, stiffness, damping, compliance);
        const T lock = -grip.torque;
        return {share * out - lock, (T(1) - share) * out + lock, lock, grip.windup_rate, lock * slip};
    }
};

}  // namespace hamilcar
