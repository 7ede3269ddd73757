// Cleats, steps, potholes and speed bumps: a height over a rectangle with raised-cosine ramps, single or repeated. Also the smooth
// step and the range with smooth edges, which limit the other elements of a road.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/description/road.hpp"
#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

// From 0 for u <= 0 to 1 for u >= 1 as half a raised cosine, (1 - cos(pi u))/2: the slope is continuous.
template <class N>
N smooth_step(const N& u) {
    const double at = value_of(u);
    if (at <= 0) return N(0);
    if (at >= 1) return N(1);
    const N s = sincos(N(u * N(std::numbers::pi / 2))).sine;
    return s * s;
}

// A range with ramps inside its edges. A ramp is limited to half the range.
struct SmoothRange {
    double from = -everywhere, to = everywhere;  // [m]
    double ramp = 1;                             // [m]

    SmoothRange() = default;
    SmoothRange(double first, double last, double edge)
        : from(first), to(last), ramp(std::min(std::max(edge, min_ramp), (last - first) / 2)) {}

    // 1 within, 0 outside.
    template <class N>
    N weight(const N& at) const {
        const double position = value_of(at);
        const double rising = position - from, falling = to - position;  // may be infinite, so not in N
        const double inside = std::min(rising, falling);
        if (!(inside > 0)) return N(0);
        if (inside >= ramp) return N(1);
        return smooth_step(N((rising < falling ? at - N(from) : N(to) - at) * N(1 / ramp)));
    }
    // Whether the weight is 1.
    bool is_whole(double position) const { return std::min(position - from, to - position) >= ramp; }

private:
    static constexpr double min_ramp = 1e-9;  // a sharp edge is a very steep ramp [m]
};

struct Obstacle {
    SmoothRange along, across;  // the first of the row
    double rise = 0;            // [m]
    double pitch = 0;           // from one to the next [m]
    double last = 0;            // index of the last

    Obstacle() = default;
    explicit Obstacle(const ObstacleDescription& d)
        : along(d.start, d.start + d.length, d.shape == ObstacleShape::hump ? d.length / 2 : d.ramp),
          across(d.right, d.left, d.side_ramp),
          rise(d.height),
          pitch(std::max(d.repeat_every, d.length)),
          last(std::max(d.count, 1) - 1) {}

    template <class N>
    N height(const N& x, const N& y) const {
        N weight;
        if (last > 0) {
            const double number = std::floor((value_of(x) - along.from) / pitch);
            weight = along.weight(N(x - N(pitch * std::min(std::max(number, 0.0), last))));
        } else {
            weight = along.weight(x);
        }
        if (value_of(weight) == 0) return N(0);
        return weight * across.weight(y) * N(rise);
    }
    double max_height() const { return std::max(rise, 0.0); }  // [m]
};

}  // namespace hamilcar
