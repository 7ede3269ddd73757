// A rack that moves on its own, and the steering wheel that moves it (docs/models/steering.md):
//
//     hands ─► steering wheel ─► column, its joints ─► torsion bar ─► pinion ─► rack ◄─ tie rods
//                                                        └─► assist ─────────────┘
//
// Inertias of rack and steering wheel count for their motion against the chassis alone. What the tie rods do to the rack is the
// Velocity and Momenta blocks' part: the rack is a coordinate like those of the suspensions.
#pragma once

#include <tuple>

#include "hamilcar/force/dry_friction.hpp"
#include "hamilcar/math/curve.hpp"
#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

// References into the values of a state.
template <class Number>
struct SteeringState {
    Number &rack, &rack_momentum;        // [m], [kg m/s]
    Number &wheel, &wheel_momentum;      // angle of the steering wheel [rad], [kg m^2/s]
    Number &rack_windup, &wheel_windup;  // of their dry friction [m], [rad]
    Number& assist;                      // force on the rack [N]
};
inline constexpr int steering_numbers = 7;

// What the driver's hands do: where they hold the wheel, given by the rack, how firmly, and a torque besides.
template <class T>
struct SteeringHands {
    T rack, rack_rate;  // [m, m/s]
    T hold, torque;     // 0 to 1, [N m]
};

template <class T>
struct DryFrictionElement {
    T limit, stiffness, damping, compliance;
    static constexpr auto members() {
        using D = DryFrictionElement;
        return std::tuple(&D::limit, &D::stiffness, &D::damping, &D::compliance);
    }
    typename DryFriction<T>::Output evaluate(const T& slip, const T& windup) const {
        return DryFriction<T>::evaluate(limit, slip, windup, stiffness, damping, compliance);
    }
};

template <class T>
struct SteeringSystem {
    T rack_mass, rack_damping;                              // [kg], with an assisting motor's; [N s/m]
    T rack_travel, stop_stiffness;                          // either way [m]; [N/m]
    T wheel_inertia, inverse_wheel_inertia, wheel_damping;  // [kg m^2], [N m s/rad]
    T bar_stiffness, bar_damping;                           // of the torsion bar [N m/rad], [N m s/rad]
    T hands_stiffness, hands_damping;                       // where they hold firmly [N m/rad], [N m s/rad]
    T joint_error, joint_phase;  // amplitude of the column's angle error, and where it is zero [rad]
    Curve<T> pinion;             // its angle over the rack's displacement [rad]
    DryFrictionElement<T> rack_friction, wheel_friction;
    Curve<T> assist;                    // force over the torque of the torsion bar, for one side [N]
    Curve<T> assist_share;              // over the speed of the vehicle [1]
    T assist_rate, assist_lead;         // of its force to what is asked for [1/s]; of the torque it answers to [s]
    T fastest_rack, inverse_rack_band;  // up to where it helps fully, and over which it fades [m/s], [s/m]
    int has_joints = 0;
    int place = -1;  // of its numbers in a state; -1: there is none, the rack is prescribed
    static constexpr auto members() {
        using S = SteeringSystem;
        return std::tuple(&S::rack_mass, &S::rack_damping, &S::rack_travel, &S::stop_stiffness, &S::wheel_inertia,
                          &S::inverse_wheel_inertia, &S::wheel_damping, &S::bar_stiffness, &S::bar_damping,
                          &S::hands_stiffness, &S::hands_damping, &S::joint_error, &S::joint_phase, &S::pinion,
                          &S::rack_friction, &S::wheel_friction, &S::assist, &S::assist_share, &S::assist_rate,
                          &S::assist_lead, &S::fastest_rack, &S::inverse_rack_band, &S::has_joints, &S::place);
    }

    bool exists() const { return place >= 0; }

    template <class Number>
    SteeringState<Number> state(Number* values) const {
        Number* at = values + place;
        return {at[0], at[1], at[2], at[3], at[4], at[5], at[6]};
    }

    struct Output {
        T wheel_rate;                  // [rad/s]
        T bar_torque;                  // of the torsion bar, that turns the pinion [N m]
        T hands_torque;                // on the steering wheel [N m]
        T pinion_force, assist_force;  // on the rack [N]
        T friction, stop;              // on the rack [N]
        T on_rack, on_wheel;           // all of these [N], [N m]
        T rack_windup_rate, wheel_windup_rate, assist_rate;
        T work_rate;  // of hands and assist, less what is lost [W]
    };

    // `speed`: of the vehicle ahead [m/s].
    template <class State>
    Output evaluate(const State& at, const T& rack_rate, const SteeringHands<T>& hands, const T& speed) const {
        Output o;
        o.wheel_rate = at.wheel_momentum * inverse_wheel_inertia;
        const Shaft shaft = lower_end(at.wheel);
        const Shaft below = pinion_at(at.rack);
        const T twist = shaft.angle - below.angle, twisting = shaft.slope * o.wheel_rate - below.slope * rack_rate;
        const T damping = bar_damping * twisting;
        o.bar_torque = bar_stiffness * twist + damping;
        o.pinion_force = o.bar_torque * below.slope;
        const Shaft held = pinion_at(hands.rack);
        o.hands_torque = hands.torque + hands.hold * (hands_stiffness * (held.angle - at.wheel) +
                                                      hands_damping * (held.slope * hands.rack_rate - o.wheel_rate));
        o.assist_force = at.assist;
        o.assist_rate =
            assist_rate *
            (asked_assist(T(bar_stiffness * (twist + assist_lead * twisting)), rack_rate, speed) - at.assist);
        const auto on_rack = rack_friction.evaluate(rack_rate, at.rack_windup);
        const auto on_wheel = wheel_friction.evaluate(o.wheel_rate, at.wheel_windup);
        o.rack_windup_rate = on_rack.windup_rate, o.wheel_windup_rate = on_wheel.windup_rate;
        o.friction = on_rack.torque - rack_damping * rack_rate;
        o.stop = stop_stiffness * (max(T(-rack_travel - at.rack), T(0)) - max(T(at.rack - rack_travel), T(0)));
        const T wheel_loss = on_wheel.torque - wheel_damping * o.wheel_rate;
        o.on_rack = o.pinion_force + o.assist_force + o.friction + o.stop;
        o.on_wheel = o.hands_torque - o.bar_torque * shaft.slope + wheel_loss;
        o.work_rate = o.hands_torque * o.wheel_rate + (o.assist_force + o.friction) * rack_rate +
                      wheel_loss * o.wheel_rate - damping * twisting;
        return o;
    }

    template <class State>
    T kinetic(const State& at, const T& rack_rate) const {
        return T(0.5) *
               (rack_mass * rack_rate * rack_rate + at.wheel_momentum * at.wheel_momentum * inverse_wheel_inertia);
    }
    template <class State>
    T potential(const State& at) const {
        const T twist = lower_end(at.wheel).angle - pinion_at(at.rack).angle;
        const T pressed = max(T(abs(at.rack) - rack_travel), T(0));
        return T(0.5) * (bar_stiffness * twist * twist + stop_stiffness * pressed * pressed);
    }

    struct Shaft {
        T angle, slope;
    };
    // The torsion bar's upper end for an angle of the steering wheel: joints that are bent turn unevenly, twice a turn.
    Shaft lower_end(const T& wheel) const {
        if (!has_joints) return {wheel, T(1)};
        const auto [sine, cosine] = sincos(T(T(2) * (wheel - joint_phase)));
        return {wheel + joint_error * sine, T(1) + T(2) * joint_error * cosine};
    }
    Shaft pinion_at(const T& rack) const { return {pinion.at(rack), pinion.slope_at(rack)}; }

private:
    T asked_assist(const T& torque, const T& rack_rate, const T& speed) const {
        const T size = assist.at(abs(torque)) * assist_share.at(abs(speed));
        // A pump or a motor falls short in the direction in which it helps.
        const T along = select(torque < T(0), T(-rack_rate), rack_rate);
        const T helps = clamp(T(T(1) - (along - fastest_rack) * inverse_rack_band), T(0), T(1));
        return select(torque < T(0), T(-size), size) * helps;
    }
};

}  // namespace hamilcar
