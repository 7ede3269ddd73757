// The elementary rotations of the paper, section 2.2, and the rate matrix D of Bryant angles with its time derivative.
#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace hamilcar::paper {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

// The tilde of the paper: skew(a) b = a x b.
inline Matrix3 skew(const Vector3& a) {
    Matrix3 tilde;
    tilde << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return tilde;
}

inline Matrix3 A_x(double q) {
    Matrix3 A;
    A << 1, 0, 0, 0, std::cos(q), -std::sin(q), 0, std::sin(q), std::cos(q);  // (2)
    return A;
}

inline Matrix3 A_y(double q) {
    Matrix3 A;
    A << std::cos(q), 0, std::sin(q), 0, 1, 0, -std::sin(q), 0, std::cos(q);  // (2)
    return A;
}

inline Matrix3 A_z(double q) {
    Matrix3 A;
    A << std::cos(q), -std::sin(q), 0, std::sin(q), std::cos(q), 0, 0, 0, 1;  // (2)
    return A;
}

// Angular velocity per rate of the Bryant angles (x, y, z), in the axes that the first rotation starts from.
inline Matrix3 D(double x, double y) {
    Matrix3 D;
    D.col(0) << 1, 0, 0;
    D.col(1) << 0, std::cos(x), std::sin(x);
    D.col(2) << std::sin(y), -std::sin(x) * std::cos(y), std::cos(x) * std::cos(y);  // (9), (15)
    return D;
}

inline Matrix3 D_dot(double x, double y, double x_dot, double y_dot) {
    Matrix3 D_dot;
    D_dot.col(0).setZero();
    D_dot.col(1) << 0, -std::sin(x) * x_dot, std::cos(x) * x_dot;
    D_dot.col(2) << std::cos(y) * y_dot, -std::cos(x) * std::cos(y) * x_dot + std::sin(x) * std::sin(y) * y_dot,
        -std::sin(x) * std::cos(y) * x_dot - std::cos(x) * std::sin(y) * y_dot;
    return D_dot;
}

}  // namespace hamilcar::paper
