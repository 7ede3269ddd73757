// What pushes a wheel: tire, drive, brake, and the equation of its spin.
#pragma once

#include "hamilcar/block/model.hpp"
#include "hamilcar/road/ground.hpp"
#include "hamilcar/tire/contact.hpp"
#include "hamilcar/vehicle/composed.hpp"

namespace hamilcar {

// What the Momenta block tells a spoke about the world around it.
template <class T>
struct Surroundings {
    RoadPlane<T> road;
    Vec3<T> gravity;  // chassis axes [m/s^2]
    Spatial<T> hub;   // v_1
    T gain;           // alpha
};

template <class S, class T>
Surroundings<S> abreast(const Surroundings<T>& world) {
    return {{abreast<S>(world.road.normal), S(world.road.offset), S(world.road.friction)},
            abreast<S>(world.gravity),
            abreast<S>(world.hub),
            S(world.gain)};
}

// What a spoke is told of the driver.
template <class S, class T>
Input<S> abreast(const Input<T>& input) {
    return {{S(input.rack.displacement), S(input.rack.rate), S(input.rack.acceleration)},
            S(input.drive_torque),
            S(input.brake),
            input.time};
}

// For the equations and for the channels.
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
    T stop, bar;                   // along the wheel's travel [N]
    T travel;                      // [m]
    T drive_torque, brake_torque;  // on the wheel [N m]
    T tire_spin_torque;            // of the tires about the spin axis [N m]
    T spin;                        // relative to the carrier [rad/s]
};

// The ground, and which wheels of the vehicle stand on it here.
template <class T>
struct GroundOfWheel {
    const GroundBelow<T>& ground;
    std::array<int, 2> numbers;
};

// What a tire's forces do to the carrier with its wheel.
template <class T, class Kind>
Spatial<T> carrier_wrench(const Kind& tire, const TireForces<T>& f, const Vec3<T>& axis) {
    const ContactFrame<T>& at = f.frame;
    const TireForce<T>& F = f.tire;
    Spatial<T> wrench = force_at<T>(at.point, F.Fx * at.longitudinal + F.Fy * at.lateral + F.Fz * at.normal);
    angular(wrench) += (F.rolling_moment - (tire.rolling_radius - at.lever) * F.Fx) * axis;
    if constexpr (Kind::has_moments) angular(wrench) += F.Mx * at.longitudinal + F.Mz * at.normal;
    return wrench;
}

// A tire that stands at `center` and turns with `omega` about the axis, its carrier moving with `motion` and its contact
// deflected by u, v. Returns the wrench on the carrier with its wheel; adds to the torque about the axis.
template <class T>
Spatial<T> tire_wrench(const Tire<T>& any_tire, const GroundOfWheel<T>& below, const Vec3<T>& center,
                       const Vec3<T>& axis, const Spatial<T>& motion, const T& omega, const T& turning, const T& u,
                       const T& v, TireForces<T>& out, T& spin_torque) {
    return dispatch(any_tire, [&](const auto& tire) -> Spatial<T> {
        const WheelRoad<T> road = below.ground.under(center, axis, motion, tire.radius, below.numbers);
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

// Power of a tire that is not in its potential.
template <class T>
T lost_in_tire(const TireForces<T>& f) {
    return f.tire.Fx * f.contact.v_sx + f.tire.Fy * f.contact.v_sy -
           (f.tire.Fz - f.tire.elastic) * f.contact.depth_rate + f.tire.Fz * f.rise +
           f.tire.rolling_moment * f.contact.omega + f.moment_power;
}

}  // namespace hamilcar
