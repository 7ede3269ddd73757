// A random road of an ISO 8608 class: two tracks side by side, made once as a table of harmonics with random phases
// and read back by a cubic B-spline, so that even the curvature is continuous. Height = c(x) + d(x) s(y), where s
// goes from -1 at the right track to 1 at the left one.
//
// An isotropic surface with the spectrum n^-2 along any line has tracks with the coherence gamma = k b K_1(k b), k =
// 2 pi n, b between them. So c has the spectrum G (1 + gamma)/2 and d has G (1 - gamma)/2; either harmonic of d is a
// quarter wave before or behind that of c, by chance: then both tracks have the spectrum G in every harmonic and not
// only on average.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hamilcar/road/obstacle.hpp"

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

    template <class N>
    N height(const N& x, const N& y) const {
        const N fade = along.weight(x);
        const N position = (x - N(along.from)) * N(per_meter);
        const double at = value_of(position);
        if (knots.empty() || !(value_of(fade) > 0 && at < 1e15)) return N(0);  // beyond, a double has no place for it
        const auto knot = static_cast<std::int64_t>(at);
        const N u = position - N(static_cast<double>(knot));
        std::array<Knot, 4> k;
        const std::size_t first = static_cast<std::size_t>(knot) + knots.size() - 1;
        for (std::size_t i = 0; i < 4; ++i) k[i] = knots[(first + i) & (knots.size() - 1)];
        const N common = spline(u, k[0].common, k[1].common, k[2].common, k[3].common);
        const N different = spline(u, k[0].different, k[1].different, k[2].different, k[3].different);
        return fade * N(1.0 / 6) * (common + different * across(y));
    }

private:
    // Six times the cubic B-spline between the middle two of four knots, u from 0 to 1.
    template <class N>
    static N spline(const N& u, double a, double b, double c, double d) {
        return N(a + 4 * b + c) + u * (N(3 * (c - a)) + u * (N(3 * (a - 2 * b + c)) + u * N(d - a + 3 * (b - c))));
    }

    // Straight between the tracks, then leveling off: constant from a track width beside the middle on.
    template <class N>
    N across(const N& y) const {
        const N s = y * N(1 / half_width);
        const double beside = value_of(abs(s)), side = value_of(s) < 0 ? -1 : 1;
        if (beside <= 1) return s;
        if (!(beside < 2)) return N(1.5 * side);
        const N rest = N(2) - N(side) * s;
        return N(side) * (N(1.5) - N(0.5) * rest * rest);
    }
};

}  // namespace hamilcar
