// The paper's tire, "slip and rolling": linear in slip up to a friction circle, with relaxation. Its contact deflections
// are states, so force is a smooth function of time at every speed and a standing car stands (docs/models/forces.md).
#pragma once

#include "hamilcar/description/tire.hpp"
#include "hamilcar/scalar/scalar.hpp"
#include "hamilcar/tire/contact.hpp"

namespace hamilcar {

template <class T>
struct LinearTire {
    static constexpr std::string_view keyword = "linear";
    static constexpr bool has_moments = false;
    // Speed at which a sliding contact relaxes its excess deflection [m/s]: high enough to follow the friction limit
    // within a hundredth of a second, low enough for an explicit 1 ms step.
    static constexpr double return_speed = 20;

    T radius, rolling_radius;  // [m]
    T stiffness, damping;      // vertical [N/m, N s/m]
    T slip_stiffness;          // C_kappa / Fz [1]
    T cornering_at_zero;       // C_alpha / Fz at zero load [1]
    T load_scale;              // 1 / load of the largest cornering stiffness [1/N]
    T friction;
    T curvature_x, curvature_y;  // 1 / relaxation lengths [1/m]
    T carcass_damping;           // [s]
    T rolling_resistance;
    static constexpr auto members() {
        using L = LinearTire;
        return std::tuple(&L::radius, &L::rolling_radius, &L::stiffness, &L::damping, &L::slip_stiffness,
                          &L::cornering_at_zero, &L::load_scale, &L::friction, &L::curvature_x, &L::curvature_y,
                          &L::carcass_damping, &L::rolling_resistance);
    }

    LinearTire() = default;
    explicit LinearTire(const LinearTireDescription& d)
        : radius(d.radius),
          rolling_radius(d.rolling_radius),
          stiffness(d.vertical_stiffness),
          damping(d.vertical_damping),
          slip_stiffness(d.longitudinal_stiffness),
          cornering_at_zero(2 * d.cornering_reference / d.cornering_load),
          load_scale(1 / d.cornering_load),
          friction(d.friction),
          curvature_x(1 / d.relaxation_longitudinal),
          curvature_y(1 / d.relaxation_lateral),
          carcass_damping(d.carcass_damping),
          rolling_resistance(d.rolling_resistance) {}

    TireForce<T> force(const TireContact<T>& c) const {
        const T elastic = stiffness * max(c.depth, T(0));
        const T Fz = select(c.depth > T(0), max(elastic + damping * c.depth_rate, T(0)), T(0));
        const T x = Fz * load_scale, mu = friction * c.friction;
        const T c_y = cornering_at_zero / (T(1) + x * x);

        // Sticking up to the friction circle of the elastic forces; beyond it the deflection relaxes, and the direction
        // of the force turns from the elastic one to that of sliding, against the slip velocity.
        const T k_x = c.u * curvature_x, k_y = c.v * curvature_y;
        const T elastic_x = slip_stiffness * k_x, elastic_y = c_y * k_y;
        const T sticking = min(T(1), over_root(mu, T(elastic_x * elastic_x + elastic_y * elastic_y + T(1e-30))));
        const T transport = abs(c.v_x) + T(return_speed) * (T(1) - sticking);
        const T u_rate = -c.v_sx - transport * k_x;
        const T v_rate = -c.v_sy - transport * k_y;

        const T own = max(T(2) * sticking - T(1), T(0)), common = max(slip_stiffness, c_y) * (T(1) - own);
        const T f_x = (own * slip_stiffness + common) * (k_x + carcass_damping * curvature_x * u_rate);
        const T f_y = (own * c_y + common) * (k_y + carcass_damping * curvature_y * v_rate);
        const T limited = Fz * min(T(1), over_root(mu, T(f_x * f_x + f_y * f_y + T(1e-30))));
        const T resisting = over_root(c.omega, T(c.omega * c.omega + T(1)));
        return {.Fx = limited * f_x,
                .Fy = limited * f_y,
                .Fz = Fz,
                .elastic = elastic,
                .rolling_moment = -rolling_resistance * Fz * rolling_radius * resisting,
                .Mx = T(0),
                .Mz = T(0),
                .u_rate = u_rate,
                .v_rate = v_rate};
    }

    // Energy stored by the vertical spring [J].
    T potential(const T& depth) const {
        const T pressed = max(depth, T(0));
        return T(0.5) * stiffness * pressed * pressed;
    }
};

}  // namespace hamilcar
