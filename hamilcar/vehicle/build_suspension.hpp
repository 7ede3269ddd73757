// Suspensions and trailers from their descriptions.
#pragma once

#include <stdexcept>

#include "hamilcar/vehicle/state_layout.hpp"
#include "hamilcar/vehicle/suspension.hpp"

namespace hamilcar {

template <class T>
RigidBody<T> make_body(const BodyDescription& d) {
    return {T(d.mass),
            as<T>(vec3(d.center_of_mass)),
            {T(d.inertia[0]), T(d.inertia[1]), T(d.inertia[2]), T(d.products[0]), T(d.products[1]), T(d.products[2])}};
}

template <class T>
Wheel<T> make_wheel(const WheelDescription& d) {
    return {as<T>(vec3(d.center)), as<T>(vec3(d.spin_axis).normalized()), T(d.spin_inertia), T(1 / d.spin_inertia)};
}

template <class T>
Stop<T> make_stop(const StopDescription& d) {
    return {T(d.gap), T(d.rate), T(d.progression)};
}

template <class T>
ForceLine<T> make_line(const LinkageDescription& linkage, const LineDescription& d) {
    return {frame_of_part(linkage, d.part), frame_of_part(linkage, d.base), d.coordinate.value_or(-1),
            as<T>(vec3(d.on_part)),         as<T>(vec3(d.on_base)),         T(d.at_design)};
}

template <class T>
SuspensionWheel<T> make_suspension_wheel(const LinkageDescription& linkage, const SuspensionWheelDescription& d,
                                         int offset) {
    return {.frame = frame_of_part(linkage, d.part),
            .tires = d.tires(),
            .reaction = frame_of_part(linkage, d.drive_reaction),
            .bar_arm = d.bar_arm.value_or(-1),
            .offset = offset,
            .wheel = make_wheel<T>(d.wheel),
            .half_spacing = T(d.dual_spacing / 2),
            .bump = make_stop<T>(d.bump),
            .rebound = make_stop<T>(d.rebound),
            .tire = make_tire<T>(d.tire),
            .brake = Brake<T>(d.brake),
            .drive_share = T(d.drive_share)};
}

inline void check_sizes(const SuspensionDescription& d) {
    const int coordinates = d.linkage.coordinate_count(), equations = d.linkage.equation_count();
    if (coordinates > max_coordinates || equations > max_equations || coordinates - equations > max_freedoms ||
        coordinates - equations < 1 || d.bodies.size() > std::size_t{max_bodies} ||
        d.wheels.size() > std::size_t{max_wheels} || d.springs.size() > std::size_t{max_axial_elements} ||
        d.dampers.size() > std::size_t{max_axial_elements}) {
        throw std::length_error(d.name +
                                ": a suspension has at most 12 coordinates, 9 cut equations, 3 degrees of freedom, 6 " +
                                "bodies, 2 wheels, 6 springs and 6 dampers");
    }
}

template <class T>
Suspension<T> make_suspension(const SuspensionDescription& d, const StateLayout::SuspensionPlaces& places,
                              int first_wheel) {
    check_sizes(d);
    Suspension<T> out;
    out.unit = static_cast<int>(d.unit), out.first_wheel = first_wheel;
    out.offset = places.offset, out.size = places.size;
    out.linkage = compose_for<T>(d.linkage);
    for (const auto& body : d.bodies) {
        out.bodies.push_back({frame_of_part(d.linkage, body.part), make_body<T>(body.body)});
    }
    for (std::size_t i = 0; i < d.wheels.size(); ++i) {
        out.wheels.push_back(make_suspension_wheel<T>(d.linkage, d.wheels[i], places.wheels[i]));
    }
    const std::array<T, max_coordinates> design{};
    LinkagePosition<T> at;
    out.linkage.find_position(design.data(), design.data(), RackMotion<T>{}, T(0), at);
    out.inverse_design_determinant = T(1) / at.determinant;
    for (const auto& spring : d.springs) {
        const ForceLine<T> line = make_line<T>(d.linkage, spring.line);
        const T length = out.linkage.line(line, at, design.data(), design.data()).length;
        const double force = spring.spring.force_at_design + spring.spring.rate * spring.spring.seat;
        out.springs.push_back({line, {T(spring.spring.rate), T(force), length}});
    }
    for (const auto& damper : d.dampers) {
        out.dampers.push_back({make_line<T>(d.linkage, damper.line), Damper<T>(damper.damper), -1,
                               T(damper.damper.soft), T(damper.damper.firm - damper.damper.soft)});
    }
    return out;
}

// A hitch as a linkage without loops; its coordinates are `hitch_angles`.
inline LinkageDescription hitch_linkage(const TrailerDescription& d) {
    TreeJointDescription joint;
    joint.part = d.name, joint.point = d.hitch_point;
    if (d.hitch == Hitch::ball) {
        joint.kind = TreeJoint::spherical;
    } else {
        joint.kind = TreeJoint::universal, joint.axis = {0, 1, 0}, joint.second_axis = {0, 0, 1};
    }
    return {.joints = {joint}, .cuts = {}, .independent = {}};
}

template <class T>
Trailer<T> make_trailer(const TrailerDescription& d, int offset) {
    const RigidBody<T> chassis = make_body<T>(d.chassis);
    return {.tow = static_cast<int>(d.tow),
            .offset = offset,
            .yaw = hitch_yaw(d.hitch),
            .hitch = compose_for<T>(hitch_linkage(d)),
            .chassis = chassis,
            .chassis_inertia = SpatialInertia<T>::about_origin(chassis.mass, chassis.center, chassis.inertia),
            .yaw_damping = T(d.yaw_damping)};
}

}  // namespace hamilcar
