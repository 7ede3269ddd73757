// A line is anything with a length that springs and dampers act along: its length, how the independent coordinates
// change it, and what the drift x adds. A generalized force follows by virtual work: F dl/dV.
#pragma once

#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

template <class T, int nV>
struct Line {
    T length;                // [m]
    Vector<T, nV> gradient;  // dl/dV
    T drift;                 // part of the length's rate that is there at V' = 0 [m/s]
    T rate(const Vector<T, nV>& V_rate) const { return gradient.dot(V_rate) + drift; }
};

// A line of force along the unit vector n through the carrier's point p, all in chassis axes.  // (44)
template <class T, class Position>
auto line_through(const T& length, const Vec3<T>& p, const Vec3<T>& n, const Position& at) {
    constexpr int nV = std::decay_t<decltype(at.J)>::ColsAtCompileTime;
    Line<T, nV> line;
    line.length = length;
    for (int j = 0; j < nV; ++j) line.gradient[j] = n.dot(velocity_at<T>(at.J.col(j), p));
    line.drift = Position::drifts ? n.dot(velocity_at<T>(at.x, p)) : T(0);
    return line;
}

// From a point of the chassis to a point of the carrier.
template <class T>
struct PointLine {
    Vec3<T> chassis_point, carrier_point;  // at design
    static constexpr auto members() { return std::tuple(&PointLine::chassis_point, &PointLine::carrier_point); }

    template <class Position>
    auto operator()(const Position& at, const T*) const {
        const Vec3<T> p = at.pose.point(carrier_point), d = p - chassis_point;
        const T square = d.squaredNorm();
        return line_through<T>(sqrt(square), p, Vec3<T>(d * over_root(T(1), square)), at);
    }
};

// Along an independent coordinate that is itself a length.
template <class T, int coordinate>
struct CoordinateLine {
    template <class Position>
    auto operator()(const Position& at, const T* V) const {
        constexpr int nV = std::decay_t<decltype(at.J)>::ColsAtCompileTime;
        return Line<T, nV>{V[coordinate], Vector<T, nV>::Unit(coordinate), T(0)};
    }
};

}  // namespace hamilcar
