// Rill's TMeasy (Rill, Road Vehicle Dynamics, 2011, 3.3; "TMeasy - the handling tire model", 2013): a characteristic given by its
// initial stiffness, its peak and its full sliding, at a load and at twice that load. Slip is relative to the rolling speed; both
// directions are combined into a common slip, and the force acts in its direction.
#pragma once

#include "hamilcar/tire/slip_tire.hpp"

namespace hamilcar {

// A quantity at any load, through its values at F_N and 2 F_N and zero at zero: x (p + q x), x = Fz / F_N.
template <class T>
struct OverLoad {
    T p, q;
    static constexpr auto members() { return std::tuple(&OverLoad::p, &OverLoad::q); }
    OverLoad() = default;
    OverLoad(double once, double twice) : p(2 * once - 0.5 * twice), q(0.5 * twice - once) {}
    T operator()(const T& x) const { return x * (p + q * x); }
};
// Likewise for a quantity that is not zero at zero load: linear.
template <class T>
struct AlongLoad {
    T once, more;
    static constexpr auto members() { return std::tuple(&AlongLoad::once, &AlongLoad::more); }
    AlongLoad() = default;
    AlongLoad(double at_once, double at_twice) : once(at_once), more(at_twice - at_once) {}
    T operator()(const T& x) const { return once + more * (x - T(1)); }
};

template <class T>
struct TmeasyDirection {
    OverLoad<T> stiffness, peak_force, sliding_force;
    AlongLoad<T> peak_slip, sliding_slip;
    static constexpr auto members() {
        using D = TmeasyDirection;
        return std::tuple(&D::stiffness, &D::peak_force, &D::sliding_force, &D::peak_slip, &D::sliding_slip);
    }
    TmeasyDirection() = default;
    explicit TmeasyDirection(const std::array<TmeasyCurve, 2>& d)
        : stiffness(d[0].stiffness, d[1].stiffness),
          peak_force(d[0].peak_force, d[1].peak_force),
          sliding_force(d[0].sliding_force, d[1].sliding_force),
          peak_slip(d[0].peak_slip, d[1].peak_slip),
          sliding_slip(d[0].sliding_slip, d[1].sliding_slip) {}

    struct Curve {
        T stiffness, peak_force, sliding_force, peak_slip, sliding_slip;
    };
    // Friction scales the forces and their slips, so that the stiffness is unchanged.
    Curve at(const T& x, const T& friction) const {
        return {stiffness(x), peak_force(x) * friction, sliding_force(x) * friction, peak_slip(x) * friction,
                sliding_slip(x) * friction};
    }
};

template <class T>
struct Tmeasy {
    static constexpr std::string_view keyword = "tmeasy";
    T inverse_min_load;                          // [1/N]
    T min_load, max_load, inverse_nominal_load;  // [N, N, 1/N]
    TmeasyDirection<T> longitudinal, lateral;
    AlongLoad<T> trail, trail_vanishes, trail_ends;
    T contact_length;        // at the nominal load [m]
    T friction, resistance;  // [1], rolling resistance times rolling radius [m]
    T carcass_x, carcass_y;  // 1 / stiffness [m/N]
    static constexpr auto members() {
        using M = Tmeasy;
        return std::tuple(&M::inverse_min_load, &M::min_load, &M::max_load, &M::inverse_nominal_load, &M::longitudinal,
                          &M::lateral, &M::trail, &M::trail_vanishes, &M::trail_ends, &M::contact_length, &M::friction,
                          &M::resistance, &M::carcass_x, &M::carcass_y);
    }

    Tmeasy() = default;
    explicit Tmeasy(const TmeasyDescription& d)
        : inverse_min_load(50 / d.nominal_load),
          min_load(0.02 * d.nominal_load),
          max_load(3 * d.nominal_load),
          inverse_nominal_load(1 / d.nominal_load),
          longitudinal(d.longitudinal),
          lateral(d.lateral),
          trail(d.trail[0], d.trail[1]),
          trail_vanishes(d.trail_vanishes[0], d.trail_vanishes[1]),
          trail_ends(d.trail_ends[0], d.trail_ends[1]),
          contact_length(2 * std::sqrt(2 * d.casing.radius * d.nominal_load / d.casing.vertical_stiffness)),
          friction(d.friction),
          resistance(d.rolling_resistance * d.casing.rolling_radius),
          carcass_x(1 / d.carcass_x),
          carcass_y(1 / d.carcass_y) {}

    using Curve = typename TmeasyDirection<T>::Curve;
    struct AtLoad {
        SlipLimits<T> limits;
        T Fz, x;
        Curve along, across;
    };
    AtLoad at_load(const T& load, const T&, const T& road) const {
        const T Fz = min(load, max_load), x = Fz * inverse_nominal_load, own = friction * road;
        const Curve along = longitudinal.at(x, own), across = lateral.at(x, own);
        return {.limits = {along.stiffness, across.stiffness, along.peak_force, across.peak_force,
                           along.stiffness / along.peak_force, across.stiffness / across.peak_force,
                           along.stiffness * carcass_x, across.stiffness * carcass_y},
                .Fz = Fz,
                .x = x,
                .along = along,
                .across = across};
    }

    SlipForces<T> forces(const AtLoad& at, const Slip<T>& slip) const {
        const T rolling = max(T(1) + slip.longitudinal * slip.ahead, T(0.02));
        const T s_x = slip.longitudinal / rolling, s_y = -slip.lateral / rolling;
        const Curve &X = at.along, &Y = at.across;
        // Common slip: each direction is normalized by its own slip scale.
        const T peaks = T(1) / (X.peak_slip + Y.peak_slip);
        const T bend_x = X.peak_force / X.stiffness, bend_y = Y.peak_force / Y.stiffness;
        const T bends = T(1) / (bend_x + bend_y);
        const T scale_x = X.peak_slip * peaks + bend_x * bends, scale_y = Y.peak_slip * peaks + bend_y * bends;
        const T n_x = s_x / scale_x + T(1e-15),
                n_y = s_y / scale_y;  // without slip the direction is forward and the force zero
        const T s = sqrt(n_x * n_x + n_y * n_y), cos_slip = n_x / s, sin_slip = n_y / s;
        const auto combine = [&](const T& x, const T& y) {
            const T a = x * cos_slip, b = y * sin_slip;
            return T(sqrt(a * a + b * b));
        };
        const Curve common{combine(X.stiffness * scale_x, Y.stiffness * scale_y), combine(X.peak_force, Y.peak_force),
                           combine(X.sliding_force, Y.sliding_force),
                           combine(X.peak_slip / scale_x, Y.peak_slip / scale_y),
                           combine(X.sliding_slip / scale_x, Y.sliding_slip / scale_y)};
        const T force = lookup(common, s), Fy = force * sin_slip;
        return {.Fx = force * cos_slip,
                .Fy = Fy,
                .Mx = T(0),
                .Mz = -trail_at(at, abs(s_y)) * Fy * slip.ahead,
                .resistance = resistance * at.Fz};
    }

private:
    // A rational function up to the peak; then two parabolas that join smoothly, the first with the curvature of the peak, or a
    // cubic where sliding begins too early for that.
    static T lookup(const Curve& c, const T& s) {
        const T r = s / c.peak_slip, slope = max(c.stiffness, T(2) * c.peak_force / c.peak_slip);
        const T rising = slope * s / (T(1) + r * (r + slope * c.peak_slip / c.peak_force - T(2)));
        const T past = clamp(s - c.peak_slip, T(0), c.sliding_slip - c.peak_slip), way = c.sliding_slip - c.peak_slip;
        const T drop = c.peak_force - c.sliding_force, t = past / way;
        const T ratio = c.peak_force / c.peak_slip, curvature = ratio * ratio / (slope * c.peak_slip);
        const T meet = drop / (curvature * way), left = max(way - meet, T(1e-6) * way), back = way - past;
        const T parabolas = select(past < meet, T(c.peak_force - curvature * past * past),
                                   T(c.sliding_force + curvature * meet / left * back * back));
        const T cubic = c.peak_force - drop * t * t * (T(3) - T(2) * t);
        return select(s < c.peak_slip, rising, select(meet < way, parabolas, cubic));
    }

    // Falls through zero at the first slip and returns to zero from below at the second.
    T trail_at(const AtLoad& at, const T& s_y) const {
        const T first = trail_vanishes(at.x), last = trail_ends(at.x), w = first / last;
        const T length = contact_length * sqrt(at.x), start = trail(at.x) * length;
        const T t = s_y / first;
        const T inner = (T(1) - w) * (T(1) - t) + w * (T(1) - (T(3) - T(2) * t) * t * t);
        const T back = (last - s_y) / (last - first);
        const T outer = -(T(1) - w) * (s_y - first) / first * back * back;
        return start * select(s_y < first, inner, select(s_y < last, outer, T(0)));
    }
};

}  // namespace hamilcar
