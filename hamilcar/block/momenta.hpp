// Momenta block (paper, section 6.1 (2)): forces, then the rates of the momenta.
//
//     P_V' = J^T (Qhat - v_1 x* h) + J'^T h + sum F dl/dV        // (71) in chassis axes; J' as seen from the chassis
//     p' = F,  L' = N_O - r' x p                                 // external forces only
// Springs, dampers, stops, bars and half-shafts act between bodies of the car: they enter through P_V' alone.
//
// The rate of `work` is the power of everything that is not in the potential, less what the prescribed rack's drift x
// puts in and out: d/dt (T + U - sum x.h) = sum Q_nc.v - sum x.Q - sum x'.h  (docs/theory/formulation.md, energy).
#pragma once

#include "hamilcar/block/velocity.hpp"

namespace hamilcar {

// What pushes one spoke, for the equations and for the channels.
template <class T>
struct SpokeForces {
    T spring, damper, stop, bar;   // axial [N]; stop and bar along the wheel's travel
    T spring_length, damper_rate;  // [m, m/s]
    T travel;                      // wheel travel [m]
    T drive_torque, brake_torque;  // on the wheel [N m]
    T tire_spin_torque;            // of the tire about the spin axis [N m]
    T spin;                        // relative to the carrier [rad/s]
    TireContact<T> contact;
    TireForce<T> tire;
    ContactFrame<T> frame;
};

template <class T>
struct SpokeMomenta {
    std::array<T, max_independent> V_rate, momentum_rate;
    std::array<T, max_dependent> W_rate;
    T spin_momentum_rate, deflection_x_rate, deflection_y_rate, windup_rate;
    SpokeForces<T> forces;  // only where the account is full
    SpokeMomenta() {}
};

// What the block writes down: what a step needs, or also every force and the power of the energy balance.
enum class Account { lean, full };

template <class T, class S = T>
struct Momenta {
    Spatial<T> external;  // (F ; N_O) on the whole car, chassis axes
    T work_rate;          // [W]
    std::array<SpokeMomenta<S>, max_spokes> spokes;
    Momenta() {}
};

// What a spoke adds to the whole car: its wrench, and the rate of the work.
template <class T>
using SpokeShare = std::array<T, 6 + 1>;

// What the Momenta block tells a spoke about the world around it.
template <class T>
struct Surroundings {
    RoadPlane<T> road;
    Vec3<T> gravity;  // chassis axes [m/s^2]
    Spatial<T> hub;   // v_1
    T gain;           // alpha
};

// The tire on its wheel: contact geometry, slip, force. Returns the wrench on the carrier with its wheel.
template <class T>
HAMILCAR_CORE Spatial<T> tire_wrench(const Spoke<T>& spoke, const RoadPlane<T>& road, const Vec3<T>& center,
                                     const Vec3<T>& axis, const Spatial<T>& motion, const SpokeState<const T>& state,
                                     SpokeForces<T>& out) {
    const T omega = state.spin_momentum * spoke.wheel.inverse_spin_inertia, turning = axis.dot(angular(motion));
    out.spin = omega - turning;
    return dispatch(spoke.tire, [&](const auto& tire) HAMILCAR_INLINED -> Spatial<T> {
        const auto f = contact_frame<T>(road, center, axis, tire.radius);
        const Vec3<T> v = velocity_at<T>(motion, f.point);
        const T v_x = f.longitudinal.dot(v);
        out.frame = f;
        out.contact = {.depth = f.depth,
                       .depth_rate = -f.normal.dot(v),  // the lowest point's own, straight below P
                       .v_sx = v_x + f.lever * turning - tire.rolling_radius * omega,
                       .v_sy = f.lateral.dot(v),
                       .v_x = v_x,
                       .omega = omega,
                       .friction = road.friction,
                       .u = state.deflection_x,
                       .v = state.deflection_y};
        out.tire = tire.force(out.contact);
        const TireForce<T>& F = out.tire;
        out.tire_spin_torque = F.rolling_moment - tire.rolling_radius * F.Fx;
        Spatial<T> wrench = force_at<T>(f.point, F.Fx * f.longitudinal + F.Fy * f.lateral + F.Fz * f.normal);
        angular(wrench) += (F.rolling_moment - (tire.rolling_radius - f.lever) * F.Fx) * axis;
        return wrench;
    });
}

// Everything about the wheel: the tire, and the spin equation p_s' = torque of the tire about the axis + drive + brake.
// Returns the tire's wrench. The wheels come first and together, since a tire is a chain of roots and quotients that
// another wheel's can run beside.
template <Account account, class T, class Kind>
HAMILCAR_CORE Spatial<T> wheel_momenta(const Spoke<T>& spoke, const SpokeVelocity<T, Kind>& at,
                                       const SpokeState<const T>& state, const Input<T>& input,
                                       const RoadPlane<T>& road, SpokeMomenta<T>& out) {
    SpokeForces<T> scratch;
    SpokeForces<T>& f = account == Account::full ? out.forces : scratch;
    const Spatial<T> wrench = tire_wrench<T>(spoke, road, at.wheel_center, at.spin_axis, at.motion, state, f);
    const auto brake = spoke.brake.evaluate(input.brake, f.spin, state.brake_windup);
    f.drive_torque = spoke.drive_share * input.drive_torque;
    f.brake_torque = brake.torque;
    out.windup_rate = brake.windup_rate;
    out.deflection_x_rate = f.tire.u_rate;
    out.deflection_y_rate = f.tire.v_rate;
    out.spin_momentum_rate = f.tire_spin_torque + f.drive_torque + f.brake_torque;
    return wrench;
}

// Power that is not in the potential, without the drift terms.
template <class T>
HAMILCAR_CORE T lost_power(const SpokeForces<T>& f, const Vec3<T>& axis, const Spatial<T>& motion,
                           const Spatial<T>& hub) {
    const T tire = f.tire.Fx * f.contact.v_sx + f.tire.Fy * f.contact.v_sy -
                   (f.tire.Fz - f.tire.elastic) * f.contact.depth_rate + f.tire.rolling_moment * f.contact.omega;
    const T shaft = f.drive_torque * (f.spin + axis.dot(angular(motion) - angular(hub)));
    return tire + shaft + f.brake_torque * f.spin + f.damper * f.damper_rate;
}

template <class T, class Kind>
HAMILCAR_CORE T wheel_travel(const Spoke<T>& spoke, const SpokeVelocity<T, Kind>& at) {
    return at.wheel_center[2] - spoke.wheel.center[2];
}

// How the wheel's travel, along chassis z, follows the independent coordinates.
template <class T, class Position>
HAMILCAR_CORE auto travel_line(const T& travel, const Vec3<T>& center, const Position& at) {
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
HAMILCAR_CORE SpokeShare<T> spoke_momenta(const Spoke<T>& spoke, const Kind& suspension,
                                          const SpokeVelocity<T, Kind>& at, const SpokeState<const T>& state,
                                          const Input<T>& input, const Surroundings<T>& world, const Spatial<T>& tire,
                                          const T& bar, SpokeMomenta<T>& out) {
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
    angular(Q) += at.spin_axis * (spoke.drive_share * input.drive_torque);
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

// Forces of the bars on the spokes along their wheels' travel: they couple spokes before any of them is finished.
template <class T, class S>
HAMILCAR_CORE std::array<T, max_spokes> anti_roll_forces(const Vehicle<T>& vehicle, const Velocity<T, S>& velocity) {
    std::array<T, max_spokes> travel, force;
    vehicle.template for_each_row<S>([&](const auto& row, int i) HAMILCAR_INLINED {
        visit_spoke(row.spokes, velocity, i, [&](const Spoke<S>& spoke, const auto&, const auto& at) {
            const S own = wheel_travel(spoke, at);
            for (std::size_t l = 0; l < static_cast<std::size_t>(row.count); ++l) {
                travel[static_cast<std::size_t>(row.index[l])] = at_place<T>(own, static_cast<int>(l));
                force[static_cast<std::size_t>(row.index[l])] = T(0);
            }
        });
    });
    for (const AntiRollBar<T>& bar : vehicle.anti_roll_bars) {
        const T pull = bar.rate * (travel[bar.left] - travel[bar.right]);
        force[bar.left] -= pull;
        force[bar.right] += pull;
    }
    return force;
}

// What the ground, the air and gravity do to the chassis itself.
template <class T>
HAMILCAR_CORE void chassis_momenta(const Vehicle<T>& vehicle, const Surroundings<T>& world, Spatial<T>& external,
                                   T& work_rate) {
    const Vec3<T> v = velocity_at<T>(world.hub, vehicle.aerodynamics.center);
    const Vec3<T> drag = v * (-vehicle.aerodynamics.half_density_area * sqrt(v.squaredNorm()));
    const auto hull = vehicle.hull.contact(world.road, world.hub);
    external = force_at<T>(vehicle.aerodynamics.center, drag) + hull.wrench +
               spatial<T>(world.gravity * vehicle.chassis.mass, vehicle.chassis_inertia.moment.cross(world.gravity));
    work_rate = drag.dot(v) + hull.lost_power;
}

template <class S, class T>
HAMILCAR_CORE Surroundings<S> abreast(const Surroundings<T>& world) {
    return {{abreast<S>(world.road.normal), S(world.road.offset), S(world.road.friction)},
            abreast<S>(world.gravity),
            abreast<S>(world.hub),
            S(world.gain)};
}

template <Account account, class S, class T>
HAMILCAR_CORE Momenta<T, S> momenta_block_of(const Model<T>& model, const State<T>& state, const Input<T>& input,
                                             const Velocity<T, S>& velocity) {
    Momenta<T, S> out;
    const Vehicle<T>& vehicle = model.vehicle;
    const Surroundings<T> world{model.road.seen_from(state.position(), velocity.R_GC),
                                velocity.R_GC.row(2).transpose() * (-vehicle.gravity), velocity.hub,
                                model.stabilization_gain};
    chassis_momenta(vehicle, world, out.external, out.work_rate);
    const std::array<T, max_spokes> bars = anti_roll_forces(vehicle, velocity);
    const Surroundings<S> around = abreast<S>(world);
    const Input<S> inputs{abreast<S>(input.rack), S(input.drive_torque), S(input.brake)};
    std::array<Spatial<S>, max_spokes> tires;
    vehicle.template for_each_row<S>([&](const auto& row, int i) HAMILCAR_INLINED {
        const auto numbers = gather_row<S>(state, row.index);
        visit_spoke(row.spokes, velocity, i, [&](const Spoke<S>& spoke, const auto&, const auto& at) HAMILCAR_INLINED {
            tires[i] = wheel_momenta<account>(spoke, at, spoke_view(numbers), inputs, around.road, out.spokes[i]);
        });
    });
    PlaceSum<T, S, std::tuple_size_v<SpokeShare<S>>> sum;
    vehicle.template for_each_row<S>([&](const auto& row, int i) HAMILCAR_INLINED {
        const auto numbers = gather_row<S>(state, row.index);
        visit_spoke(row.spokes, velocity, i,
                    [&](const Spoke<S>& spoke, const auto& suspension, const auto& at) HAMILCAR_INLINED {
                        sum.add(spoke_momenta<account>(spoke, suspension, at, spoke_view(numbers), inputs, around,
                                                       tires[i], from_places<S>(bars, row.index), out.spokes[i]),
                                row);
                    });
    });
    const SpokeShare<T> spokes = sum.total();
    for (int k = 0; k < 6; ++k) out.external[k] += spokes[static_cast<std::size_t>(k)];
    out.work_rate += spokes.back();
    return out;
}

// Spoke after spoke with everything that channels and the energy balance read.
template <class T>
Momenta<T> momenta_block(const Model<T>& model, const State<T>& state, const Input<T>& input,
                         const Velocity<T>& velocity) {
    return momenta_block_of<Account::full>(model, state, input, velocity);
}

}  // namespace hamilcar
