// Fiala's tire: constant stiffnesses, and one friction coefficient that falls with the combined slip (Fiala 1954, in the form
// that multibody programs use: CSLIP, CALPHA, UMAX, UMIN). Unlike there, the combined longitudinal and side force never exceeds
// the friction limit: both are scaled down by the same factor where it would.
#pragma once

#include "hamilcar/tire/slip_tire.hpp"

namespace hamilcar {

template <class T>
struct Fiala {
    static constexpr std::string_view keyword = "fiala";
    T inverse_min_load;                // [1/N]
    T min_load;                        // [N]
    T stiffness_x, stiffness_y;        // [N]
    T static_friction, friction_drop;  // UMAX, UMAX - UMIN [1]
    T half_width;                      // [m]
    T resistance;                      // rolling resistance times rolling radius [m]
    T relaxation_x, relaxation_y;      // [m]
    static constexpr auto members() {
        using F = Fiala;
        return std::tuple(&F::inverse_min_load, &F::min_load, &F::stiffness_x, &F::stiffness_y, &F::static_friction,
                          &F::friction_drop, &F::half_width, &F::resistance, &F::relaxation_x, &F::relaxation_y);
    }

    Fiala() = default;
    explicit Fiala(const FialaDescription& d)
        : inverse_min_load(1000 / d.cornering_stiffness),
          min_load(0.001 * d.cornering_stiffness),
          stiffness_x(d.longitudinal_stiffness),
          stiffness_y(d.cornering_stiffness),
          static_friction(d.static_friction),
          friction_drop(d.static_friction - d.sliding_friction),
          half_width(0.5 * d.width),
          resistance(d.rolling_resistance * d.casing.rolling_radius),
          relaxation_x(d.relaxation_x),
          relaxation_y(d.relaxation_y) {}

    struct AtLoad {
        SlipLimits<T> limits;
        T Fz, road;
    };
    AtLoad at_load(const T& load, const T&, const T& road) const {
        const T max_force = static_friction * road * load;
        return {.limits = isotropic_limits(stiffness_x, stiffness_y, max_force, relaxation_x, relaxation_y),
                .Fz = load,
                .road = road};
    }

    SlipForces<T> forces(const AtLoad& at, const Slip<T>& slip) const {
        const T k = slip.longitudinal, slope = abs(slip.lateral), size = abs(k);
        const T whole = min(sqrt(k * k + slope * slope), T(1));
        const T largest = (static_friction - friction_drop * whole) * at.road * at.Fz;
        // Partial sliding above half the friction: |Fx| = mu Fz - (mu Fz)^2 / (4 CSLIP |k|).
        const T elastic = stiffness_x * size;
        const T sliding = largest - largest * largest / (T(4) * max(elastic, T(0.5) * largest));
        const T along = select(elastic < T(0.5) * largest, elastic, sliding);
        const T H = max(T(1) - stiffness_y * slope / (T(3) * largest), T(0)), cube = H * H * H;
        const T across = largest * (T(1) - cube);
        const T limited = min(T(1), over_root(largest, T(along * along + across * across + T(1e-12))));
        const T Fx = select(k < T(0), T(-along), along) * limited;
        const T side = select(slip.lateral < T(0), T(1), T(-1)) * limited;  // against the slip
        return {.Fx = Fx,
                .Fy = side * across,
                .Mx = T(0),
                .Mz = -side * largest * half_width * T(2) * (T(1) - H) * cube * slip.ahead,
                .resistance = resistance * at.Fz};
    }
};

}  // namespace hamilcar
