// A plane road through the ground origin: flat, graded or banked.
#pragma once

#include <tuple>

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// The road under a wheel: points x with normal.x = offset, in chassis axes.
template <class T>
struct TangentPlane {
    Vec3<T> normal;  // unit, upward
    T offset;        // [m]
    T friction;      // factor on the tire's friction [1]
};

template <class T>
struct PlaneRoad {
    Vec3<T> normal;  // ground axes, unit
    T friction;
    static constexpr auto members() { return std::tuple(&PlaneRoad::normal, &PlaneRoad::friction); }

    PlaneRoad() = default;
    // Rise over run along ground x and y.
    PlaneRoad(const T& grade, const T& bank, const T& friction_factor) : friction(friction_factor) {
        const T scale = T(1) / sqrt(T(1) + grade * grade + bank * bank);
        normal = {-grade * scale, -bank * scale, scale};
    }

    // The plane in the axes of a chassis at position r with orientation R_GC.
    TangentPlane<T> seen_from(const Vec3<T>& r, const Mat3<T>& R_GC) const {
        return {R_GC.transpose() * normal, -normal.dot(r), friction};
    }
};

}  // namespace hamilcar
