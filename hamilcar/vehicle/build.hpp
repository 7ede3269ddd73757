// From a description to the constants of a car, for any scalar.
#pragma once

#include <stdexcept>

#include "hamilcar/math/convert.hpp"
#include "hamilcar/vehicle/build_composed.hpp"
#include "hamilcar/vehicle/build_powertrain.hpp"
#include "hamilcar/vehicle/vehicle.hpp"

namespace hamilcar {

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
            .wheel = make_wheel<T>(d.wheel),
            .spring = {T(d.spring.rate), T(d.spring.force_at_design), design.spring_length},
            .damper = Damper<T>(d.damper),
            .bump = make_stop<T>(d.bump),
            .rebound = make_stop<T>(d.rebound),
            .tire = make_tire<T>(d.tire),
            .brake = Brake<T>(d.brake),
            .drive_share = T(d.drive_share),
            .inverse_design_determinant = T(1) / design.determinant};
}

template <class T>
Vehicle<T>::Vehicle(const VehicleDescription& d)
    : chassis(make_body<T>(d.chassis)),
      chassis_inertia(SpatialInertia<T>::about_origin(chassis.mass, chassis.center, chassis.inertia)),
      aerodynamics(d.aerodynamics),
      hull(d.hull),
      gravity(d.gravity),
      total_mass(chassis.mass) {
    if (d.corners.size() > std::size_t{max_spokes}) throw std::length_error("a vehicle has at most 12 such corners");
    for (const auto& corner : d.corners) {
        spokes.push_back(make_spoke<T>(corner));
        total_mass += spokes.back().carrier.mass;
    }
    const auto add_bars = [](const auto& from, std::vector<AntiRollBar<T>>& to) {
        for (const auto& bar : from) {
            to.push_back({static_cast<int>(bar.left), static_cast<int>(bar.right), T(bar.rate)});
        }
    };
    add_bars(d.anti_roll_bars, anti_roll_bars);
    add_bars(d.composed_bars, composed_bars);
    places = places_of(spokes);
    if constexpr (!std::is_same_v<Abreast<T>, T>) rows = in_rows<Abreast<T>, Spoke>(spokes, places);
    state_size = hub_size + spoke_size * spoke_count();
    add_composed(d);
    add_powertrain(d);
}

// Those after the corners, one after the other.
template <class T>
void Vehicle<T>::add_composed(const VehicleDescription& d) {
    if (d.composed.size() > std::size_t{max_composed} || d.trailers.size() > std::size_t{max_trailers}) {
        throw std::length_error("a vehicle has at most 40 composed suspensions and 8 trailers");
    }
    int wheel_count = 0;
    for (const ComposedSpokeDescription& spoke : d.composed) {
        composed.push_back(make_composed<T>(spoke, state_size, wheel_count));
        state_size += composed_size(composed.back());
        wheel_count += static_cast<int>(spoke.wheels.size());
        for (const ComposedBody<T>& body : composed.back().bodies) total_mass += body.body.mass;
    }
    for (const TrailerDescription& trailer : d.trailers) {
        trailers.push_back(make_trailer<T>(trailer, state_size));
        state_size += 2 * trailers.back().freedoms();
        total_mass += trailers.back().chassis.mass;
    }
}

// Behind everything else. Rotors turn by themselves: their spin inertia is none of the chassis's.
template <class T>
void Vehicle<T>::add_powertrain(const VehicleDescription& d) {
    powertrain = make_powertrain<T>(d);
    powertrain.offset = state_size;
    state_size += powertrain.size();
    for (const PowerUnit<T>& unit : powertrain.units) {
        take_rotor_out(unit.axis, unit.inertia, chassis_inertia.inertia);
    }
    if (state_size > state_capacity) throw std::length_error("the vehicle has more coordinates than a state can hold");
}

#ifndef HAMILCAR_INSTRUCTION_SET  // an engine links with nothing; elsewhere one file compiles this for all
extern template Vehicle<double>::Vehicle(const VehicleDescription&);
extern template void Vehicle<double>::add_composed(const VehicleDescription&);
extern template void Vehicle<double>::add_powertrain(const VehicleDescription&);
#endif

}  // namespace hamilcar
