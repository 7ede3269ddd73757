// Roads whose shape and heights are known in closed form.
#pragma once

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "hamilcar/road/crg_road.hpp"

namespace hamilcar::test {

using RoadFunction = std::function<double(double, double)>;

inline void fill(CrgDescription& d, std::size_t rows, const RoadFunction& z) {
    for (std::size_t i = 0; i < rows; ++i)
        for (const double v : d.v) d.heights.push_back(z(d.u_start + static_cast<double>(i) * d.u_increment, v));
}

// Straight along ground x from the origin, 4 m long, 1 m apart, v = -1, 0, 2.
inline CrgDescription straight(const RoadFunction& z) {
    CrgDescription d;
    d.u_increment = 1;
    d.v = {-1, 0, 2};
    fill(d, 5, z);
    return d;
}

// Samples on a circle about (0, radius), from the origin along ground x to the left; to the right if the radius is
// negative.
struct Arc {
    double radius, chord;
    std::size_t rows;
    double turn() const { return 2 * std::asin(chord / 2 / radius); }  // from sample to sample [rad]

    CrgDescription description(std::vector<double> v, const RoadFunction& z) const {
        CrgDescription d;
        d.u_increment = chord;
        for (std::size_t i = 0; i + 1 < rows; ++i) d.headings.push_back((static_cast<double>(i) + 0.5) * turn());
        d.v = std::move(v);
        fill(d, rows, z);
        return d;
    }
    // The point at a part of a segment and at v from its chord, by the circle: the cross sections are its radii.
    CrgPoint at(std::size_t segment, double part, double v) const {
        const double half = turn() / 2, middle = (2 * static_cast<double>(segment) + 1) * half;
        const double from_center = radius * std::cos(half) - v;  // to the chord's parallel, along the segment's normal
        const double along = (2 * part - 1) * from_center * std::tan(half);
        return {from_center * std::sin(middle) + along * std::cos(middle),
                radius - from_center * std::cos(middle) + along * std::sin(middle)};
    }
};

inline double ramp(double u, double v) {
    return 0.1 * u + 0.01 * v;
}

}  // namespace hamilcar::test
