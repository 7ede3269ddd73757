// Where a frame of the spoke stands in the chassis. Frames are placed so that at design every pose is the identity:
// hardpoints of any body are then simply vehicle coordinates, and no joint needs alignment matrices C_ij (3).
#pragma once

#include "hamilcar/math/spatial.hpp"

namespace hamilcar {

// Takes body coordinates X to chassis coordinates R X + p.
template <class T>
struct Pose {
    Mat3<T> R;
    Vec3<T> p;
    Vec3<T> point(const Vec3<T>& X) const { return R * X + p; }
    Vec3<T> direction(const Vec3<T>& u) const { return R * u; }
};

// The chassis itself: the identity, known as such while compiling.
template <class T>
struct ChassisFrame {
    const Vec3<T>& point(const Vec3<T>& X) const { return X; }
    const Vec3<T>& direction(const Vec3<T>& u) const { return u; }
};

// The frame that turns by R_parent_child about the point `center`, fixed in both.
template <class T>
Pose<T> turned(const ChassisFrame<T>&, const Mat3<T>& R, const Vec3<T>& center) {
    return {R, center - R * center};
}
template <class T>
Pose<T> turned(const Pose<T>& parent, const Mat3<T>& R, const Vec3<T>& center) {
    const Mat3<T> R_CB = parent.R * R;
    return {R_CB, parent.point(center) - R_CB * center};
}

// The frame that is shifted by `shift`, given in chassis axes.
template <class T>
Pose<T> shifted(const ChassisFrame<T>&, const Vec3<T>& shift) {
    return {Mat3<T>::Identity(), shift};
}
template <class T>
Pose<T> shifted(const Pose<T>& parent, const Vec3<T>& shift) {
    return {parent.R, parent.p + shift};
}

}  // namespace hamilcar
