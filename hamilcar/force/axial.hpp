// Forces along a line or a travel: spring, damper, stop. Positive pushes the line's ends apart (docs/models/forces.md).
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <tuple>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
struct Spring {
    T rate, force_at_design, design_length;
    static constexpr auto members() {
        return std::tuple(&Spring::rate, &Spring::force_at_design, &Spring::design_length);
    }

    T force(const T& length) const { return force_at_design + rate * (design_length - length); }
    // Energy relative to the design length [J].
    T potential(const T& length) const {
        const T compressed = design_length - length;
        return compressed * (force_at_design + T(0.5) * rate * compressed);
    }
};

// Piecewise linear through its points, as a sum of clamped ramps: no search, no branch on the velocity.
template <class T>
struct Damper {
    static constexpr std::size_t max_segments = 8;
    T slope_below{0}, slope_above{0};  // outside the points [N s/m]
    T first{0}, last{0};               // outer velocities [m/s]
    T force_at_first{0};               // [N]
    int segments = 0;
    std::array<T, max_segments> start{}, end{}, slope{};
    static constexpr auto members() {
        return std::tuple(&Damper::slope_below, &Damper::slope_above, &Damper::first, &Damper::last,
                          &Damper::force_at_first, &Damper::segments, &Damper::start, &Damper::end, &Damper::slope);
    }

    Damper() = default;
    // No points: no damper. Throws std::length_error for more than eight segments.
    explicit Damper(const DamperDescription& d) {
        if (d.velocity.size() < 2) return;
        const std::size_t count = d.velocity.size() - 1;
        if (count > max_segments) throw std::length_error("a damper curve has at most 9 points");
        segments = static_cast<int>(count);
        for (std::size_t i = 0; i < count; ++i) {
            start[i] = T(d.velocity[i]), end[i] = T(d.velocity[i + 1]);
            slope[i] = T((d.force[i + 1] - d.force[i]) / (d.velocity[i + 1] - d.velocity[i]));
        }
        first = start[0], last = end[count - 1];
        force_at_first = T(d.force.front());
        slope_below = slope[0], slope_above = slope[count - 1];
    }

    // Force at a rate of extension [m/s].
    T force(const T& rate) const {
        T resisting = force_at_first + slope_below * min(rate - first, T(0)) + slope_above * max(rate - last, T(0));
        for (int i = 0; i < segments; ++i) resisting += slope[i] * (clamp(rate, start[i], end[i]) - start[i]);
        return -resisting;
    }
};

// Resists `travel` beyond the gap; both stops of a suspension use it, with the sign of the travel reversed for rebound.
template <class T>
struct Stop {
    T gap, rate, progression;
    static constexpr auto members() { return std::tuple(&Stop::gap, &Stop::rate, &Stop::progression); }

    T force(const T& travel) const {
        const T x = max(travel - gap, T(0));
        return -x * (rate + progression * x);
    }
    T potential(const T& travel) const {
        const T x = max(travel - gap, T(0));
        return x * x * (T(0.5) * rate + progression * x * T(1.0 / 3));
    }
};

}  // namespace hamilcar
