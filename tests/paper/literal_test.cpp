// The literal car against other routes than its own formulas: finite differences, the definition of kinetic energy, the
// Newton-Euler equations.
#include <gtest/gtest.h>

#include "paper/literal_fixture.hpp"

namespace hamilcar::paper {
namespace {

constexpr double alpha = 60;  // [1/s]

// Largest difference, relative to the largest entry of the expected value.
double difference(const Matrix& actual, const Matrix& expected) {
    return (actual - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

class Literal : public testing::Test {
protected:
    LiteralCar car{reference_car(), alpha};
    Coordinates q = violated_position(car);
    Coordinates closed = general_position(car);
    Vector adot = general_rates();
    Vector qdot = car.qdot(q, adot);
};

TEST_F(Literal, DesignPositionIsAssembledAndJounceIsPositive) {
    const Coordinates design = car.design_position();
    EXPECT_LT(car.Phi(design).cwiseAbs().maxCoeff(), 1e-15);
    const auto pose = car.poses(design);
    for (int j = 1; j <= 5; ++j) {
        const Pose& body = pose[static_cast<std::size_t>(j - 1)];
        EXPECT_LT((body.r - car.body(j).center).norm(), 1e-15);
        EXPECT_LT((body.A - Matrix3::Identity()).norm(), 1e-15);
    }
    EXPECT_LT(pose[1].r.y(), 0);  // body 2 front right
    EXPECT_GT(pose[2].r.y(), 0);
    EXPECT_LT(pose[3].r.y(), 0);  // body 4 rear right
    EXPECT_GT(pose[4].r.y(), 0);
    Coordinates jounce = design;
    jounce(4) -= 0.05;
    jounce(8) -= 0.05;
    jounce(9) = jounce(10) = 0.1;
    const auto raised = car.poses(car.assemble(jounce));
    for (std::size_t i = 1; i < 5; ++i) EXPECT_GT(raised[i].r.z(), pose[i].r.z() + 0.02);
    EXPECT_NEAR(raised[1].r.z(), raised[2].r.z(), 1e-14);  // mirror symmetry
    EXPECT_NEAR(raised[3].r.y(), -raised[4].r.y(), 1e-14);
}

TEST_F(Literal, GivenLinkLengthsAreKept) {
    VehicleDescription description = reference_car();
    std::vector<CutJointDescription>& right = description.suspensions[1].linkage.cuts;
    right[0].length = 0.3354;  // control arm
    right[1].length = 0.372;   // tie rod
    const LiteralCar other(description);
    const Coordinates assembled = other.assemble(other.design_position());
    EXPECT_LT(other.Phi(assembled).cwiseAbs().maxCoeff(), 1e-15);
    const double arm = 0.333 * 0.333 + 0.0192 * 0.0192 + 0.0236 * 0.0236;        // C - A, A rounded to 0.1 mm
    const double tie_rod = 0.0046 * 0.0046 + 0.3722 * 0.3722 + 0.0232 * 0.0232;  // Q - R
    EXPECT_NEAR(car.Phi(assembled)[1], 0.3354 * 0.3354 - arm, 1e-4);
    EXPECT_NEAR(car.Phi(assembled)[2], 0.372 * 0.372 - tie_rod, 1e-14);
    EXPECT_NEAR(car.Phi(assembled)[5], 0, 1e-15);
}

TEST_F(Literal, VelocitiesAreRatesOfThePoses) {
    const Vector Yhat = car.B(q) * qdot;  // (18)
    const auto twist = car.twists(q, qdot);
    for (int j = 0; j < 5; ++j) {
        const auto i = static_cast<std::size_t>(j);
        const Pose pose = car.poses(q)[i];
        const Vector3 point = -pose.A.transpose() * pose.r;  // the body-fixed point that is passing the origin
        const Vector3 v = derivative(
            [&](double t) {
                const Pose p = car.poses(car.moved(q, qdot, t))[i];
                return (p.r + p.A * point).eval();
            },
            1e-3);
        const Matrix3 A_dot = derivative([&](double t) { return car.poses(car.moved(q, qdot, t))[i].A; }, 1e-3);
        const Matrix3 tilde = A_dot * pose.A.transpose();
        const Vector3 omega(tilde(2, 1), tilde(0, 2), tilde(1, 0));
        EXPECT_LT((Yhat.segment<3>(6 * j) - v).norm(), 1e-9);
        EXPECT_LT((Yhat.segment<3>(6 * j + 3) - omega).norm(), 1e-10);
        EXPECT_LT((twist[i].omega - omega).norm(), 1e-10);  // (9), (12), (15)
        const Vector3 r_dot = derivative([&](double t) { return car.poses(car.moved(q, qdot, t))[i].r; }, 1e-3);
        EXPECT_LT((twist[i].r_dot - r_dot).norm(), 1e-10);  // (13), (16)
    }
}

TEST_F(Literal, ConstraintJacobianIsDerivativeOfPhi) {
    for (int i = 1; i <= 17; ++i) {
        const Vector column = derivative(
            [&](double x) {
                Coordinates p = q;
                p(i) += x;
                return car.Phi(p);
            },
            1e-3);
        if (i <= 8) {
            EXPECT_LT((column - car.Phi_q(q).col(i - 1)).cwiseAbs().maxCoeff(), 1e-11) << i;  // A.3
        } else if (i <= 16) {
            EXPECT_LT(column.cwiseAbs().maxCoeff(), 1e-11) << i;  // no cut joint sees the chassis or an arm
        } else {
            EXPECT_LT((column * q.q17_dot - car.Phi_t(q)).cwiseAbs().maxCoeff(), 1e-11);  // (28)
        }
    }
}

TEST_F(Literal, ViolationDecaysAtAlpha) {
    const Vector Phi_dot = derivative([&](double t) { return car.Phi(car.moved(q, qdot, t)); }, 1e-3);
    EXPECT_GT(car.Phi(q).cwiseAbs().minCoeff(), 1e-5);
    EXPECT_LT((Phi_dot + alpha * car.Phi(q)).cwiseAbs().maxCoeff(), 1e-10);  // (27)
}

TEST_F(Literal, EliminationIsDerivativeOfTheAssembledW) {
    const auto W_of = [&](int i, double x) {
        Coordinates p = closed;
        p(i) += x;
        p = car.assemble(p);
        Vector W(6);
        for (std::size_t k = 0; k < 6; ++k) W[static_cast<Eigen::Index>(k)] = p(dependent[k]);
        return W;
    };
    for (int k = 0; k < 4; ++k) {
        const int i = independent[static_cast<std::size_t>(6 + k)];
        const Vector column = derivative([&](double x) { return W_of(i, x); }, 1e-3);
        EXPECT_LT((column - car.H(closed).col(k)).cwiseAbs().maxCoeff(), 1e-9);  // (39)
    }
    const Vector X = derivative([&](double x) { return W_of(17, x); }, 1e-3) * closed.q17_dot;
    EXPECT_LT((X - car.X(closed)).cwiseAbs().maxCoeff(), 1e-9);  // (39)
}

TEST_F(Literal, RatesOfTheMatricesAlongTheFlow) {
    const auto rate = [&](auto matrix) {
        return derivative([&](double t) { return Matrix(matrix(car.moved(q, qdot, t))); }, 2e-3).eval();
    };
    const auto B = [&](const Coordinates& p) { return car.B(p); };
    const auto Phi_q = [&](const Coordinates& p) { return car.Phi_q(p); };
    const auto H = [&](const Coordinates& p) { return car.H(p); };
    const auto DI_BH = [&](const Coordinates& p) { return Matrix(car.DI(p) * car.BH(p)); };
    EXPECT_LT(difference(car.B_dot(q, qdot), rate(B)), 1e-10);
    EXPECT_LT(difference(car.Phi_q_dot(q, qdot), rate(Phi_q)), 1e-10);
    EXPECT_LT(difference(car.H_dot(q, qdot), rate(H)), 1e-9);           // (47)
    EXPECT_LT(difference(car.DI_BH_dot(q, adot), rate(DI_BH)), 1e-10);  // (71)
}

TEST_F(Literal, BlocksOfTheMassMatricesAreTheProducts) {
    const Matrix B = car.B(q), BH = car.BH(q), Mhat = car.Mhat(q);
    EXPECT_LT(difference(car.M_star(q), B.transpose() * Mhat * B), 1e-13);         // A.4
    EXPECT_LT(difference(car.M_star_star(q), BH.transpose() * Mhat * BH), 1e-13);  // (59), A.5
    EXPECT_LT(difference(car.X_star_star(q), BH.transpose() * Mhat * car.BX(q)), 1e-13);
    EXPECT_LT(difference(car.M_star_star(q), car.M_star_star(q).transpose()), 1e-13);
    const Vector eigenvalues = car.M_star_star(q).selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_GT(eigenvalues.minCoeff(), 0);
    const Vector P_a = car.P_a(q, adot, {3, -4, 5, 6});
    EXPECT_LT(difference(car.adot(q, P_a, {3, -4, 5, 6}), adot), 1e-11);  // (58) inverts (57)
}

TEST_F(Literal, KineticEnergyIsThatOfTheBodies) {
    double T = 0;
    const auto twist = car.twists(q, qdot);
    for (std::size_t i = 0; i < 5; ++i) {
        const Body& body = car.body(static_cast<int>(i) + 1);
        const Vector3 omega = car.poses(q)[i].A.transpose() * twist[i].omega;
        T += 0.5 * body.m * twist[i].r_dot.squaredNorm() + 0.5 * omega.dot(body.J * omega);
    }
    const Vector BX = car.BX(q);
    const double in_a =
        0.5 * adot.dot(car.M_star_star(q) * adot) + adot.dot(car.X_star_star(q)) + 0.5 * BX.dot(car.Mhat(q) * BX);
    EXPECT_NEAR(0.5 * qdot.dot(car.M_star(q) * qdot), T, 1e-11 * T);  // (56)
    EXPECT_NEAR(in_a, T, 1e-11 * T);
}

// (54) and (70): with the joints closed T is a function of a, adot and t, whatever the rack does.
TEST_F(Literal, DerivativesOfKineticEnergy) {
    const auto T = [&](const Vector& da, const Vector& dadot) {
        Coordinates p = closed;
        for (std::size_t i = 0; i < 10; ++i) p(independent[i]) += da[static_cast<Eigen::Index>(i)];
        p = car.assemble(p);
        const Vector rate = car.qdot(p, adot + dadot);
        return 0.5 * rate.dot(car.M_star(p) * rate);
    };
    const Vector Y = car.DI(closed) * (car.BH(closed) * adot + car.BX(closed));
    const Vector dT_da = car.DI_BH_dot(closed, adot).transpose() * car.M(closed) * Y;  // (70)
    const Vector P_a = car.P_a(closed, adot), zero = Vector::Zero(10);
    for (int i = 0; i < 10; ++i) {
        const Vector e = Vector::Unit(10, i);
        EXPECT_NEAR(scalar_derivative([&](double x) { return T(x * e, zero); }, 2e-3), dT_da[i], 1e-7) << i;
        EXPECT_NEAR(scalar_derivative([&](double x) { return T(zero, x * e); }, 1e-1), P_a[i], 1e-8) << i;
    }
}

}  // namespace
}  // namespace hamilcar::paper
