// The mechanics of a steering from their description.
#pragma once

#include "hamilcar/steering/column.hpp"
#include "hamilcar/steering/steering_system.hpp"

namespace hamilcar {

namespace detail {

template <class T>
DryFrictionElement<T> make_friction(double limit, double stiffness, double damping) {
    return {T(limit), T(stiffness), T(damping), T(limit > 0 ? 1 / stiffness : 0)};
}

// The pinion's angle over the rack, straight between points; more of them where the ratio varies.
template <class T>
Curve<T> pinion_curve(const SteeringDescription& steering) {
    constexpr double beyond_stops = 2;  // times the rack's travel: stops give way
    constexpr int points = 36;          // on each side
    const Column column(steering);
    const double farthest = beyond_stops * steering.rack_travel;
    std::vector<double> rack, angle;
    const int count = steering.angle.empty() ? 1 : points;
    for (int i = -count; i <= count; ++i) {
        if (i == 0 && steering.angle.empty()) continue;
        rack.push_back(farthest * i / count), angle.push_back(column.angle(rack.back()));
    }
    return Curve<T>(rack, angle);
}

}  // namespace detail

// `steering` has mechanics.
template <class T>
SteeringSystem<T> make_steering(const SteeringDescription& steering) {
    const SteeringMechanicsDescription& d = *steering.mechanics;
    const SteeringAssistDescription& assist = d.assist;
    constexpr double friction_damping = 0.5;  // of critical, of what friction holds
    const auto damping = [](double stiffness, double inertia) {
        return 2 * friction_damping * std::sqrt(stiffness * inertia);
    };
    SteeringSystem<T> out{
        .rack_mass = T(d.rack_mass),
        .rack_damping = T(d.rack_damping),
        .rack_travel = T(steering.rack_travel),
        .stop_stiffness = T(d.stop_stiffness),
        .wheel_inertia = T(d.wheel_inertia),
        .inverse_wheel_inertia = T(1 / d.wheel_inertia),
        .wheel_damping = T(d.wheel_damping),
        .bar_stiffness = T(d.bar_stiffness),
        .bar_damping = T(d.bar_damping),
        .hands_stiffness = T(d.hands_stiffness),
        .hands_damping = T(d.hands_damping),
        .joint_error = T(d.joint_error),
        .joint_phase = T(d.joint_phase),
        .pinion = detail::pinion_curve<T>(steering),
        .rack_friction =
            detail::make_friction<T>(d.rack_friction, d.rack_stiffness, damping(d.rack_stiffness, d.rack_mass)),
        .wheel_friction =
            detail::make_friction<T>(d.wheel_friction, d.wheel_stiffness, damping(d.wheel_stiffness, d.wheel_inertia)),
        .assist = assist.torque.empty() ? Curve<T>({0}, {0}) : Curve<T>(assist.torque, assist.force),
        .assist_share = assist.speed.empty() ? Curve<T>({0}, {1}) : Curve<T>(assist.speed, assist.share),
        .assist_rate = T(1 / assist.response_time),
        .assist_lead = T(assist.lead_time),
        .fastest_rack = T(assist.fastest_rack),
        .inverse_rack_band = T(1 / assist.rack_band)};
    out.has_joints = d.joint_error > 0 ? 1 : 0;
    return out;
}

}  // namespace hamilcar
