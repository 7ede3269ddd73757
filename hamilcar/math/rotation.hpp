// Rotations: the paper's Bryant angles, an axis and an angle, and the unit quaternion. R_AB takes components in B to A.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

// Sines and cosines of three Bryant angles (x, then y', then z''), shared by everything that needs them.
template <class T>
struct BryantAngles {
    SineCosine<T> x, y, z;
    explicit BryantAngles(const Vec3<T>& angles) : x(sincos(angles[0])), y(sincos(angles[1])), z(sincos(angles[2])) {}
};

// A = Ax(q1) Ay(q2) Az(q3)  // (1), (2), (5)
template <class T>
Mat3<T> bryant_rotation(const BryantAngles<T>& q) {
    const auto& [s1, c1] = q.x;
    const auto& [s2, c2] = q.y;
    const auto& [s3, c3] = q.z;
    const T s1s2 = s1 * s2, c1s2 = c1 * s2;
    Mat3<T> A;
    A << c2 * c3, -c2 * s3, s2,                              //
        s1s2 * c3 + c1 * s3, c1 * c3 - s1s2 * s3, -s1 * c2,  //
        s1 * s3 - c1s2 * c3, c1s2 * s3 + s1 * c3, c1 * c2;
    return A;
}

// The angles of a rotation matrix, with q2 within +-90 degrees; for initial states and channels, not for a step.
template <class T>
Vec3<T> bryant_angles(const Mat3<T>& A) {
    return {std::atan2(-A(1, 2), A(2, 2)), std::asin(clamp(A(0, 2), T(-1), T(1))), std::atan2(-A(0, 1), A(0, 0))};
}

// D with omega = D (q1', q2', q3'), omega in the axes the angles start from.  // (9)
template <class T>
Mat3<T> bryant_rate_matrix(const BryantAngles<T>& q) {
    const auto& [s1, c1] = q.x;
    const auto& [s2, c2] = q.y;
    Mat3<T> D;
    D << T(1), T(0), s2,     //
        T(0), c1, -s1 * c2,  //
        T(0), s1, c1 * c2;
    return D;
}

// Rotation by `angle` [rad] about the unit vector `axis`.  // A.1
template <class T>
Mat3<T> axis_rotation(const Vec3<T>& axis, const T& angle) {
    const auto [s, c] = sincos(angle);
    const Vec3<T> su = s * axis, vu = (T(1) - c) * axis;
    const T xy = vu[0] * axis[1], xz = vu[0] * axis[2], yz = vu[1] * axis[2];
    Mat3<T> R;
    R << vu[0] * axis[0] + c, xy - su[2], xz + su[1],  //
        xy + su[2], vu[1] * axis[1] + c, yz - su[0],   //
        xz - su[1], yz + su[0], vu[2] * axis[2] + c;
    return R;
}

// Rotation matrix of a quaternion (w, x, y, z) of any length: orthonormal even when the length has drifted between steps.
template <class T>
Mat3<T> quaternion_rotation(const Vector<T, 4>& q) {
    const T scale = T(2) / q.squaredNorm();
    const T w = q[0] * scale, x = q[1] * scale, y = q[2] * scale, z = q[3] * scale;
    const T xx = q[1] * x, yy = q[2] * y, zz = q[3] * z, xy = q[1] * y, xz = q[1] * z, yz = q[2] * z;
    const T wx = w * q[1], wy = w * q[2], wz = w * q[3];
    Mat3<T> R;
    R << T(1) - (yy + zz), xy - wz, xz + wy,  //
        xy + wz, T(1) - (xx + zz), yz - wx,   //
        xz - wy, yz + wx, T(1) - (xx + yy);
    return R;
}

// q' = q (0, omega) / 2, omega in body axes [rad/s].
template <class T>
Vector<T, 4> quaternion_rate(const Vector<T, 4>& q, const Vec3<T>& omega) {
    const Vec3<T> half = omega * T(0.5);
    return {-(q[1] * half[0] + q[2] * half[1] + q[3] * half[2]),  //
            q[0] * half[0] + q[2] * half[2] - q[3] * half[1],     //
            q[0] * half[1] + q[3] * half[0] - q[1] * half[2],     //
            q[0] * half[2] + q[1] * half[1] - q[2] * half[0]};
}

}  // namespace hamilcar
