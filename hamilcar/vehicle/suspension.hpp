// The constants of a suspension, with everything attached to it, and of a trailer, whose chassis is attached by a linkage of
// its own, the hitch. Both know the offset of their numbers in a state (state_layout.hpp).
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/driveline/brake.hpp"
#include "hamilcar/force/axial.hpp"
#include "hamilcar/linkage/compose.hpp"
#include "hamilcar/math/paired.hpp"
#include "hamilcar/tire/list.hpp"
#include "hamilcar/vehicle/wheel.hpp"

namespace hamilcar {

inline constexpr int max_bodies = 6;  // with a mass, of one suspension
inline constexpr int max_wheels = 2;  // of one suspension
inline constexpr std::size_t max_vehicle_wheels =
    std::size_t{max_suspensions} * std::size_t{max_wheels};  // of a vehicle
inline constexpr int max_tires = 2;                          // of one wheel
inline constexpr int max_axial_elements = 6;                 // springs, and as many dampers, of one suspension

template <class T>
struct SuspensionBody {
    int frame;
    RigidBody<T> body;
    static constexpr auto members() { return std::tuple(&SuspensionBody::frame, &SuspensionBody::body); }
};

template <class T>
struct SuspensionWheel {
    int frame, tires;  // tires: one, or two (dual tires)
    int reaction;      // frame that the drive torque reacts on; 0: the chassis
    int bar_arm;       // coordinate that an anti-roll bar twists; -1: it acts along the wheel's travel
    int offset;        // of its first number from that of the suspension
    Wheel<T> wheel;
    T half_spacing;  // of two tires from the wheel's center along the axis [m]
    Stop<T> bump, rebound;
    Tire<T> tire;
    Brake<T> brake;
    T drive_share;  // of the drive torque [1]
    static constexpr auto members() {
        using W = SuspensionWheel;
        return std::tuple(&W::frame, &W::tires, &W::reaction, &W::bar_arm, &W::offset, &W::wheel, &W::half_spacing,
                          &W::bump, &W::rebound, &W::tire, &W::brake, &W::drive_share);
    }
};

template <class T>
struct SuspensionSpring {
    ForceLine<T> line;
    Spring<T> spring;
    static constexpr auto members() { return std::tuple(&SuspensionSpring::line, &SuspensionSpring::spring); }
};

template <class T>
struct SuspensionDamper {
    ForceLine<T> line;
    Damper<T> damper;
    int actuator;    // of its setting; -1: its force is as it stands
    T soft, growth;  // its force times soft + growth * setting
    static constexpr auto members() {
        using D = SuspensionDamper;
        return std::tuple(&D::line, &D::damper, &D::actuator, &D::soft, &D::growth);
    }
};

// Pointers into a state.
template <class Number>
struct SuspensionState {
    Number *independent, *dependent, *momentum;
};
template <class Number>
struct WheelState {
    Number &spin_momentum, &brake_windup;
    Number* deflection;  // u, v of the first tire, then of the second
};

template <class T>
struct Suspension {
    int unit;
    int offset, size;  // of its numbers in the state, and how many they are
    int first_wheel;   // its number among all wheels
    Linkage<T> linkage;
    std::vector<SuspensionBody<T>> bodies;
    std::vector<SuspensionWheel<T>> wheels;
    // The two wheels of an axle side by side, where T has pairs: none or one.
    std::vector<SuspensionWheel<Paired<T>>> both_wheels;
    std::vector<SuspensionSpring<T>> springs;
    std::vector<SuspensionDamper<T>> dampers;
    T inverse_design_determinant;          // 1 / det Phi_w at design
    int steered_by = -1;                   // index of the actuator that moves its rack; -1: the steering wheel does
    int shaft_frame = 0;                   // that carries a differential driven from the chassis; 0: none does
    Vec3<T> shaft_axis = Vec3<T>::Zero();  // about which that shaft turns, chassis axes
    static constexpr auto members() {
        using S = Suspension;
        return std::tuple(&S::unit, &S::offset, &S::size, &S::first_wheel, &S::linkage, &S::bodies, &S::wheels,
                          &S::springs, &S::dampers, &S::inverse_design_determinant, &S::steered_by, &S::shaft_frame,
                          &S::shaft_axis);
    }
    static constexpr auto derived_members() { return std::tuple(&Suspension::both_wheels); }

    // Whether it moves with the rack of the steering wheel.
    bool follows_rack() const { return unit == 0 && steered_by < 0; }

    template <class Number>
    SuspensionState<Number> state(Number* values) const {
        Number* at = values + offset;
        return {at, at + linkage.nV(), at + linkage.nq()};
    }
    template <class Number>
    WheelState<Number> wheel_state(int i, Number* values) const {
        HAMILCAR_ASSERT(static_cast<std::size_t>(i) < wheels.size());
        Number* at = values + offset + wheels[static_cast<std::size_t>(i)].offset;
        return {at[0], at[1], at + 2};
    }
};

// The most numbers of one suspension in a state.
inline constexpr int suspension_capacity = max_coordinates + max_freedoms + max_wheels * (2 + 2 * max_tires);

// Two neighboring suspensions of the same structure side by side, such as left and right. `both.offset` is zero.
template <class S>
struct SuspensionPair {
    Suspension<S> both;
    std::array<int, 2> offset;  // of each in the state
    int first;                  // index of the first
};

// The numbers of both, side by side.
template <class S, class T>
std::array<S, suspension_capacity> gather_pair(const SuspensionPair<S>& pair, const T* values) {
    std::array<S, suspension_capacity> out;
    for (int k = 0; k < pair.both.size; ++k) {
        out[static_cast<std::size_t>(k)] = S(std::array<T, 2>{values[pair.offset[0] + k], values[pair.offset[1] + k]});
    }
    return out;
}

template <class T>
struct Trailer {
    int tow, offset;  // towing unit; of its numbers in the state
    int yaw;          // index of the hitch's yaw coordinate
    Linkage<T> hitch;
    RigidBody<T> chassis;
    SpatialInertia<T> chassis_inertia;  // about the origin of the vehicle frame
    T yaw_damping;                      // of the hitch [N m s/rad]
    static constexpr auto members() {
        using R = Trailer;
        return std::tuple(&R::tow, &R::offset, &R::yaw, &R::hitch, &R::chassis, &R::chassis_inertia, &R::yaw_damping);
    }
    int freedoms() const { return hitch.nV(); }
};

}  // namespace hamilcar
