// From a description to the constants of a car, for any scalar.
#pragma once

#include <stdexcept>

#include "hamilcar/math/convert.hpp"
#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

template <class T>
RigidBody<T> make_body(const BodyDescription& d) {
    return {T(d.mass),
            as<T>(vec3(d.center_of_mass)),
            {T(d.inertia[0]), T(d.inertia[1]), T(d.inertia[2]), T(d.products[0]), T(d.products[1]), T(d.products[2])}};
}

// What the design position fixes once: the length at which the spring's preload is stated, and det Phi_w.
template <class T>
struct DesignFigures {
    T spring_length, determinant;
};

template <class T, class S>
DesignFigures<T> design_figures(const S& suspension) {
    using Linkage = typename S::Linkage;
    const std::array<T, Linkage::nV> V{T(suspension.design[0])};
    const std::array<T, Linkage::nW + 1> W{};
    const auto at = suspension.linkage.position(V.data(), W.data(), RackMotion<T>{}, T(0));
    return {suspension.spring_line(at, V.data()).length, at.determinant};
}

template <class T>
Spoke<T> make_spoke(const CornerDescription& d) {
    const Suspension<T> suspension = make_suspension<T>(d.suspension);
    const auto design = std::visit([](const auto& s) { return design_figures<T>(s); }, suspension);
    return {.suspension = suspension,
            .carrier = make_body<T>(d.carrier),
            .wheel = {as<T>(vec3(d.wheel.center)), as<T>(vec3(d.wheel.spin_axis).normalized()), T(d.wheel.spin_inertia),
                      T(1 / d.wheel.spin_inertia)},
            .spring = {T(d.spring.rate), T(d.spring.force_at_design), design.spring_length},
            .damper = Damper<T>(d.damper),
            .bump = {T(d.bump.gap), T(d.bump.rate), T(d.bump.progression)},
            .rebound = {T(d.rebound.gap), T(d.rebound.rate), T(d.rebound.progression)},
            .tire = make_tire<T>(d.tire),
            .brake = Brake<T>(d.brake),
            .drive_share = T(d.drive_share),
            .inverse_design_determinant = T(1) / design.determinant};
}

template <class T>
Vehicle<T>::Vehicle(const VehicleDescription& d)
    : chassis(make_body<T>(d.chassis)),
      chassis_inertia(SpatialInertia<T>::about_origin(chassis.mass, chassis.center, chassis.inertia)),
      aerodynamics{T(0.5 * d.aerodynamics.air_density * d.aerodynamics.drag_area), as<T>(vec3(d.aerodynamics.center))},
      hull(d.hull),
      gravity(d.gravity),
      total_mass(chassis.mass) {
    if (d.corners.size() > std::size_t{max_spokes}) throw std::length_error("a vehicle has at most 12 spokes");
    for (const auto& corner : d.corners) {
        spokes.push_back(make_spoke<T>(corner));
        total_mass += spokes.back().carrier.mass;
    }
    for (const auto& bar : d.anti_roll_bars) {
        anti_roll_bars.push_back({static_cast<int>(bar.left), static_cast<int>(bar.right), T(bar.rate)});
    }
    places = places_of(spokes);
    if constexpr (!std::is_same_v<Abreast<T>, T>) rows = in_rows<Abreast<T>, Spoke>(spokes, places);
}

}  // namespace hamilcar
