// Splits one shaft into two: speed in = ratio (s a + (1 - s) b), with a lock that transfers torque from the faster output to the
// slower one. Open, locked, limited-slip, torque-biasing and viscous kinds differ in the limit of the lock.
#pragma once

#include <tuple>

#include "hamilcar/force/dry_friction.hpp"
#include "hamilcar/math/eigen.hpp"

namespace hamilcar {

template <class T>
struct Differential {
    T ratio, share;
    T preload, locking_drive, locking_coast;  // limit of the lock: [N m], and shares of the output torque [1]
    T viscosity;                              // [N m s/rad]
    T stiffness, damping, compliance;         // of the torsion between the outputs
    std::array<int, 2> outputs{};             // index of a driven wheel, or -1 - index of a differential
    int on_axle = -1;                         // number of the suspension that carries it; -1: the chassis does
    Vec3<T> shaft_axis = Vec3<T>::Zero();     // about which its input turns, chassis axes; matters on an axle
    static constexpr auto members() {
        using D = Differential;
        return std::tuple(&D::ratio, &D::share, &D::preload, &D::locking_drive, &D::locking_coast, &D::viscosity,
                          &D::stiffness, &D::damping, &D::compliance, &D::outputs, &D::on_axle, &D::shaft_axis);
    }

    T input_speed(const T& a, const T& b) const { return ratio * (share * a + (T(1) - share) * b); }
    // At its input, so that neither output gets more than asked for.
    T input_torque(const T& a, const T& b) const {
        constexpr double least = 1e-3;  // share that counts
        return min(T(a / max(share, T(least))), T(b / max(T(T(1) - share), T(least)))) / ratio;
    }

    struct Output {
        T a, b;  // on the outputs [N m]
        T lock;  // from a to b [N m]
        T windup_rate;
        T loss;  // [W]
    };
    Output evaluate(const T& torque, const T& a, const T& b, const T& windup) const {
        const T out = ratio * torque;
        const T slip = a - b;
        // Ramps and worm gears respond to the sign of the torque, a fluid to the slip; both act behind the torsion of the shafts,
        // so that no viscosity is too stiff for a step.
        const T limit = preload + abs(out) * select(out >= T(0), locking_drive, locking_coast) + viscosity * abs(slip);
        const auto friction = DryFriction<T>::evaluate(limit, slip, windup, stiffness, damping, compliance);
        const T lock = -friction.torque;
        return {share * out - lock, (T(1) - share) * out + lock, lock, friction.windup_rate, lock * slip};
    }
};

}  // namespace hamilcar
