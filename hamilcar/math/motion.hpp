// Motions that know while compiling which half of them is zero. About a point on its axis a rotation has no linear part,
// a translation never has an angular one; a linkage whose first joint passes through the reference point consists mostly
// of such halves, and arithmetic with zeros is never done.
#pragma once

#include <type_traits>

#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

// A vector, or a number, that is zero: what is added to it or multiplied by it costs nothing.
struct Zero {};

template <class A, class B>
auto add(const A& a, const B& b) {
    if constexpr (std::is_same_v<A, Zero>) {
        return b;
    } else if constexpr (std::is_same_v<B, Zero>) {
        return a;
    } else {
        return A(a + b);
    }
}
template <class A, class B>
auto cross(const A& a, const B& b) {
    if constexpr (std::is_same_v<A, Zero> || std::is_same_v<B, Zero>) {
        return Zero{};
    } else {
        return A(a.cross(b));
    }
}
template <class A, class B>
auto dot(const A& a, const B& b) {
    if constexpr (std::is_same_v<A, Zero> || std::is_same_v<B, Zero>) {
        return Zero{};
    } else {
        return a.dot(b);
    }
}
template <class A, class T>
auto times(const A& a, const T& factor) {
    if constexpr (std::is_same_v<A, Zero>) {
        return Zero{};
    } else {
        return A(a * factor);
    }
}
template <class T, class A>
Vec3<T> as_vector(const A& a) {
    if constexpr (std::is_same_v<A, Zero>) {
        return Vec3<T>::Zero();
    } else {
        return a;
    }
}

// (linear ; angular) about a reference point; each half a Vec3<T> or Zero.
template <class Linear, class Angular>
struct Motion {
    Linear linear;
    Angular angular;
};
using Rest = Motion<Zero, Zero>;
template <class T>
using Turn = Motion<Zero, Vec3<T>>;  // about an axis through the reference point
template <class T>
using Slide = Motion<Vec3<T>, Zero>;
template <class T>
using Screw = Motion<Vec3<T>, Vec3<T>>;

template <class L1, class A1, class L2, class A2>
auto sum(const Motion<L1, A1>& a, const Motion<L2, A2>& b) {
    const auto linear = add(a.linear, b.linear);
    const auto angular = add(a.angular, b.angular);
    return Motion<std::decay_t<decltype(linear)>, std::decay_t<decltype(angular)>>{linear, angular};
}

template <class L, class A, class T>
Motion<L, A> scaled(const Motion<L, A>& m, const T& rate) {
    return {times(m.linear, rate), times(m.angular, rate)};
}

// v x m: the rate of a motion m that v carries along.
template <class L1, class A1, class L2, class A2>
auto carried(const Motion<L1, A1>& v, const Motion<L2, A2>& m) {
    const auto linear = add(cross(v.angular, m.linear), cross(v.linear, m.angular));
    const auto angular = cross(v.angular, m.angular);
    return Motion<std::decay_t<decltype(linear)>, std::decay_t<decltype(angular)>>{linear, angular};
}

// Velocity that a motion gives to the point p.  // (10)
template <class L, class A, class T>
auto velocity_of(const Motion<L, A>& m, const Vec3<T>& p) {
    return add(m.linear, cross(m.angular, p));
}

// The same motion about the point O from which the present reference point is seen at p_OA.
template <class T, class L, class A>
Spatial<T> referred(const Motion<L, A>& m, const Vec3<T>& p_OA) {
    return spatial<T>(as_vector<T>(add(m.linear, cross(p_OA, m.angular))), as_vector<T>(m.angular));
}

}  // namespace hamilcar
