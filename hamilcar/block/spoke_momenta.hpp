// One spoke of the Momenta block: the forces on a corner, and the rates of its momenta.
//
//     P_V' = J^T (Qhat - v_1 x* h) + J'^T h + sum F dl/dV        // (71) in chassis axes; J' as seen from the chassis
// Springs, dampers, stops, bars and half-shafts act between bodies of the car: they enter through P_V' alone.
//
// The rate of `work` is the power of everything that is not in the potential, less what the prescribed rack's drift x
// puts in and out: d/dt (T + U - sum x.h) = sum Q_nc.v - sum x.Q - sum x'.h  (docs/theory/formulation.md, energy).
#pragma once

#include "hamilcar/block/velocity.hpp"
#include "hamilcar/block/wheel_momenta.hpp"

namespace hamilcar {

// What pushes one spoke.
template <class T>
struct SpokeForces : WheelForces<T> {
    T spring, damper;              // axial [N]
    T spring_length, damper_rate;  // [m, m/s]
};

template <class T>
struct SpokeMomenta {
    std::array<T, max_independent> V_rate, momentum_rate;
    std::array<T, max_dependent> W_rate;
    T spin_momentum_rate, deflection_x_rate, deflection_y_rate, windup_rate;
    T drive_torque;         // on the wheel [N m]
    SpokeForces<T> forces;  // only where the account is full
    SpokeMomenta() {}
};

// What the block writes down: what a step needs, or also every force and the power of the energy balance.
enum class Account { lean, full };

// What a spoke adds to the whole car: its wrench, and the rate of the work.
template <class T>
using SpokeShare = std::array<T, 6 + 1>;

// Everything about the wheel: the tire, and the spin equation p_s' = torque of the tire about the axis + drive + brake.
// Returns the tire's wrench. The wheels come first and together, since a tire is a chain of roots and quotients that
// another wheel's can run beside.
template <Account account, class T, class Kind>
Spatial<T> wheel_momenta(const Spoke<T>& spoke, const SpokeVelocity<T, Kind>& at, const SpokeState<const T>& state,
                         const T& brake_command, const T& drive, const GroundOfWheel<T>& ground, SpokeMomenta<T>& out) {
    SpokeForces<T> scratch;
    SpokeForces<T>& f = account == Account::full ? out.forces : scratch;
    const T omega = state.spin_momentum * spoke.wheel.inverse_spin_inertia;
    const T turning = at.spin_axis.dot(angular(at.motion));
    f.spin = omega - turning;
    const Spatial<T> wrench = tire_wrench<T>(spoke.tire, ground, at.wheel_center, at.spin_axis, at.motion, omega,
                                             turning, state.deflection_x, state.deflection_y, f, f.tire_spin_torque);
    const auto brake = spoke.brake.evaluate(brake_command, f.spin, state.brake_windup);
    f.drive_torque = out.drive_torque = drive;
    f.brake_torque = brake.torque;
    out.windup_rate = brake.windup_rate;
    out.deflection_x_rate = f.tire.u_rate;
    out.deflection_y_rate = f.tire.v_rate;
    out.spin_momentum_rate = f.tire_spin_torque + f.drive_torque + f.brake_torque;
    return wrench;
}

// Power that is not in the potential, without the drift terms.
template <class T>
T lost_power(const SpokeForces<T>& f, const Vec3<T>& axis, const Spatial<T>& motion, const Spatial<T>& hub) {
    const T shaft = f.drive_torque * (f.spin + axis.dot(angular(motion) - angular(hub)));
    return lost_in_tire(f) + shaft + f.brake_torque * f.spin + f.damper * f.damper_rate;
}

template <class T, class Kind>
T wheel_travel(const Spoke<T>& spoke, const SpokeVelocity<T, Kind>& at) {
    return at.wheel_center[2] - spoke.wheel.center[2];
}

// How the wheel's travel, along chassis z, follows the independent coordinates.
template <class T, class Position>
auto travel_line(const T& travel, const Vec3<T>& center, const Position& at) {
    constexpr int nV = std::decay_t<decltype(at.J)>::ColsAtCompileTime;
    const auto rise = [&](const auto& motion) -> T {
        return motion[2] + (motion[3] * center[1] - motion[4] * center[0]);
    };
    Line<T, nV> line;
    line.length = travel;
    for (int j = 0; j < nV; ++j) line.gradient[j] = rise(at.J.col(j));
    line.drift = Position::drifts ? rise(at.x) : T(0);
    return line;
}

// Rates of one spoke's linkage, its tire pushing with `tire` and the anti-roll bars with `bar`.
template <Account account, class T, class Kind>
SpokeShare<T> spoke_momenta(const Spoke<T>& spoke, const Kind& suspension, const SpokeVelocity<T, Kind>& at,
                            const SpokeState<const T>& state, const Input<T>& input, const Surroundings<T>& world,
                            const Spatial<T>& tire, const T& bar, SpokeMomenta<T>& out) {
    constexpr int nV = Kind::Linkage::nV, nW = Kind::Linkage::nW;
    const auto rates = suspension.linkage.rates(at.position, at.V_rate, input.rack);
    Spatial<T> h = at.inertia * at.motion;
    angular(h) += at.spin_momentum;

    SpokeForces<T> scratch;
    SpokeForces<T>& f = account == Account::full ? out.forces : scratch;
    f.bar = bar;
    f.travel = wheel_travel(spoke, at);
    const Spatial<T> weight = spatial<T>(world.gravity * at.inertia.mass, at.inertia.moment.cross(world.gravity));
    const Spatial<T> external = weight + tire;

    const auto spring = suspension.spring_line(at.position, state.independent);
    const auto damper = suspension.damper_line(at.position, state.independent);
    const auto travel = travel_line<T>(f.travel, at.wheel_center, at.position);
    f.spring_length = spring.length;
    f.damper_rate = damper.rate(at.V_rate);
    f.spring = spoke.spring.force(spring.length);
    f.damper = spoke.damper.force(f.damper_rate);
    f.stop = spoke.bump.force(f.travel) - spoke.rebound.force(T(-f.travel));

    Spatial<T> Q = external;  // (55)
    angular(Q) += at.spin_axis * out.drive_torque;
    const Spatial<T> carried = Q - cross_force<T>(world.hub, h);
    const Vector<T, nV> rate = at.position.J.transpose() * carried + rates.J.transpose() * h +  // (71)
                               f.spring * spring.gradient + f.damper * damper.gradient +
                               (f.stop + f.bar) * travel.gradient;
    for (int i = 0; i < nV; ++i) out.momentum_rate[i] = rate[i], out.V_rate[i] = at.V_rate[i];
    for (int i = 0; i < nW; ++i) out.W_rate[i] = rates.W[i];

    SpokeShare<T> share;
    for (int k = 0; k < 6; ++k) share[static_cast<std::size_t>(k)] = external[k];
    T& work_rate = share.back();
    work_rate = T(0);
    if constexpr (account == Account::full) {
        work_rate = lost_power(f, at.spin_axis, at.motion, world.hub);
        if constexpr (Kind::Linkage::Position::drifts) {
            const auto x_rate = suspension.linkage.drift_rate(at.position, rates, input.rack, world.gain);
            work_rate -= at.position.x.dot(carried) + x_rate.dot(h) + f.spring * spring.drift +
                         f.damper * damper.drift + (f.stop + f.bar) * travel.drift;
        }
    }
    return share;
}

}  // namespace hamilcar
