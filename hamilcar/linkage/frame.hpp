// Pose of a suspension's frame in the chassis. Frames are chosen so that at design every pose is the identity:
// hardpoints of any body are then simply vehicle coordinates, and no joint needs alignment matrices C_ij (3).
#pragma once

#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

// Transforms body coordinates X to chassis coordinates R X + p.
template <class T>
struct Pose {
    Mat3<T> R;
    Vec3<T> p;
    Vec3<T> point(const Vec3<T>& X) const { return R * X + p; }
    Vec3<T> direction(const Vec3<T>& u) const { return R * u; }
};

// The same pose by a point: `mark`, a point of the frame at design, is now at `at`.
template <class T>
struct Placement {
    Mat3<T> R;
    Vec3<T> at, mark;
    Vec3<T> point(const Vec3<T>& X) const { return at + R * Vec3<T>(X - mark); }
    Vec3<T> direction(const Vec3<T>& u) const { return R * u; }
    Pose<T> pose() const { return {R, at - R * mark}; }
};

}  // namespace hamilcar
