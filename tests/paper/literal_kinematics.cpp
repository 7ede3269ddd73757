// Positions, velocities and the matrix B of the tree, section 2 and A.1, A.2 of the paper, with dB/dt written out.
#include "paper/literal.hpp"

namespace hamilcar::paper {
namespace {

// First coordinate of a spindle (q1 or q5) and its row in qdot.
int first_angle(int spindle) {
    return spindle == 2 ? 1 : 5;
}
int first_row(int body) {
    return column_of_body[static_cast<std::size_t>(body - 1)];
}

}  // namespace

std::array<Pose, 5> LiteralCar::poses(const Coordinates& q) const {
    std::array<Pose, 5> pose;
    const Matrix3 A_1 = A_x(q(14)) * A_y(q(15)) * A_z(q(16));  // (1)
    const Vector3 r_1(q(11), q(12), q(13));
    pose[0] = {A_1, r_1};
    for (const int j : {2, 3}) {
        const Strut& c = strut(j);
        const int i = first_angle(j);
        const Matrix3 A_21 = A_x(q(i)) * A_y(q(i + 1)) * A_z(q(i + 2));      // (5), A.1
        const Matrix3 A_2 = A_1 * A_21.transpose();                          // (6)
        const Vector3 d_21_1 = A_2 * c.h_21 * q(i + 3);                      // (8)
        const Vector3 r_2 = r_1 + A_1 * c.s_12_1 - d_21_1 - A_2 * c.s_21_1;  // (7)
        pose[static_cast<std::size_t>(j - 1)] = {A_2, r_2};
    }
    for (const int j : {4, 5}) {
        const Arm& c = arm(j);
        const Matrix3 A_41 = A_z(q(j + 5));                                        // A.1
        const Matrix3 A_4 = A_1 * c.C_14 * A_41.transpose() * c.C_41.transpose();  // (3)
        const Vector3 r_4 = r_1 + A_1 * c.s_14 - A_4 * c.s_41;                     // (4)
        pose[static_cast<std::size_t>(j - 1)] = {A_4, r_4};
    }
    return pose;
}

std::array<Twist, 5> LiteralCar::twists(const Coordinates& q, const Vector& qdot) const {
    const std::array<Pose, 5> pose = poses(q);
    std::array<Twist, 5> twist;
    const Matrix3& A_1 = pose[0].A;
    const Vector3 r_1_dot = qdot.segment<3>(0);
    const Vector3 omega_1 = D(q(14), q(15)) * qdot.segment<3>(3);  // (9)
    twist[0] = {r_1_dot, omega_1};
    for (const int j : {2, 3}) {
        const Strut& c = strut(j);
        const int i = first_angle(j), row = first_row(j);
        const Matrix3& A_2 = pose[static_cast<std::size_t>(j - 1)].A;
        const Matrix3 D_2 = D(q(i), q(i + 1));
        const Vector3 omega_2 = omega_1 - A_2 * D_2 * qdot.segment<3>(row);  // (15)
        const Vector3 s_12_1 = A_1 * c.s_12_1, s_21_1 = A_2 * c.s_21_1, h_21 = A_2 * c.h_21;
        const Vector3 r_2_dot =
            r_1_dot + omega_1.cross(s_12_1) - omega_2.cross(h_21 * q(i + 3) + s_21_1) - h_21 * qdot[row + 3];  // (16)
        twist[static_cast<std::size_t>(j - 1)] = {r_2_dot, omega_2};
    }
    for (const int j : {4, 5}) {
        const Arm& c = arm(j);
        const Matrix3& A_4 = pose[static_cast<std::size_t>(j - 1)].A;
        const Vector3 u_41 = A_4 * c.C_41.col(2);
        const Vector3 omega_4 = omega_1 - u_41 * qdot[first_row(j)];                                  // (12)
        const Vector3 r_4_dot = r_1_dot + omega_1.cross(A_1 * c.s_14) - omega_4.cross(A_4 * c.s_41);  // (13)
        twist[static_cast<std::size_t>(j - 1)] = {r_4_dot, omega_4};
    }
    return twist;
}

Matrix LiteralCar::B_j(int body, const Coordinates& q) const {
    const std::array<Pose, 5> pose = poses(q);
    const auto& [A_1, r_1] = pose[0];
    const auto& [A_j, r_j] = pose[static_cast<std::size_t>(body - 1)];
    Matrix B = Matrix::Zero(6, columns_of_body[static_cast<std::size_t>(body - 1)]);
    if (body == 1) {
        const Matrix3 D_1 = D(q(14), q(15));
        B << Matrix3::Identity(), skew(r_1) * D_1, Matrix3::Zero(), D_1;  // A.2
    } else if (body <= 3) {
        const int i = first_angle(body);
        const Matrix3 A_D = A_j * D(q(i), q(i + 1));
        const Vector3 s_12_1 = A_1 * strut(body).s_12_1, h_21 = A_j * strut(body).h_21;
        B << -skew(r_1 + s_12_1) * A_D, -h_21, -A_D, Vector3::Zero();  // A.2
    } else {
        const Vector3 s_41 = A_j * arm(body).s_41, u_41 = A_j * arm(body).C_41.col(2);
        B << -skew(r_j + s_41) * u_41, -u_41;  // A.2
    }
    return B;
}

Matrix LiteralCar::B_j_dot(int body, const Coordinates& q, const Vector& qdot) const {
    const std::array<Pose, 5> pose = poses(q);
    const std::array<Twist, 5> twist = twists(q, qdot);
    const auto& [A_1, r_1] = pose[0];
    const auto& [A_j, r_j] = pose[static_cast<std::size_t>(body - 1)];
    const auto& [r_1_dot, omega_1] = twist[0];
    const auto& [r_j_dot, omega_j] = twist[static_cast<std::size_t>(body - 1)];
    Matrix B_dot = Matrix::Zero(6, columns_of_body[static_cast<std::size_t>(body - 1)]);
    if (body == 1) {
        const Matrix3 D_1 = D(q(14), q(15)), D_1_dot = D_dot(q(14), q(15), qdot[3], qdot[4]);
        B_dot << Matrix3::Zero(), skew(r_1_dot) * D_1 + skew(r_1) * D_1_dot, Matrix3::Zero(), D_1_dot;
    } else if (body <= 3) {
        const int i = first_angle(body), row = first_row(body);
        const Matrix3 A_D = A_j * D(q(i), q(i + 1));
        const Matrix3 A_D_dot = skew(omega_j) * A_D + A_j * D_dot(q(i), q(i + 1), qdot[row], qdot[row + 1]);
        const Vector3 s_12_1 = A_1 * strut(body).s_12_1, s_12_1_dot = omega_1.cross(s_12_1);
        const Vector3 h_21_dot = omega_j.cross(A_j * strut(body).h_21);
        B_dot << -skew(r_1_dot + s_12_1_dot) * A_D - skew(r_1 + s_12_1) * A_D_dot, -h_21_dot, -A_D_dot, Vector3::Zero();
    } else {
        const Vector3 s_41 = A_j * arm(body).s_41, s_41_dot = omega_j.cross(s_41);
        const Vector3 u_41 = A_j * arm(body).C_41.col(2), u_41_dot = omega_j.cross(u_41);
        B_dot << -skew(r_j_dot + s_41_dot) * u_41 - skew(r_j + s_41) * u_41_dot, -u_41_dot;
    }
    return B_dot;
}

Matrix LiteralCar::B(const Coordinates& q) const {
    const Matrix B_1 = B_j(1, q);
    Matrix B = Matrix::Zero(30, 16);
    for (int j = 1; j <= 5; ++j) {
        const Matrix B_j = this->B_j(j, q);
        B.block<6, 6>(6 * (j - 1), 0) = B_1;
        B.block(6 * (j - 1), first_row(j), 6, B_j.cols()) = B_j;  // (18)
    }
    return B;
}

Matrix LiteralCar::B_dot(const Coordinates& q, const Vector& qdot) const {
    const Matrix B_1_dot = B_j_dot(1, q, qdot);
    Matrix B_dot = Matrix::Zero(30, 16);
    for (int j = 1; j <= 5; ++j) {
        const Matrix B_j_dot = this->B_j_dot(j, q, qdot);
        B_dot.block<6, 6>(6 * (j - 1), 0) = B_1_dot;
        B_dot.block(6 * (j - 1), first_row(j), 6, B_j_dot.cols()) = B_j_dot;
    }
    return B_dot;
}

}  // namespace hamilcar::paper
