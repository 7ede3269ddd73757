// A frictionless linear vertical spring that also pulls: no limit, no loss. For ride and energy studies.
#pragma once

#include "hamilcar/description/tire.hpp"
#include "hamilcar/scalar/scalar.hpp"
#include "hamilcar/tire/contact.hpp"

namespace hamilcar {

template <class T>
struct SpringTire {
    static constexpr std::string_view keyword = "spring";
    static constexpr bool has_moments = false;  // no Mx, Mz
    T radius, rolling_radius;                   // [m]
    T stiffness;                                // [N/m]
    static constexpr auto members() {
        return std::tuple(&SpringTire::radius, &SpringTire::rolling_radius, &SpringTire::stiffness);
    }

    SpringTire() = default;
    explicit SpringTire(const SpringTireDescription& d)
        : radius(d.radius), rolling_radius(d.rolling_radius), stiffness(d.vertical_stiffness) {}

    TireForce<T> force(const TireContact<T>& c) const {
        const T Fz = stiffness * c.depth;
        return {.Fx = T(0),
                .Fy = T(0),
                .Fz = Fz,
                .elastic = Fz,
                .rolling_moment = T(0),
                .Mx = T(0),
                .Mz = T(0),
                .u_rate = T(0),
                .v_rate = T(0)};
    }
    T potential(const T& depth) const { return T(0.5) * stiffness * depth * depth; }
};

}  // namespace hamilcar
