// A random road of an ISO 8608 class: two tracks side by side, made once as a table of harmonics with random phases
// and read back by a cubic B-spline, so that even the curvature is continuous. Height = c(x) + d(x) s(y), where s
// goes from -1 at the right track to 1 at the left one.
//
// An isotropic surface with the spectrum n^-2 along any line has tracks with the coherence gamma = k b K_1(k b), k =
// 2 pi n, b between them. So c has the spectrum G (1 + gamma)/2 and d has G (1 - gamma)/2; either harmonic of d is a
// quarter wave before or behind that of c, by chance: then both tracks have the spectrum G in every harmonic and not
// only on average.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hamilcar/road/obstacle.hpp"
#include "hamilcar/scalar/dual.hpp"

namespace hamilcar {

struct RandomRoad {
    struct Knot {
        double common, different;  // coefficients of c and d [m]
    };
    SmoothRange along;        // where the road is
    double per_meter = 1;     // knots per meter [1/m]
    double half_width = 1;    // half of what lies between the tracks [m]
    std::vector<Knot> knots;  // of one period, a power of two

    RandomRoad() = default;
    explicit RandomRoad(const RandomRoadDescription& d);

    // After so much the table begins again [m].
    double period() const { return static_cast<double>(knots.size()) / per_meter; }

    // The spline and s(y) by their values and slopes: so none of their many products is with a partial that is zero.
    template <class N>
    N height(const N& x, const N& y) const {
        using V = std::decay_t<decltype(without_partials(x))>;
        const N fade = along.weight(x);
        const V position = (without_partials(x) - V(along.from)) * V(per_meter);
        const double at = value_of(position);
        if (knots.empty() || !(value_of(fade) > 0 && at < 1e15)) return N(0);  // beyond, a double has no place for it
        const auto knot = static_cast<std::int64_t>(at);
        const V u = position - V(static_cast<double>(knot));
        std::array<Knot, 4> k;
        const std::size_t first = static_cast<std::size_t>(knot) + knots.size() - 1;
        for (std::size_t i = 0; i < 4; ++i) k[i] = knots[(first + i) & (knots.size() - 1)];
        const auto common = spline(u, k[0].common, k[1].common, k[2].common, k[3].common);
        const auto different = spline(u, k[0].different, k[1].different, k[2].different, k[3].different);
        const auto side = across(V(without_partials(y) * V(1 / half_width)));
        const V sixth(1.0 / 6), per_x = V(per_meter) * sixth, per_y = V(1 / half_width) * sixth;
        const N found = chained(V((common.value + different.value * side.value) * sixth), x,
                                V((common.slope + different.slope * side.value) * per_x), y,
                                V(different.value * side.slope * per_y));
        return value_of(fade) == 1 ? found : fade * found;
    }
    // No height is above it [m].
    double highest() const {
        double most = 0;  // a B-spline stays between its coefficients, and s within 1.5
        for (const Knot& knot : knots) most = std::max(most, std::abs(knot.common) + 1.5 * std::abs(knot.different));
        return most;
    }

private:
    template <class V>
    struct Sloped {
        V value, slope;
    };

    // Six times the cubic B-spline between the middle two of four knots, u from 0 to 1.
    template <class V>
    static Sloped<V> spline(const V& u, double a, double b, double c, double d) {
        const V linear(3 * (c - a)), square(3 * (a - 2 * b + c)), cube(d - a + 3 * (b - c));
        return {V(a + 4 * b + c) + u * (linear + u * (square + u * cube)),
                linear + u * (V(2) * square + u * (V(3) * cube))};
    }

    // Straight between the tracks, then leveling off: constant from a track width beside the middle on.
    template <class V>
    static Sloped<V> across(const V& s) {
        const double beside = std::abs(value_of(s)), side = value_of(s) < 0 ? -1 : 1;
        if (beside <= 1) return {s, V(1)};
        if (!(beside < 2)) return {V(1.5 * side), V(0)};
        const V rest = V(2) - V(side) * s;
        return {V(side) * (V(1.5) - V(0.5) * rest * rest), rest};
    }
};

}  // namespace hamilcar
