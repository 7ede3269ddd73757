// Cut joints, their Jacobian and its rate, and the elimination of the dependent rates, section 3 and A.3 of the paper.
#include "paper/literal.hpp"

namespace hamilcar::paper {
namespace {

// Motion of a point of the spindle per (q1', q2', q3', q4'), chassis held: p is its place from the strut top.
Matrix point_jacobian(const Vector3& p, const CutJoints& c) {
    Matrix G(3, 4);
    G << skew(p) * c.A_D, -c.h;
    return G;
}

Matrix point_jacobian_dot(const Vector3& p, const Vector3& p_dot, const CutJoints& c, const CutJoints& c_dot) {
    Matrix G_dot(3, 4);
    G_dot << skew(p_dot) * c.A_D + skew(p) * c_dot.A_D, -c_dot.h;
    return G_dot;
}

Matrix columns_of_W(const Matrix& Phi_q) {
    return Phi_q(Eigen::all, {0, 1, 2, 4, 5, 6});
}

// The arms' angles q9, q10 are in V but in no cut joint.
Matrix columns_of_V(const Matrix& Phi_q) {
    Matrix Phi_v = Matrix::Zero(6, 4);
    Phi_v.col(0) = Phi_q.col(3);
    Phi_v.col(1) = Phi_q.col(7);
    return Phi_v;
}

// Places the blocks of a 6 x 4 matrix that maps V' to W' where (41) has H_1 and H_2.
Matrix place_dependent(const Matrix& H) {
    Matrix placed = Matrix::Zero(16, 10);
    placed.block<3, 1>(6, 6) = H.block<3, 1>(0, 0);
    placed.block<3, 1>(10, 7) = H.block<3, 1>(3, 1);
    return placed;
}

}  // namespace

CutJoints LiteralCar::cut_joints(int j, const Coordinates& q) const {
    const std::array<Pose, 5> pose = poses(q);
    const auto& [A_1, r_1] = pose[0];
    const auto& [A_2, r_2] = pose[static_cast<std::size_t>(j - 1)];
    const Strut& s = strut(j);
    const int i = j == 2 ? 1 : 5;
    CutJoints c;
    c.A_D = A_2 * D(q(i), q(i + 1));
    c.h = A_2 * s.h_21;
    c.u_2 = A_1 * s.u_2;
    c.u_1 = A_1 * s.u_1;
    c.d_2 = r_2 + A_2 * s.s_21_2 - r_1 - A_1 * s.s_12_2;                  // (22)
    c.d_3 = r_2 + A_2 * s.s_21_3 - r_1 - A_1 * s.s_12_3 - q(17) * c.u_1;  // (24)
    c.p_2 = r_2 + A_2 * s.s_21_2 - r_1 - A_1 * s.s_12_1;                  // A.3
    c.p_3 = r_2 + A_2 * s.s_21_3 - r_1 - A_1 * s.s_12_1;                  // A.3
    return c;
}

CutJoints LiteralCar::cut_joints_dot(int j, const Coordinates& q, const Vector& qdot) const {
    const std::array<Pose, 5> pose = poses(q);
    const std::array<Twist, 5> twist = twists(q, qdot);
    const Matrix3 &A_1 = pose[0].A, &A_2 = pose[static_cast<std::size_t>(j - 1)].A;
    const auto& [r_1_dot, omega_1] = twist[0];
    const auto& [r_2_dot, omega_2] = twist[static_cast<std::size_t>(j - 1)];
    const Strut& s = strut(j);
    const int i = j == 2 ? 1 : 5, row = column_of_body[static_cast<std::size_t>(j - 1)];
    const Vector3 s_12_1_dot = omega_1.cross(A_1 * s.s_12_1), s_12_2_dot = omega_1.cross(A_1 * s.s_12_2);
    const Vector3 s_12_3_dot = omega_1.cross(A_1 * s.s_12_3);
    const Vector3 s_21_2_dot = omega_2.cross(A_2 * s.s_21_2), s_21_3_dot = omega_2.cross(A_2 * s.s_21_3);
    CutJoints c_dot;
    c_dot.A_D = skew(omega_2) * A_2 * D(q(i), q(i + 1)) + A_2 * D_dot(q(i), q(i + 1), qdot[row], qdot[row + 1]);
    c_dot.h = omega_2.cross(A_2 * s.h_21);
    c_dot.u_2 = omega_1.cross(A_1 * s.u_2);
    c_dot.u_1 = omega_1.cross(A_1 * s.u_1);
    c_dot.d_2 = r_2_dot + s_21_2_dot - r_1_dot - s_12_2_dot;
    c_dot.d_3 = r_2_dot + s_21_3_dot - r_1_dot - s_12_3_dot - q.q17_dot * (A_1 * s.u_1) - q(17) * c_dot.u_1;
    c_dot.p_2 = r_2_dot + s_21_2_dot - r_1_dot - s_12_1_dot;
    c_dot.p_3 = r_2_dot + s_21_3_dot - r_1_dot - s_12_1_dot;
    return c_dot;
}

Vector LiteralCar::Phi(const Coordinates& q) const {
    Vector Phi(6);
    for (const int j : {2, 3}) {
        const CutJoints c = cut_joints(j, q);
        const Strut& s = strut(j);
        Phi.segment<3>(3 * (j - 2)) << c.u_2.dot(c.d_2), c.d_2.dot(c.d_2) - s.c_2 * s.c_2,
            c.d_3.dot(c.d_3) - s.c_3 * s.c_3;  // (21), (23), (25)
    }
    return Phi;
}

Matrix LiteralCar::Phi_q(const Coordinates& q) const {
    Matrix Phi_q = Matrix::Zero(6, 8);
    for (const int j : {2, 3}) {
        const CutJoints c = cut_joints(j, q);
        const Matrix G_2 = point_jacobian(c.p_2, c), G_3 = point_jacobian(c.p_3, c);
        auto rows = Phi_q.block<3, 4>(3 * (j - 2), 4 * (j - 2));
        rows.row(0) = c.u_2.transpose() * G_2;      // A.3
        rows.row(1) = 2 * c.d_2.transpose() * G_2;  // A.3
        rows.row(2) = 2 * c.d_3.transpose() * G_3;  // A.3
    }
    return Phi_q;
}

Matrix LiteralCar::Phi_q_dot(const Coordinates& q, const Vector& qdot) const {
    Matrix Phi_q_dot = Matrix::Zero(6, 8);
    for (const int j : {2, 3}) {
        const CutJoints c = cut_joints(j, q), c_dot = cut_joints_dot(j, q, qdot);
        const Matrix G_2 = point_jacobian(c.p_2, c), G_2_dot = point_jacobian_dot(c.p_2, c_dot.p_2, c, c_dot);
        const Matrix G_3 = point_jacobian(c.p_3, c), G_3_dot = point_jacobian_dot(c.p_3, c_dot.p_3, c, c_dot);
        auto rows = Phi_q_dot.block<3, 4>(3 * (j - 2), 4 * (j - 2));
        rows.row(0) = c_dot.u_2.transpose() * G_2 + c.u_2.transpose() * G_2_dot;
        rows.row(1) = 2 * (c_dot.d_2.transpose() * G_2 + c.d_2.transpose() * G_2_dot);
        rows.row(2) = 2 * (c_dot.d_3.transpose() * G_3 + c.d_3.transpose() * G_3_dot);
    }
    return Phi_q_dot;
}

Vector LiteralCar::Phi_t(const Coordinates& q) const {
    const CutJoints right = cut_joints(2, q), left = cut_joints(3, q);
    Vector Phi_t = Vector::Zero(6);
    Phi_t[2] = -2 * right.d_3.dot(right.u_1) * q.q17_dot;  // (28)
    Phi_t[5] = -2 * left.d_3.dot(left.u_1) * q.q17_dot;    // (28)
    return Phi_t;
}

Matrix LiteralCar::H(const Coordinates& q) const {
    const Matrix Phi_q = this->Phi_q(q);
    return -columns_of_W(Phi_q).partialPivLu().solve(columns_of_V(Phi_q));  // (39)
}

Vector LiteralCar::X(const Coordinates& q) const {
    return -columns_of_W(Phi_q(q)).partialPivLu().solve(Phi_t(q) + alpha_ * Phi(q));  // (39)
}

Matrix LiteralCar::H_dot(const Coordinates& q, const Vector& qdot) const {
    const Matrix Phi_q = this->Phi_q(q), Phi_q_dot = this->Phi_q_dot(q, qdot);
    const Matrix Phi_w_inverse = columns_of_W(Phi_q).inverse();
    return Phi_w_inverse *
           (columns_of_W(Phi_q_dot) * Phi_w_inverse * columns_of_V(Phi_q) - columns_of_V(Phi_q_dot));  // (47)
}

Matrix LiteralCar::H_underlined(const Coordinates& q) const {
    Matrix H = place_dependent(this->H(q));
    H.block<6, 6>(0, 0).setIdentity();
    H(9, 6) = H(13, 7) = H(14, 8) = H(15, 9) = 1;  // (41)
    return H;
}

Vector LiteralCar::X_underlined(const Coordinates& q) const {
    const Vector X = this->X(q);
    Vector placed = Vector::Zero(16);
    placed.segment<3>(6) = X.segment<3>(0);
    placed.segment<3>(10) = X.segment<3>(3);  // (41)
    return placed;
}

Vector LiteralCar::qdot(const Coordinates& q, const Vector& adot) const {
    return H_underlined(q) * adot + X_underlined(q);  // (38), (40)
}

Matrix LiteralCar::BH(const Coordinates& q) const {
    return B(q) * H_underlined(q);
}  // (43)

Vector LiteralCar::BX(const Coordinates& q) const {
    return B(q) * X_underlined(q);
}  // (43)

Matrix LiteralCar::DI_BH_dot(const Coordinates& q, const Vector& adot) const {
    const Vector qdot = this->qdot(q, adot);
    const Matrix H_underlined_dot = place_dependent(H_dot(q, qdot));
    return DI_dot(q, qdot) * BH(q) + DI(q) * B_dot(q, qdot) * H_underlined(q) + DI(q) * B(q) * H_underlined_dot;
}

}  // namespace hamilcar::paper
