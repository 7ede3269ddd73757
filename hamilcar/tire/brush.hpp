// Brush tire: elastic bristles under a parabolic pressure, sticking from the leading edge up to the point where friction is
// exceeded (Pacejka, Tire and Vehicle Dynamics, 3rd edition, 3.2). Slip is that of the bristles, s = v_s over the rolling speed.
//
//     rho = |K s| / (3 mu Fz),  F = mu Fz (1 - (1 - rho)^3) along K s,  Mz = -mu Fz a rho (1 - rho)^3 (K s)_y / |K s|
// with the half contact length a, which is proportional to the square root of the load.
#pragma once

#include "hamilcar/tire/slip_tire.hpp"

namespace hamilcar {

template <class T>
struct Brush {
    static constexpr std::string_view keyword = "brush";
    T inverse_min_load;                // [1/N]
    T min_load, inverse_nominal_load;  // [N, 1/N]
    T stiffness_x, stiffness_y;        // per load [1]
    T friction, half_length;           // [1], at the nominal load [m]
    T resistance;                      // rolling resistance times rolling radius [m]
    T carcass_x, carcass_y;            // 1 / stiffness [m/N]
    static constexpr auto members() {
        using B = Brush;
        return std::tuple(&B::inverse_min_load, &B::min_load, &B::inverse_nominal_load, &B::stiffness_x,
                          &B::stiffness_y, &B::friction, &B::half_length, &B::resistance, &B::carcass_x, &B::carcass_y);
    }

    Brush() = default;
    explicit Brush(const BrushDescription& d)
        : inverse_min_load(50 / d.nominal_load),
          min_load(0.02 * d.nominal_load),
          inverse_nominal_load(1 / d.nominal_load),
          stiffness_x(d.longitudinal_stiffness / d.nominal_load),
          stiffness_y(d.cornering_stiffness / d.nominal_load),
          friction(d.friction),
          half_length(0.5 * d.contact_length),
          resistance(d.rolling_resistance * d.casing.rolling_radius),
          carcass_x(1 / d.carcass_x),
          carcass_y(1 / d.carcass_y) {}

    struct AtLoad {
        SlipLimits<T> limits;
        T Fz, max_force, half_length;  // [N, N, m]
    };
    AtLoad at_load(const T& load, const T&, const T& road) const {
        const T K_x = stiffness_x * load, K_y = stiffness_y * load, max_force = friction * road * load;
        return {.limits = isotropic_limits(K_x, K_y, max_force, T(K_x * carcass_x), T(K_y * carcass_y)),
                .Fz = load,
                .max_force = max_force,
                .half_length = half_length * sqrt(T(load * inverse_nominal_load))};
    }

    SlipForces<T> forces(const AtLoad& at, const Slip<T>& slip) const {
        // Rolling speed over forward speed: 1 + kappa ahead; all bristles of a locked wheel slide, whatever the ratio.
        const T rolling = max(T(1) + slip.longitudinal * slip.ahead, T(0.02));
        const T x = at.limits.stiffness_x * slip.longitudinal / rolling;
        const T y = -at.limits.stiffness_y * slip.lateral / rolling;
        const T pull = sqrt(x * x + y * y + T(1e-12)), rho = min(pull / (T(3) * at.max_force), T(1));
        const T sticking = T(1) - rho, cube = sticking * sticking * sticking;
        const T force = at.max_force * (T(1) - cube) / pull;
        const T moment = -at.max_force * at.half_length * rho * cube * y / pull;
        return {
            .Fx = force * x, .Fy = force * y, .Mx = T(0), .Mz = moment * slip.ahead, .resistance = resistance * at.Fz};
    }
};

}  // namespace hamilcar
