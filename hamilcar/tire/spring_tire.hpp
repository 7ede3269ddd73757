// A frictionless vertical spring that pulls as well as it pushes: no limit, no loss. For ride and energy studies.
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/scalar/scalar.hpp"
#include "hamilcar/tire/contact.hpp"

namespace hamilcar {

template <class T>
struct SpringTire {
    static constexpr std::string_view keyword = "spring";
    T radius, rolling_radius;  // [m]
    T stiffness;               // [N/m]
    static constexpr auto members() {
        return std::tuple(&SpringTire::radius, &SpringTire::rolling_radius, &SpringTire::stiffness);
    }

    SpringTire() = default;
    explicit SpringTire(const SpringTireDescription& d)
        : radius(d.radius), rolling_radius(d.rolling_radius), stiffness(d.vertical_stiffness) {}

    HAMILCAR_CORE TireForce<T> force(const TireContact<T>& c) const {
        const T Fz = stiffness * c.depth;
        return {
            .Fx = T(0), .Fy = T(0), .Fz = Fz, .elastic = Fz, .rolling_moment = T(0), .u_rate = T(0), .v_rate = T(0)};
    }
    T potential(const T& depth) const { return T(0.5) * stiffness * depth * depth; }
    Deflection<T> holding(const T&, const T&, const T&) const { return {T(0), T(0)}; }
};

}  // namespace hamilcar
