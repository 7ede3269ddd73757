// The forces on a wheel, from tire, drive and brake, and the equation of its spin.
#pragma once

#include "hamilcar/block/model.hpp"
#include "hamilcar/road/ground.hpp"
#include "hamilcar/tire/contact.hpp"
#include "hamilcar/vehicle/suspension.hpp"

namespace hamilcar {

// The surroundings of a suspension: road, gravity and the motion of its unit.
template <class T>
struct Surroundings {
    TangentPlane<T> road;
    Vec3<T> gravity;     // chassis axes [m/s^2]
    Spatial<T> chassis;  // v_1
    T gain;              // alpha
};

template <class S, class T>
TangentPlane<S> in_both(const TangentPlane<T>& road) {
    return {in_both<S>(road.normal), S(road.offset), S(road.friction)};
}
template <class S, class T>
Surroundings<S> in_both(const Surroundings<T>& world) {
    return {in_both<S>(world.road), in_both<S>(world.gravity), in_both<S>(world.chassis), S(world.gain)};
}

// What a suspension needs of the inputs, with the rack as it moves.
template <class T>
struct WheelInput {
    RackMotion<T> rack;
    T drive_torque;  // at the driven wheels together [N m]
};
template <class S, class T>
WheelInput<S> in_both(const WheelInput<T>& input) {
    return {in_both<S>(input.rack), S(input.drive_torque)};
}

// For the equations and the channels.
template <class T>
struct TireForces {
    TireContact<T> contact;
    TireForce<T> tire;
    ContactFrame<T> frame;
    T rise;          // of the road under the wheel [m/s]
    T moment_power;  // of Mx and Mz [W]
};

template <class T>
struct WheelForces : TireForces<T> {
    T stop;                                      // along the wheel's travel [N]
    T bar;                                       // likewise [N], or about the arm of an anti-roll bar [N m]
    T travel;                                    // [m]
    T drive_torque, brake_torque;                // on the wheel [N m]
    T tire_spin_torque;                          // of the tires about the spin axis [N m]
    T spin;                                      // relative to the carrier [rad/s]
    std::array<TireForces<T>, max_tires> tires;  // the first is also the wheel's own
};

// The ground, and the numbers of the wheels that stand on it.
template <class T>
struct GroundOfWheel {
    const UnitGround<T>& ground;
    std::array<int, 2> numbers;
};

// Wrench of a tire's forces on the carrier with its wheel.
template <class T, class Kind>
Spatial<T> carrier_wrench(const Kind& tire, const TireForces<T>& f, const Vec3<T>& axis) {
    const ContactFrame<T>& at = f.frame;
    const TireForce<T>& F = f.tire;
    Spatial<T> wrench = force_at<T>(at.point, F.Fx * at.longitudinal + F.Fy * at.lateral + F.Fz * at.normal);
    angular(wrench) += (F.rolling_moment - (tire.rolling_radius - at.lever) * F.Fx) * axis;
    if constexpr (Kind::has_moments) angular(wrench) += F.Mx * at.longitudinal + F.Mz * at.normal;
    return wrench;
}

// A tire centered at `center` that spins with `omega` about the axis, while its carrier moves with `motion`; its contact is
// deflected by u, v. Returns the wrench on the carrier with its wheel, and the torque about the axis.
template <class T>
Spatial<T> tire_wrench(const Tire<T>& any_tire, const GroundOfWheel<T>& below, const Vec3<T>& center,
                       const Vec3<T>& axis, const Spatial<T>& motion, const T& omega, const T& turning, const T& u,
                       const T& v, TireForces<T>& out, T& spin_torque) {
    return dispatch(any_tire, [&](const auto& tire) -> Spatial<T> {
        const WheelGround<T> road = below.ground.under(center, axis, motion, tire.radius, T(0), below.numbers);
        const auto f = contact_frame<T>(road.plane, center, axis, tire.radius);
        const Vec3<T> velocity = velocity_at<T>(motion, f.point);
        const T v_x = f.longitudinal.dot(velocity);
        out.frame = f;
        out.contact = {.depth = f.depth,
                       .depth_rate = road.rise - f.normal.dot(velocity),  // the lowest point's own, straight below P
                       .v_sx = v_x + f.lever * turning - tire.rolling_radius * omega,
                       .v_sy = f.lateral.dot(velocity),
                       .v_x = v_x,
                       .camber = f.camber,
                       .omega = omega,
                       .friction = road.plane.friction,
                       .u = u,
                       .v = v};
        out.tire = tire.force(out.contact);
        const TireForce<T>& F = out.tire;
        out.rise = road.rise;
        out.moment_power = T(0);
        spin_torque = F.rolling_moment - tire.rolling_radius * F.Fx;
        if constexpr (std::decay_t<decltype(tire)>::has_moments) {
            const Vec3<T> moment = F.Mx * f.longitudinal + F.Mz * f.normal;
            spin_torque += f.camber * F.Mz;
            out.moment_power = moment.dot(angular(motion)) + f.camber * F.Mz * (omega - turning);
        }
        return carrier_wrench(tire, out, axis);
    });
}

// Power of a tire's nonconservative forces.
template <class T>
T lost_in_tire(const TireForces<T>& f) {
    return f.tire.Fx * f.contact.v_sx + f.tire.Fy * f.contact.v_sy -
           (f.tire.Fz - f.tire.elastic) * f.contact.depth_rate + f.tire.Fz * f.rise +
           f.tire.rolling_moment * f.contact.omega + f.moment_power;
}

// Pose and motion of a wheel with its carrier, its drive torque and what its brake can hold.
template <class T>
struct MovingWheel {
    T spin_momentum, brake_windup;
    std::array<T, std::size_t{2} * std::size_t{max_tires}> deflection;  // u, v of the first tire, then of the second
    Vec3<T> center, axis;
    Spatial<T> carrier;  // motion of its frame
    T drive_torque;      // on the wheel [N m]
    T brake_limit;       // that its brake can hold [N m]
};

template <class S, class T>
MovingWheel<S> side_by_side(const MovingWheel<T>& left, const MovingWheel<T>& right, int tires) {
    MovingWheel<S> out{.spin_momentum = side_by_side<S>(left.spin_momentum, right.spin_momentum),
                       .brake_windup = side_by_side<S>(left.brake_windup, right.brake_windup),
                       .deflection = {},
                       .center = side_by_side<S>(left.center, right.center),
                       .axis = side_by_side<S>(left.axis, right.axis),
                       .carrier = side_by_side<S>(left.carrier, right.carrier),
                       .drive_torque = side_by_side<S>(left.drive_torque, right.drive_torque),
                       .brake_limit = side_by_side<S>(left.brake_limit, right.brake_limit)};
    for (std::size_t k = 0; k < 2 * static_cast<std::size_t>(tires); ++k) {
        out.deflection[k] = side_by_side<S>(left.deflection[k], right.deflection[k]);
    }
    return out;
}

// The resulting wrench and rates.
template <class T>
struct WheelMomenta {
    Spatial<T> wrench;  // of the tires on the carrier with its wheel
    T windup_rate, spin_momentum_rate;
    T lost_in_tires;  // [W]
};

// Everything about a wheel, or two side by side, except its suspension: tires, drive and brake, and the spin equation
// p_s' = torque of the tires about the axis + drive + brake.
template <class T>
WheelMomenta<T> wheel_momenta(const SuspensionWheel<T>& wheel, const MovingWheel<T>& at, const GroundOfWheel<T>& ground,
                              WheelForces<T>& f) {
    WheelMomenta<T> out;
    const T omega = at.spin_momentum * wheel.wheel.inverse_spin_inertia;
    const T turning = at.axis.dot(angular(at.carrier));
    f.spin = omega - turning;
    f.tire_spin_torque = out.lost_in_tires = T(0);
    out.wrench.setZero();
    for (int k = 0; k < wheel.tires; ++k) {
        const T aside = wheel.tires == 1 ? T(0) : k == 0 ? wheel.half_spacing : T(-wheel.half_spacing);
        T torque;
        out.wrench +=
            tire_wrench<T>(wheel.tire, ground, Vec3<T>(at.center + at.axis * aside), at.axis, at.carrier, omega,
                           turning, at.deflection[2 * k], at.deflection[2 * k + 1], f.tires[k], torque);
        f.tire_spin_torque += torque;
        out.lost_in_tires += lost_in_tire(f.tires[k]);
    }
    static_cast<TireForces<T>&>(f) = f.tires[0];
    const auto brake = wheel.brake.evaluate(at.brake_limit, f.spin, at.brake_windup);
    f.drive_torque = at.drive_torque;
    f.brake_torque = brake.torque;
    out.windup_rate = brake.windup_rate;
    out.spin_momentum_rate = f.tire_spin_torque + f.drive_torque + f.brake_torque;
    return out;
}

// Of one of two side by side: what the equations of motion need.
template <class T, class S>
WheelMomenta<T> unpack_wheel(const WheelMomenta<S>& from, const WheelForces<S>& forces, int tires, int place,
                             WheelForces<T>& to) {
    to.spin = lane(forces.spin, place);
    to.drive_torque = lane(forces.drive_torque, place);
    to.brake_torque = lane(forces.brake_torque, place);
    for (std::size_t k = 0; k < static_cast<std::size_t>(tires); ++k) {
        to.tires[k].tire.u_rate = lane(forces.tires[k].tire.u_rate, place);
        to.tires[k].tire.v_rate = lane(forces.tires[k].tire.v_rate, place);
    }
    WheelMomenta<T> out;
    unpack(from.wrench, place, out.wrench);
    out.windup_rate = lane(from.windup_rate, place);
    out.spin_momentum_rate = lane(from.spin_momentum_rate, place);
    out.lost_in_tires = lane(from.lost_in_tires, place);
    return out;
}

}  // namespace hamilcar
