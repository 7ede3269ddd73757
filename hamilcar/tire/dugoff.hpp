// Dugoff's tire: constant stiffnesses and friction under a uniform pressure (Dugoff, Fancher and Segel, SAE 700377, 1970; without its fall
// of the friction with the sliding speed). Slip is that of the bristles, s = v_s over the rolling speed.
//
//     lambda = mu Fz / (2 |K s|),  F = f(lambda) K s,  f = lambda (2 - lambda) below 1, 1 above
#pragma once

#include "hamilcar/tire/slip_tire.hpp"

namespace hamilcar {

template <class T>
struct Dugoff {
    static constexpr std::string_view keyword = "dugoff";
    T inverse_min_load, min_load;  // [1/N, N]
    T stiffness_x, stiffness_y;    // [N]
    T friction, resistance;        // [1], rolling resistance times rolling radius [m]
    T relaxation_x, relaxation_y;  // [m]
    static constexpr auto members() {
        using D = Dugoff;
        return std::tuple(&D::inverse_min_load, &D::min_load, &D::stiffness_x, &D::stiffness_y, &D::friction,
                          &D::resistance, &D::relaxation_x, &D::relaxation_y);
    }

    Dugoff() = default;
    explicit Dugoff(const DugoffDescription& d)
        : inverse_min_load(1000 / d.cornering_stiffness),
          min_load(0.001 * d.cornering_stiffness),
          stiffness_x(d.longitudinal_stiffness),
          stiffness_y(d.cornering_stiffness),
          friction(d.friction),
          resistance(d.rolling_resistance * d.casing.rolling_radius),
          relaxation_x(d.relaxation_x),
          relaxation_y(d.relaxation_y) {}

    struct AtLoad {
        SlipLimits<T> limits;
        T Fz, max_force;  // [N]
    };
    AtLoad at_load(const T& load, const T&, const T& road) const {
        const T max_force = friction * road * load;
        return {.limits = isotropic_limits(stiffness_x, stiffness_y, max_force, relaxation_x, relaxation_y),
                .Fz = load,
                .max_force = max_force};
    }

    SlipForces<T> forces(const AtLoad& at, const Slip<T>& slip) const {
        const T rolling = max(T(1) + slip.longitudinal * slip.ahead, T(0.02));  // over the forward speed
        const T x = stiffness_x * slip.longitudinal / rolling, y = -stiffness_y * slip.lateral / rolling;
        const T lambda = min(at.max_force / (T(2) * sqrt(x * x + y * y + T(1e-12))), T(1));
        const T sticking = lambda * (T(2) - lambda);
        return {.Fx = sticking * x, .Fy = sticking * y, .Mx = T(0), .Mz = T(0), .resistance = resistance * at.Fz};
    }
};

}  // namespace hamilcar
