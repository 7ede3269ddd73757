// Rotations against their definitions: products of elementary rotations, rates by differences, constant lengths.
#include <gtest/gtest.h>

#include "hamilcar/math/rotation.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

constexpr double exact = 4e-15;  // a few roundings of numbers up to one
const std::array<Vec3<double>, 4> angles{Vec3<double>(0, 0, 0), Vec3<double>(0.3, -0.7, 1.9),
                                         Vec3<double>(-2.8, 1.2, -0.4), Vec3<double>(0.01, -1.5, 3.1)};

// About x, y or z, as in any textbook.
Mat3<double> elementary(int axis, double angle) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    Mat3<double> R = Mat3<double>::Identity();
    R(i, i) = R(j, j) = std::cos(angle);
    R(j, i) = std::sin(angle);
    R(i, j) = -std::sin(angle);
    return R;
}

Mat3<double> skew(const Vec3<double>& w) {
    Mat3<double> W;
    W << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
    return W;
}

void expect_rotation(const Mat3<double>& R) {
    EXPECT_LE((R.transpose() * R - Mat3<double>::Identity()).cwiseAbs().maxCoeff(), exact);
    EXPECT_NEAR(R.determinant(), 1, exact);
}

TEST(Bryant, RotatesAboutXThenYThenZ) {
    for (const Vec3<double>& q : angles) {
        const Mat3<double> A = bryant_rotation(BryantAngles<double>(q));
        expect_rotation(A);
        const Mat3<double> expected = elementary(0, q[0]) * elementary(1, q[1]) * elementary(2, q[2]);
        EXPECT_LE((A - expected).cwiseAbs().maxCoeff(), exact);
    }
}

// A' A^T is the skew matrix of D q', angle by angle.
TEST(Bryant, RateMatrixGivesTheAngularVelocity) {
    for (const Vec3<double>& q : angles) {
        const Mat3<double> A = bryant_rotation(BryantAngles<double>(q)),
                           D = bryant_rate_matrix(BryantAngles<double>(q));
        for (int i = 0; i < 3; ++i) {
            const auto turned = [&](double angle) {
                Vec3<double> varied = q;
                varied[i] = angle;
                return bryant_rotation(BryantAngles<double>(varied));
            };
            const Mat3<double> A_rate = test::derivative(turned, q[i]);
            EXPECT_LE((A_rate * A.transpose() - skew(D.col(i))).cwiseAbs().maxCoeff(), 1e-11);
        }
    }
}

TEST(AxisRotation, SolvesItsOwnDifferentialEquation) {
    const Vec3<double> axis = Vec3<double>(0.4, -0.8, 0.3).normalized();
    const auto turned = [&](double angle) { return axis_rotation<double>(axis, angle); };
    EXPECT_EQ(turned(0), Mat3<double>(Mat3<double>::Identity()));
    for (const double angle : {0.0, 0.6, -2.0, 3.1, 5.0}) {
        expect_rotation(turned(angle));
        EXPECT_LE((turned(angle) * axis - axis).norm(), exact) << "the axis stays";
        EXPECT_LE((test::derivative(turned, angle) - skew(axis) * turned(angle)).cwiseAbs().maxCoeff(), 1e-11);
    }
    for (int i = 0; i < 3; ++i) {
        EXPECT_LE((axis_rotation<double>(Vec3<double>::Unit(i), 0.7) - elementary(i, 0.7)).cwiseAbs().maxCoeff(),
                  exact);
    }
}

Vector<double, 4> half_angle(const Vec3<double>& axis, double angle) {
    const Vec3<double> part = std::sin(angle / 2) * axis;
    return {std::cos(angle / 2), part[0], part[1], part[2]};
}

TEST(Quaternion, RotatesByTwiceItsAngleForAnyLength) {
    const Vec3<double> axis = Vec3<double>(-0.2, 0.5, 0.9).normalized();
    for (const double angle : {0.0, 0.5, -2.2, 3.0}) {
        for (const double length : {1.0, 1.003, 0.4, -7.0}) {
            const Mat3<double> R = quaternion_rotation<double>(length * half_angle(axis, angle));
            expect_rotation(R);
            EXPECT_LE((R - axis_rotation<double>(axis, angle)).cwiseAbs().maxCoeff(), exact);
        }
    }
}

// R' = R [omega] with omega in body axes, and the length is constant.
TEST(Quaternion, RateFollowsTheBodysAngularVelocity) {
    const Vec3<double> omega(0.7, -1.3, 0.4);
    for (const Vec3<double>& q : angles) {
        const Vector<double, 4> at = half_angle(Vec3<double>(q + Vec3<double>(0.1, 0.2, 0.3)).normalized(), 2.1);
        const Vector<double, 4> rate = quaternion_rate<double>(at, omega);
        EXPECT_NEAR(at.dot(rate), 0, exact);
        const auto moved = [&](double t) { return quaternion_rotation<double>(at + t * rate); };
        const Mat3<double> expected = quaternion_rotation<double>(at) * skew(omega);
        EXPECT_LE((test::derivative(moved, 0.0) - expected).cwiseAbs().maxCoeff(), 1e-11);
    }
}

}  // namespace
}  // namespace hamilcar
