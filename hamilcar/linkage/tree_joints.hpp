// Tree joints: each places its child frame and gives one column of B per coordinate, in chassis axes (paper, section 2;
// (12)-(17), A.2). Columns are motions about the linkage's anchor, the point of its first joint: there that joint's columns
// have no linear part, and the compiler knows (motion.hpp).
//
// A joint provides: `coordinates`, `name`, `outward` (its coordinates in the order from the chassis outward), `point` where
// it has one, and `place(parent, q, anchor)` -> the child's pose and the columns.
#pragma once

#include <string_view>
#include <tuple>

#include "hamilcar/linkage/frame.hpp"
#include "hamilcar/math/motion.hpp"
#include "hamilcar/math/rotation.hpp"

namespace hamilcar {

template <class T, class... Column>
struct PlacedJoint {
    Pose<T> child;
    std::tuple<Column...> columns;
};

// Unit rotation about axis e through `point`: (p x e ; e).  // A.2
template <class T>
Turn<T> rotation_about(const ChassisFrame<T>&, const Vec3<T>&, const Vec3<T>& e, const Vec3<T>&) {
    return {{}, e};  // the first joint stands on the anchor
}
template <class T>
Screw<T> rotation_about(const Pose<T>& parent, const Vec3<T>& point, const Vec3<T>& e, const Vec3<T>& anchor) {
    const Vec3<T> direction = parent.direction(e), p = parent.point(point) - anchor;
    return {p.cross(direction), direction};
}

// Rotation q about an axis through a point; positive turns the child about +axis.  // (3), (12)-(14)
template <class T>
struct Revolute {
    static constexpr int coordinates = 1;
    static constexpr std::array<int, 1> outward{0};
    static constexpr std::string_view name = "revolute";
    Vec3<T> point, axis;  // at design, in the parent
    static constexpr auto members() { return std::tuple(&Revolute::point, &Revolute::axis); }

    template <class Parent>
    auto place(const Parent& parent, const T* q, const Vec3<T>& anchor) const {
        const auto column = rotation_about(parent, point, axis, anchor);  // (14), A.2
        return PlacedJoint<T, std::decay_t<decltype(column)>>{turned(parent, axis_rotation(axis, q[0]), point),
                                                              {column}};  // (3), (4)
    }
};

// Translation along an axis of the parent; the child has moved by q - reference.  // (7), (8)
template <class T>
struct Prismatic {
    static constexpr int coordinates = 1;
    static constexpr std::array<int, 1> outward{0};
    static constexpr std::string_view name = "prismatic";
    Vec3<T> axis;  // at design, in the parent
    T reference;   // coordinate at design [m]
    static constexpr auto members() { return std::tuple(&Prismatic::axis, &Prismatic::reference); }

    template <class Parent>
    PlacedJoint<T, Slide<T>> place(const Parent& parent, const T* q, const Vec3<T>&) const {
        const Vec3<T> e = parent.direction(axis);
        return {shifted(parent, Vec3<T>(e * (q[0] - reference))), {Slide<T>{e, {}}}};  // (17), A.2
    }
};

// Three rotations about a common center. As in the paper the angles turn the *parent* relative to the child,
// R_child_parent = Ax(q1) Ay(q2) Az(q3) (5), so from the chassis outward the turns are -q3 about z, -q2 about y', -q1 about
// x'': the columns -(p x A2 D2 ; A2 D2) of A.2 come out with the constant axis z in the last one.
template <class T>
struct BryantSpherical {
    static constexpr int coordinates = 3;
    static constexpr std::array<int, 3> outward{2, 1, 0};
    static constexpr std::string_view name = "spherical (Bryant angles)";
    Vec3<T> point;  // the center at design, in the parent
    static constexpr auto members() { return std::tuple(&BryantSpherical::point); }

    template <class Parent>
    auto place(const Parent& parent, const T* q, const Vec3<T>& anchor) const {
        const BryantAngles<T> angles(Vec3<T>(q[0], q[1], q[2]));
        const Mat3<T> R = bryant_rotation(angles).transpose();  // (6)
        const auto& [s3, c3] = angles.z;
        const auto about = [&](const Vec3<T>& axis) { return rotation_about(parent, point, axis, anchor); };
        using Turning = std::decay_t<decltype(about(point))>;
        return PlacedJoint<T, Turning, Turning, Turning>{
            turned(parent, R, point),  // -(p x A2 D2 ; A2 D2)  // (15), A.2
            {about(-R.col(0)), about(Vec3<T>(-s3, -c3, T(0))), about(Vec3<T>(T(0), T(0), T(-1)))}};
    }
};

}  // namespace hamilcar
