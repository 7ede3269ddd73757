// Tree joints: each places its child frame and gives one column of B per coordinate, in chassis axes about the origin
// (paper, section 2; (12)-(17), A.2). A column's rate seen from the chassis is v x column, v the motion of the frame that
// carries it; a joint adds its own columns to v in the order from the chassis outward.
//
// A joint provides: `coordinates`, `name`, `place(parent, q, B, first)` -> child Pose, writing columns `first...` of B,
// and `carry(v, B, rate, first, B_rate)` -> motion of its child frame, writing the rates of the same columns.
#pragma once

#include <string_view>

#include "hamilcar/linkage/frame.hpp"
#include "hamilcar/math/rotation.hpp"

namespace hamilcar {

// The first joint's axes do not move with respect to the chassis.
template <class T>
struct AtRest {};

template <class T, class Columns, class Rates>
HAMILCAR_CORE Spatial<T> carry_column(const AtRest<T>&, const Columns& B, const T& rate, int i, Rates& B_rate) {
    B_rate.col(i).setZero();
    return B.col(i) * rate;
}
template <class T, class Columns, class Rates>
HAMILCAR_CORE Spatial<T> carry_column(const Spatial<T>& v, const Columns& B, const T& rate, int i, Rates& B_rate) {
    B_rate.col(i) = cross_motion<T>(v, B.col(i));
    return v + B.col(i) * rate;
}

// Rotation q about an axis through a point; positive turns the child about +axis.  // (3), (12)-(14)
template <class T>
struct Revolute {
    static constexpr int coordinates = 1;
    static constexpr std::string_view name = "revolute";
    Vec3<T> point, axis;  // at design, in the parent

    template <class Parent, class Columns>
    HAMILCAR_CORE Pose<T> place(const Parent& parent, const T* q, Columns& B, int first) const {
        B.col(first) = rotation_column<T>(parent.point(point), parent.direction(axis));  // (14), A.2
        return turned(parent, axis_rotation(axis, q[0]), point);                         // (3), (4)
    }
    template <class Motion, class Columns, class Rates>
    HAMILCAR_CORE Spatial<T> carry(const Motion& v, const Columns& B, const T* rate, int first, Rates& B_rate) const {
        return carry_column(v, B, rate[0], first, B_rate);
    }
};

// Translation along an axis of the parent; the child has moved by q - reference.  // (7), (8)
template <class T>
struct Prismatic {
    static constexpr int coordinates = 1;
    static constexpr std::string_view name = "prismatic";
    Vec3<T> axis;  // at design, in the parent
    T reference;   // coordinate at design [m]

    template <class Parent, class Columns>
    HAMILCAR_CORE Pose<T> place(const Parent& parent, const T* q, Columns& B, int first) const {
        const Vec3<T> e = parent.direction(axis);
        B.col(first) = translation_column<T>(e);  // (17), A.2
        return shifted(parent, Vec3<T>(e * (q[0] - reference)));
    }
    template <class Motion, class Columns, class Rates>
    HAMILCAR_CORE Spatial<T> carry(const Motion& v, const Columns& B, const T* rate, int first, Rates& B_rate) const {
        return carry_column(v, B, rate[0], first, B_rate);
    }
};

// Three rotations about a common center. As in the paper the angles turn the *parent* relative to the child,
// R_child_parent = Ax(q1) Ay(q2) Az(q3) (5), so from the chassis outward the turns are -q3 about z, -q2 about y', -q1 about
// x'': the columns -(p x A2 D2 ; A2 D2) of A.2 come out with the constant axis z in the last one.
template <class T>
struct BryantSpherical {
    static constexpr int coordinates = 3;
    static constexpr std::string_view name = "spherical (Bryant angles)";
    Vec3<T> center;  // at design, in the parent

    template <class Parent, class Columns>
    HAMILCAR_CORE Pose<T> place(const Parent& parent, const T* q, Columns& B, int first) const {
        const BryantAngles<T> angles(Vec3<T>(q[0], q[1], q[2]));
        const Mat3<T> R = bryant_rotation(angles).transpose();  // (6)
        const auto& [s3, c3] = angles.z;
        const Vec3<T> p = parent.point(center);
        // -(p x A2 D2 ; A2 D2)  // (15), A.2
        B.col(first) = rotation_column<T>(p, parent.direction(-R.col(0)));
        B.col(first + 1) = rotation_column<T>(p, parent.direction(Vec3<T>(-s3, -c3, T(0))));
        B.col(first + 2) = rotation_column<T>(p, parent.direction(Vec3<T>(T(0), T(0), T(-1))));
        return turned(parent, R, center);
    }
    template <class Motion, class Columns, class Rates>
    HAMILCAR_CORE Spatial<T> carry(const Motion& v, const Columns& B, const T* rate, int first, Rates& B_rate) const {
        const Spatial<T> turned_z = carry_column(v, B, rate[2], first + 2, B_rate);
        const Spatial<T> turned_y = carry_column(turned_z, B, rate[1], first + 1, B_rate);
        return carry_column(turned_y, B, rate[0], first, B_rate);
    }
};

}  // namespace hamilcar
