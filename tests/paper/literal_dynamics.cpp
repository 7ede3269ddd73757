// Masses, momenta and the rate of the momenta, sections 4 and 5 and A.4, A.5 of the paper.
#include "paper/literal.hpp"

namespace hamilcar::paper {
namespace {

// Inverse of the 6 x 6 matrix of (10).
Matrix DI_j(const Vector3& r) {
    Matrix DI = Matrix::Identity(6, 6);
    DI.block<3, 3>(0, 3) = -skew(r);
    return DI;
}

}  // namespace

Matrix LiteralCar::DI(const Coordinates& q) const {
    const std::array<Pose, 5> pose = poses(q);
    Matrix DI = Matrix::Zero(30, 30);
    for (int j = 0; j < 5; ++j) DI.block<6, 6>(6 * j, 6 * j) = DI_j(pose[static_cast<std::size_t>(j)].r);
    return DI;
}

Matrix LiteralCar::DI_dot(const Coordinates& q, const Vector& qdot) const {
    const std::array<Twist, 5> twist = twists(q, qdot);
    Matrix DI_dot = Matrix::Zero(30, 30);
    for (int j = 0; j < 5; ++j) {
        DI_dot.block<3, 3>(6 * j, 6 * j + 3) = -skew(twist[static_cast<std::size_t>(j)].r_dot);
    }
    return DI_dot;
}

Matrix LiteralCar::M(const Coordinates& q) const {
    const std::array<Pose, 5> pose = poses(q);
    Matrix M = Matrix::Zero(30, 30);
    for (int j = 0; j < 5; ++j) {
        const Matrix3& A_j = pose[static_cast<std::size_t>(j)].A;
        M.block<3, 3>(6 * j, 6 * j) = body(j + 1).m * Matrix3::Identity();
        M.block<3, 3>(6 * j + 3, 6 * j + 3) = A_j * body(j + 1).J * A_j.transpose();  // (62)
    }
    return M;
}

Vector LiteralCar::M_dot_Y(const Coordinates& q, const Vector& Y) const {
    const Matrix M = this->M(q);
    Vector M_dot_Y = Vector::Zero(30);
    for (int j = 0; j < 5; ++j) {
        const Vector3 omega_j = Y.segment<3>(6 * j + 3);
        const Matrix3 J_j = M.block<3, 3>(6 * j + 3, 6 * j + 3);
        M_dot_Y.segment<3>(6 * j + 3) = skew(omega_j) * J_j * omega_j;  // (62)
    }
    return M_dot_Y;
}

Matrix LiteralCar::Mhat(const Coordinates& q) const {
    const Matrix DI = this->DI(q);
    return DI.transpose() * M(q) * DI;
}

Matrix LiteralCar::M_star(const Coordinates& q) const {
    const Matrix Mhat = this->Mhat(q), B_1 = B_j(1, q);
    Matrix M_star = Matrix::Zero(16, 16);
    for (int j = 1; j <= 5; ++j) {
        const Matrix Mhat_j = Mhat.block<6, 6>(6 * (j - 1), 6 * (j - 1)), B_j = this->B_j(j, q);
        M_star.block<6, 6>(0, 0) += B_1.transpose() * Mhat_j * B_1;  // A.4
        if (j == 1) continue;
        const Eigen::Index at = column_of_body[static_cast<std::size_t>(j - 1)], n = B_j.cols();
        M_star.block(0, at, 6, n) = B_1.transpose() * Mhat_j * B_j;   // A.4
        M_star.block(at, 0, n, 6) = B_j.transpose() * Mhat_j * B_1;   // A.4, the transpose
        M_star.block(at, at, n, n) = B_j.transpose() * Mhat_j * B_j;  // A.4
    }
    return M_star;
}

Matrix LiteralCar::M_star_star(const Coordinates& q) const {
    const Matrix Mhat = this->Mhat(q), H_underlined = this->H_underlined(q), B_1 = B_j(1, q);
    Matrix M_star_star = Matrix::Zero(10, 10);
    for (int j = 1; j <= 5; ++j) {
        const Matrix Mhat_j = Mhat.block<6, 6>(6 * (j - 1), 6 * (j - 1)), B_j = this->B_j(j, q);
        M_star_star.block<6, 6>(0, 0) += B_1.transpose() * Mhat_j * B_1;  // A.5
        if (j == 1) continue;
        const Eigen::Index row = column_of_body[static_cast<std::size_t>(j - 1)], at = 4 + j;
        const Vector H_prime = H_underlined.block(row, at, B_j.cols(), 1);  // H_1', H_2' of (43), or 1 for an arm
        const Vector B_H = B_j * H_prime;
        M_star_star.block<6, 1>(0, at) = B_1.transpose() * Mhat_j * B_H;                         // A.5
        M_star_star.block<1, 6>(at, 0) = B_H.transpose() * Mhat_j * B_1;                         // A.5, the transpose
        M_star_star.block<1, 1>(at, at) = H_prime.transpose() * B_j.transpose() * Mhat_j * B_H;  // A.5
    }
    return M_star_star;
}

Vector LiteralCar::X_star_star(const Coordinates& q) const {
    const Matrix Mhat = this->Mhat(q), H_underlined = this->H_underlined(q), B_1 = B_j(1, q);
    const Vector X_underlined = this->X_underlined(q);
    Vector X_star_star = Vector::Zero(10);
    for (const int j : {2, 3}) {
        const Matrix Mhat_j = Mhat.block<6, 6>(6 * (j - 1), 6 * (j - 1)), B_j = this->B_j(j, q);
        const int row = column_of_body[static_cast<std::size_t>(j - 1)], at = 4 + j;
        const Vector H_prime = H_underlined.block<4, 1>(row, at), X_prime = X_underlined.segment<4>(row);  // (43)
        X_star_star.segment<6>(0) += B_1.transpose() * Mhat_j * B_j * X_prime;                             // A.5
        X_star_star[at] = H_prime.dot(B_j.transpose() * Mhat_j * B_j * X_prime);                           // A.5
    }
    return X_star_star;
}

Vector LiteralCar::rotor_momentum(const Coordinates& q, const Rotors& p_s) const {
    const std::array<Pose, 5> pose = poses(q);
    Vector h = Vector::Zero(30);
    for (int j = 2; j <= 5; ++j) {
        const auto i = static_cast<std::size_t>(j - 2);
        h.segment<3>(6 * (j - 1) + 3) = pose[i + 1].A * body(j).e * p_s[i];
    }
    return h;
}

Vector LiteralCar::P_a(const Coordinates& q, const Vector& adot, const Rotors& p_s) const {
    const Matrix BH = this->BH(q);
    return BH.transpose() * (Mhat(q) * BH * adot + Mhat(q) * BX(q) + rotor_momentum(q, p_s));  // (57)
}

Vector LiteralCar::adot(const Coordinates& q, const Vector& P_a, const Rotors& p_s) const {
    const Vector rotors = BH(q).transpose() * rotor_momentum(q, p_s);
    return M_star_star(q).ldlt().solve(P_a - rotors - X_star_star(q));  // (58)
}

Vector LiteralCar::P_a_dot(const Coordinates& q, const Vector& adot, const Vector& Qhat, const Rotors& p_s) const {
    const Vector Y = DI(q) * (BH(q) * adot + BX(q));  // (42)
    const Vector momentum = M(q) * Y + rotor_momentum(q, p_s);
    return BH(q).transpose() * Qhat + DI_BH_dot(q, adot).transpose() * momentum;  // (71)
}

Vector LiteralCar::gravity(const Coordinates& q) const {
    Vector Q = Vector::Zero(30);
    for (int j = 1; j <= 5; ++j) Q[6 * (j - 1) + 2] = -body(j).m * gravity_;
    return DI(q).transpose() * Q;  // (55)
}

}  // namespace hamilcar::paper
