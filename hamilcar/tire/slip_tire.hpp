// Base of all tires whose forces are curves over slip. The curves are given for steady rolling; here they
// become forces that are smooth functions of time at every speed, zero included (docs/models/tires.md, "From slip to force").
//
//     k = u / sigma_x, v / sigma_y               slip equivalent to the contact's deflection
//     rho^2 = (K_x k_x / D_x)^2 + (K_y k_y / D_y)^2     above 1 the contact slides and its deflection relaxes
//     e = max(0, 1 - 1/rho^2),  w = min(w_s, g |v_s| max(K/D)),  |v_s| = |v_sx| + |v_sy|
//     u' = -v_sx - (|v_x| + w e) k_x,  v' = -v_sy - (|v_x| + w e) k_y
//     kappa = k (1 + w e / max(|v_x|, v_0))      slip at which the curves are evaluated
// In steady rolling k (|v_x| + w e) = -v_s, so kappa = -v_s / |v_x| whatever e is: the curves come out as they were measured.
// At a standstill w falls with the slip velocity, so the contact is a spring that slides at its limit: no pole, no jump.
#pragma once

#include <concepts>
#include <string_view>
#include <tuple>

#include "hamilcar/description/tire.hpp"
#include "hamilcar/scalar/elementary.hpp"
#include "hamilcar/tire/contact.hpp"

namespace hamilcar {

// Properties of the curves at a load, before any slip.
template <class T>
struct SlipLimits {
    T stiffness_x, stiffness_y;    // K: force per slip at zero slip [N]
    T friction_x, friction_y;      // D: largest force [N]
    T softness_x, softness_y;      // K / D [1]
    T relaxation_x, relaxation_y;  // sigma [m]
};

// Of curves with one largest force [N] in all directions.
template <class T>
SlipLimits<T> isotropic_limits(const T& stiffness_x, const T& stiffness_y, const T& max_force, const T& relaxation_x,
                               const T& relaxation_y) {
    return {stiffness_x,  stiffness_y, max_force, max_force, stiffness_x / max_force, stiffness_y / max_force,
            relaxation_x, relaxation_y};
}

// Input of the curves.
template <class T>
struct Slip {
    T longitudinal;  // kappa: -v_sx / |v_x| [1]
    T lateral;       // tan(alpha): v_sy / |v_x| [1]
    T ahead;         // v_x over the speed of the contact: 1 ahead, 0 sideways or standing, -1 backward [1]
    T v_x;           // [m/s]
};

// Output of the curves: forces, and moments without those from the lever arms of the forces.
template <class T>
struct SlipForces {
    T Fx, Fy, Mx, Mz;  // [N, N m]
    T resistance;      // to rolling, against the spin [N m]
};

// What a model with curves over slip asks of its curves.
template <class Curves, class T>
concept SlipCurves = requires(const Curves curves, const T& number, const Slip<T>& slip) {
    { Curves::keyword } -> std::convertible_to<std::string_view>;
    { curves.min_load } -> std::convertible_to<T>;  // below it forces are proportional to the load [N]
    { curves.inverse_min_load } -> std::convertible_to<T>;
    { curves.at_load(number, number, number).limits } -> std::convertible_to<SlipLimits<T>>;  // load, camber, friction
    { curves.forces(curves.at_load(number, number, number), slip) } -> std::same_as<SlipForces<T>>;
    Curves::members();
};

// The radial spring with its damper.
template <class T>
struct Casing {
    T radius, rolling_radius;  // [m]
    T stiffness, growth;       // [N/m, N/m^2]
    T damping;                 // [N s/m]
    T carcass_damping;         // [s]
    static constexpr auto members() {
        using C = Casing;
        return std::tuple(&C::radius, &C::rolling_radius, &C::stiffness, &C::growth, &C::damping, &C::carcass_damping);
    }

    Casing() = default;
    explicit Casing(const CasingDescription& d)
        : radius(d.radius),
          rolling_radius(d.rolling_radius),
          stiffness(d.vertical_stiffness),
          growth(d.vertical_growth),
          damping(d.vertical_damping),
          carcass_damping(d.carcass_damping) {}
};

// The curves (SlipCurves) are never evaluated below their `min_load`, where forces are proportional to the load.
//
// Divisions have high latency and do not pipeline, so several share one (`reciprocals`).
template <class T, template <class> class Curves>
struct SlipTire {
    static_assert(SlipCurves<Curves<T>, T>);
    static constexpr std::string_view keyword = Curves<T>::keyword;
    static constexpr bool has_moments = true;
    static constexpr double return_speed = 20;   // w_s: keeps the pole of fast sliding stable at a 1 ms step [m/s]
    static constexpr double return_share = 0.6;  // g: slow sliding at a standstill deflects the contact by about 2 D/K
    static constexpr double standing_speed = 2;  // v_0 [m/s]
    static constexpr double min_relaxation_length = 0.05;     // [m] ...
    static constexpr double min_relaxation_time = 1.0 / 300;  // ... and, while rolling, speed times this [s]

    T radius, rolling_radius;  // [m]
    Casing<T> casing;
    Curves<T> curves;
    static constexpr auto members() {
        using S = SlipTire;
        return std::tuple(&S::radius, &S::rolling_radius, &S::casing, &S::curves);
    }

    SlipTire() = default;
    template <class Description>
    explicit SlipTire(const Description& d)
        : radius(d.casing.radius), rolling_radius(d.casing.rolling_radius), casing(d.casing), curves(d) {}

    // Not inlined: the curves are long, and every suspension type would duplicate them.
    [[gnu::noinline]] TireForce<T> force(const TireContact<T>& c) const {
        const T pressed = max(c.depth, T(0)), elastic = pressed * (casing.stiffness + casing.growth * pressed);
        const T Fz = select(c.depth > T(0), max(elastic + casing.damping * c.depth_rate, T(0)), T(0));
        const T load = max(Fz, curves.min_load), share = min(Fz * curves.inverse_min_load, T(1));
        const auto at = curves.at_load(load, c.camber, c.friction);
        const SlipLimits<T>& limit = at.limits;

        const T speed = abs(c.v_x), shortest = T(min_relaxation_length) + T(min_relaxation_time) * speed;
        const auto curvature =
            reciprocals<T, 2>({max(limit.relaxation_x, shortest), max(limit.relaxation_y, shortest)});
        const T k_x = c.u * curvature[0], k_y = c.v * curvature[1];
        const T rho_x = limit.softness_x * k_x, rho_y = limit.softness_y * k_y;
        // Direction of travel and rolling resistance vanish at a standstill; both fade smoothly with speed.
        const auto over =
            reciprocals<T, 4>({max(rho_x * rho_x + rho_y * rho_y, T(1)), max(speed, T(standing_speed)),
                               sqrt(c.v_x * c.v_x + c.v_sy * c.v_sy + T(0.01)), sqrt(c.omega * c.omega + T(1))});
        const T surplus = T(1) - over[0], slip_speed = abs(c.v_sx) + abs(c.v_sy);  // e, |v_s|
        const T returning =
            surplus * min(T(return_speed), T(return_share) * slip_speed * max(limit.softness_x, limit.softness_y));
        const T u_rate = -c.v_sx - (speed + returning) * k_x;
        const T v_rate = -c.v_sy - (speed + returning) * k_y;

        const T stretched = T(1) + returning * over[1], lead = casing.carcass_damping;
        const Slip<T> slip{(k_x + lead * curvature[0] * u_rate) * stretched,
                           -(k_y + lead * curvature[1] * v_rate) * stretched, c.v_x * over[2], c.v_x};
        const SlipForces<T> F = curves.forces(at, slip);
        const T resisting = c.omega * over[3];
        return {.Fx = share * F.Fx,
                .Fy = share * F.Fy,
                .Fz = Fz,
                .elastic = elastic,
                .rolling_moment = -share * F.resistance * resisting,
                .Mx = share * F.Mx,
                .Mz = share * F.Mz,
                .u_rate = u_rate,
                .v_rate = v_rate};
    }

    // Energy stored by the vertical spring [J].
    T potential(const T& depth) const {
        const T pressed = max(depth, T(0));
        return pressed * pressed * (T(0.5) * casing.stiffness + T(1.0 / 3) * casing.growth * pressed);
    }
};

}  // namespace hamilcar
