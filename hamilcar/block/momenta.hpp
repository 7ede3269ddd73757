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
    SpokeForces<T> forces;
    SpokeMomenta() {}
};

template <class T>
struct Momenta {
    Spatial<T> external;  // (F ; N_O) on the whole car, chassis axes
    T work_rate;          // [W]
    std::array<SpokeMomenta<T>, max_spokes> spokes;
    Momenta() {}
};

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
Spatial<T> tire_wrench(const Spoke<T>& spoke, const RoadPlane<T>& road, const Vec3<T>& center, const Vec3<T>& axis,
                       const Spatial<T>& motion, const SpokeState<const T>& state, SpokeForces<T>& out) {
    const T omega = state.spin_momentum / spoke.wheel.spin_inertia;
    out.spin = omega - axis.dot(angular(motion));
    return std::visit(
        [&](const auto& tire) -> Spatial<T> {
            const auto f = contact_frame<T>(road, center, axis, tire.radius);
            const Vec3<T> v = velocity_at<T>(motion, f.point);
            const T v_x = f.longitudinal.dot(v);
            out.frame = f;
            out.contact = {.depth = f.depth,
                           .depth_rate = -f.normal.dot(velocity_at<T>(motion, f.lowest)),
                           .v_sx = v_x + f.lever * axis.dot(angular(motion)) - tire.rolling_radius * omega,
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
        },
        spoke.tire);
}

// Spin equation of the wheel: p_s' = torque of the tire about the axis + drive + brake.
template <class T>
void wheel_momenta(const Spoke<T>& spoke, const SpokeState<const T>& state, const Input<T>& input,
                   SpokeMomenta<T>& out) {
    SpokeForces<T>& f = out.forces;
    const auto brake = spoke.brake.evaluate(input.brake, f.spin, state.brake_windup);
    f.brake_torque = brake.torque;
    out.windup_rate = brake.windup_rate;
    out.deflection_x_rate = f.tire.u_rate;
    out.deflection_y_rate = f.tire.v_rate;
    out.spin_momentum_rate = f.tire_spin_torque + f.drive_torque + f.brake_torque;
}

// Power that is not in the potential, without the drift terms.
template <class T>
T lost_power(const SpokeForces<T>& f, const Vec3<T>& axis, const Spatial<T>& motion, const Spatial<T>& hub) {
    const T tire = f.tire.Fx * f.contact.v_sx + f.tire.Fy * f.contact.v_sy -
                   (f.tire.Fz - f.tire.elastic) * f.contact.depth_rate + f.tire.rolling_moment * f.contact.omega;
    const T shaft = f.drive_torque * (f.spin + axis.dot(angular(motion) - angular(hub)));
    return tire + shaft + f.brake_torque * f.spin + f.damper * f.damper_rate;
}

template <class T, class S>
void spoke_momenta(const Spoke<T>& spoke, const S& suspension, const SpokeVelocity<T, S>& at,
                   const SpokeState<const T>& state, const Input<T>& input, const Surroundings<T>& world,
                   SpokeMomenta<T>& out, Momenta<T>& car) {
    constexpr int nV = S::Linkage::nV, nW = S::Linkage::nW;
    Vector<T, nW> W_rate;
    const auto rates = suspension.linkage.rates(at.position, at.V_rate, W_rate, input.rack, world.gain);
    const Spatial<T> h = at.inertia * at.motion + at.spin_momentum;

    SpokeForces<T>& f = out.forces;
    f.drive_torque = spoke.drive_share * input.drive_torque;
    const Spatial<T> weight = spatial<T>(world.gravity * at.inertia.mass, at.inertia.moment.cross(world.gravity));
    const Spatial<T> external =
        weight + tire_wrench<T>(spoke, world.road, at.wheel_center, at.spin_axis, at.motion, state, f);
    wheel_momenta(spoke, state, input, out);

    const auto spring = suspension.spring_line(at.position, state.independent);
    const auto damper = suspension.damper_line(at.position, state.independent);
    const auto travel =
        line_through<T>(f.travel, at.wheel_center, Vec3<T>(T(0), T(0), T(1)), at.position.J, at.position.x);
    f.spring_length = spring.length;
    f.damper_rate = damper.rate(at.V_rate);
    f.spring = spoke.spring.force(spring.length);
    f.damper = spoke.damper.force(f.damper_rate);
    f.stop = spoke.bump.force(f.travel) - spoke.rebound.force(T(-f.travel));

    Spatial<T> Q = external;  // (55)
    angular(Q) += at.spin_axis * f.drive_torque;
    const Spatial<T> carried = Q - cross_force<T>(world.hub, h);
    const Vector<T, nV> rate = at.position.J.transpose() * carried + rates.J.transpose() * h +  // (71)
                               f.spring * spring.gradient + f.damper * damper.gradient +
                               (f.stop + f.bar) * travel.gradient;
    for (int i = 0; i < nV; ++i) out.momentum_rate[i] = rate[i], out.V_rate[i] = at.V_rate[i];
    for (int i = 0; i < nW; ++i) out.W_rate[i] = W_rate[i];

    car.external += external;
    car.work_rate += lost_power(f, at.spin_axis, at.motion, world.hub);
    if constexpr (nW > 0) {
        car.work_rate -= at.position.x.dot(carried) + rates.x.dot(h) + f.spring * spring.drift +
                         f.damper * damper.drift + (f.stop + f.bar) * travel.drift;
    }
}

// Wheel travels first: the bars couple them before any spoke is finished.
template <class T>
void anti_roll_forces(const Vehicle<T>& vehicle, const Velocity<T>& velocity, Momenta<T>& out) {
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        visit_spoke(vehicle, velocity, i, [&](const Spoke<T>& spoke, const auto&, const auto& at) {
            out.spokes[i].forces.travel = at.wheel_center[2] - spoke.wheel.center[2];
            out.spokes[i].forces.bar = T(0);
        });
    }
    for (const AntiRollBar<T>& bar : vehicle.anti_roll_bars) {
        SpokeForces<T>&left = out.spokes[bar.left].forces, &right = out.spokes[bar.right].forces;
        const T force = bar.rate * (left.travel - right.travel);
        left.bar -= force;
        right.bar += force;
    }
}

// What the ground, the air and gravity do to the chassis itself.
template <class T>
void chassis_momenta(const Vehicle<T>& vehicle, const Surroundings<T>& world, Momenta<T>& out) {
    const Vec3<T> v = velocity_at<T>(world.hub, vehicle.aerodynamics.center);
    const Vec3<T> drag = v * (-vehicle.aerodynamics.half_density_area * sqrt(v.squaredNorm()));
    const auto hull = vehicle.hull.contact(world.road, world.hub);
    out.external =
        force_at<T>(vehicle.aerodynamics.center, drag) + hull.wrench +
        spatial<T>(world.gravity * vehicle.chassis.mass, vehicle.chassis_inertia.moment.cross(world.gravity));
    out.work_rate = drag.dot(v) + hull.lost_power;
}

template <class T>
Momenta<T> momenta_block(const Model<T>& model, const State<T>& state, const Input<T>& input,
                         const Velocity<T>& velocity) {
    Momenta<T> out;
    const Vehicle<T>& vehicle = model.vehicle;
    const Surroundings<T> world{model.road.seen_from(state.position(), velocity.R_GC),
                                velocity.R_GC.row(2).transpose() * (-vehicle.gravity), velocity.hub,
                                model.stabilization_gain};
    chassis_momenta(vehicle, world, out);
    anti_roll_forces(vehicle, velocity, out);
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        visit_spoke(vehicle, velocity, i, [&](const Spoke<T>& spoke, const auto& suspension, const auto& at) {
            spoke_momenta(spoke, suspension, at, state.spoke(i), input, world, out.spokes[i], out);
        });
    }
    return out;
}

}  // namespace hamilcar
