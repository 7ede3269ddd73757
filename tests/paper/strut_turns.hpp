// From the paper's angles of a strut to those of the linkage. Both turn about the strut's top, the paper's q1, q2, q3
// the chassis against the spindle about x, y', z'' (5), the linkage's the spindle against the chassis about z, x', y''.
// The fourth coordinate is the strut's length in the paper, in the linkage what it has grown since design.
#pragma once

#include "paper/literal_rotation.hpp"

namespace hamilcar::paper {

// Orientation of the spindle in the chassis.
inline Matrix3 spindle_orientation(const Vector3& q) {
    return (A_x(q[0]) * A_y(q[1]) * A_z(q[2])).transpose();  // (5), (6)
}

// The linkage's angles: R = A_z A_x A_y.
inline Vector3 linkage_angles(const Matrix3& R) {
    return {std::atan2(-R(0, 1), R(1, 1)), std::asin(R(2, 1)), std::atan2(-R(2, 0), R(2, 2))};
}

// The linkage's rates per those of the paper: both are the spindle's angular velocity in the chassis.
inline Matrix3 linkage_rates(const Vector3& q) {
    const Matrix3 R = spindle_orientation(q);
    const Vector3 angles = linkage_angles(R);
    Matrix3 turning;
    turning << Vector3::UnitZ(), A_z(angles[0]) * Vector3::UnitX(), A_z(angles[0]) * A_x(angles[1]) * Vector3::UnitY();
    return turning.inverse() * -R * D(q[0], q[1]);  // (15)
}

}  // namespace hamilcar::paper
