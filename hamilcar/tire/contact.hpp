// Contact of a wheel with the road, and the interface between contact and tire model (docs/models/forces.md, "Tire contact").
//
// Everything is in chassis axes about the chassis origin; only the road's plane is transformed from ground axes. The depth
// of the disc's lowest point below the plane has the exact rate -n.v0, so the vertical spring is conservative at any camber.
#pragma once

#include <string_view>
#include <tuple>

#include "hamilcar/math/spatial.hpp"
#include "hamilcar/road/plane.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Input of a tire model.
template <class T>
struct TireContact {
    T depth, depth_rate;  // of the lowest point below the road [m, m/s]
    T v_sx, v_sy;         // slip velocities [m/s]
    T v_x;                // rolling speed of the carrier [m/s]
    T camber;             // sine of the inclination, positive with the top to the right [1]
    T omega;              // absolute spin rate [rad/s]
    T friction;           // the road's factor [1]
    T u, v;               // contact deflections, states [m]
};

// Output of a tire model.
template <class T>
struct TireForce {
    T Fx, Fy, Fz;      // [N]
    T elastic;         // the conservative part of Fz [N]
    T rolling_moment;  // about the spin axis [N m]
    T Mx, Mz;          // overturning and aligning, about the contact's longitudinal direction and normal [N m]
    T u_rate, v_rate;  // [m/s]
};

template <class T>
struct Deflection {
    T u, v;  // [m]
};

// Geometry of a disc on a plane.
template <class T>
struct ContactFrame {
    Vec3<T> point;  // P, on the road, at `depth` above the disc's lowest point [m]
    Vec3<T> longitudinal, lateral, normal;
    T depth;   // [m]
    T lever;   // r: of a longitudinal force about the spin axis [m]
    T camber;  // s = n.a [1]
};

// With s = n.a and c = sqrt(1 - s^2) the disc's lowest point lies at -R (n - s a) / c from the center and the longitudinal
// direction is a x n / c, so that a longitudinal force at P has the lever R - c depth about the axis a.
template <class T>
ContactFrame<T> contact_frame(const TangentPlane<T>& road, const Vec3<T>& center, const Vec3<T>& axis,
                              const T& radius) {
    const Vec3<T>& n = road.normal;
    const T s = n.dot(axis);
    const T cc = max(T(1) - s * s, T(1e-6));  // keeps the direction finite for a wheel lying flat
    const T c = sqrt(cc), inverse_c = over_root(T(1), cc), distance = radius * inverse_c;
    ContactFrame<T> f;
    f.normal = n;
    f.longitudinal = axis.cross(n) * inverse_c;
    f.lateral = n.cross(f.longitudinal);
    f.depth = radius * c - (n.dot(center) - road.offset);
    f.point = center + n * (f.depth - distance) + axis * (s * distance);
    f.lever = radius - c * f.depth;
    f.camber = s;
    return f;
}

}  // namespace hamilcar
