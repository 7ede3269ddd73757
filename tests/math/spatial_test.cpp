// Spatial vectors and inertia against mechanics of point masses: power, moments, body-fixed vectors, clouds of points.
#include <gtest/gtest.h>

#include <random>

#include "hamilcar/math/rotation.hpp"
#include "hamilcar/math/spatial.hpp"
#include "support/difference.hpp"

namespace hamilcar {
namespace {

constexpr double exact = 1e-14;

Spatial<double> rotation_about(const Vec3<double>& p, const Vec3<double>& e) {
    return spatial<double>(p.cross(e), e);
}

class Spatials : public testing::Test {
protected:
    double number() { return unit_(source_); }
    Vec3<double> vector() { return {number(), number(), number()}; }
    Spatial<double> six() { return spatial<double>(vector(), vector()); }

private:
    std::mt19937 source_{5};
    std::uniform_real_distribution<double> unit_{-1, 1};
};

TEST_F(Spatials, MotionsMoveTheirPoints) {
    const Vec3<double> p = vector(), e = vector().normalized(), y = vector();
    const auto turned = [&](double angle) { return Vec3<double>(p + axis_rotation<double>(e, angle) * (y - p)); };
    EXPECT_LE((velocity_at<double>(rotation_about(p, e), y) - test::derivative(turned, 0.0)).norm(), 1e-11);
    EXPECT_LE((velocity_at<double>(spatial<double>(e, Vec3<double>::Zero()), y) - e).norm(), exact);
}

TEST_F(Spatials, ForceTimesMotionIsForceTimesVelocityOfItsPoint) {
    for (int i = 0; i < 20; ++i) {
        const Vec3<double> p = vector(), f = vector();
        const Spatial<double> v = six();
        EXPECT_NEAR(force_at<double>(p, f).dot(v), f.dot(velocity_at<double>(v, p)), exact);
    }
}

TEST_F(Spatials, CrossProductsAreDual) {
    for (int i = 0; i < 20; ++i) {
        const Spatial<double> v = six(), m = six(), f = six(), w = six();
        EXPECT_NEAR(f.dot(cross_motion<double>(v, m)), -cross_force<double>(v, f).dot(m), exact);
        EXPECT_LE((cross_motion<double>(v, m) + cross_motion<double>(m, v)).norm(), exact);
        const Spatial<double> jacobi = cross_motion<double>(v, cross_motion<double>(m, w)) +
                                       cross_motion<double>(m, cross_motion<double>(w, v)) +
                                       cross_motion<double>(w, cross_motion<double>(v, m));
        EXPECT_LE(jacobi.norm(), exact);
    }
}

// A screw and a wrench fixed in a body that starts with motion v.
TEST_F(Spatials, CrossProductsAreRatesOfBodyFixedVectors) {
    for (int i = 0; i < 5; ++i) {
        const Spatial<double> v = six();
        const Vec3<double> p = vector(), e = vector(), f = vector(), w = v.tail<3>();
        const auto R = [&](double t) { return axis_rotation<double>(w.normalized(), w.norm() * t); };
        const auto carried = [&](double t) { return Vec3<double>(R(t) * p + t * v.head<3>()); };
        const auto screw = [&](double t) { return rotation_about(carried(t), R(t) * e); };
        const auto wrench = [&](double t) { return force_at<double>(carried(t), R(t) * f); };
        EXPECT_LE((cross_motion<double>(v, screw(0)) - test::derivative(screw, 0.0)).norm(), 1e-11);
        EXPECT_LE((cross_force<double>(v, wrench(0)) - test::derivative(wrench, 0.0)).norm(), 1e-11);
    }
}

Mat3<double> dense(const Symmetric3<double>& S) {
    Mat3<double> M;
    M << S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz;
    return M;
}

TEST_F(Spatials, SymmetricMatrixAgreesWithEigen) {
    const Symmetric3<double> S{1.2, 2.3, 3.1, -0.4, 0.5, 0.6};
    const Mat3<double> R = axis_rotation<double>(vector().normalized(), 1.1);
    const Vec3<double> v = vector();
    EXPECT_LE((S * v - dense(S) * v).norm(), exact);
    EXPECT_LE((dense(S.rotated(R)) - R * dense(S) * R.transpose()).norm(), exact);
}

// Ten rigidly connected point masses: their linear and angular momentum, summed point by point.
TEST_F(Spatials, InertiaIsThatOfACloudOfPointMasses) {
    std::vector<std::pair<double, Vec3<double>>> cloud;
    double mass = 0;
    Vec3<double> center = Vec3<double>::Zero();
    for (int i = 0; i < 10; ++i) {
        cloud.push_back({1.5 + number(), vector()});
        mass += cloud.back().first;
        center += cloud.back().first * cloud.back().second;
    }
    center /= mass;
    Mat3<double> J = Mat3<double>::Zero();
    for (const auto& [m, p] : cloud) {
        const Vec3<double> d = p - center;
        J += m * (d.squaredNorm() * Mat3<double>::Identity() - d * d.transpose());
    }
    const auto body =
        SpatialInertia<double>::about_origin(mass, center, {J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(1, 2), J(0, 2)});
    Matrix<double, 6, 6> K = Matrix<double, 6, 6>::Constant(0.25);
    body.add_to_lower(K);
    for (int i = 0; i < 6; ++i) {
        for (int j = i + 1; j < 6; ++j) EXPECT_EQ(K(i, j), 0.25) << "the upper triangle is not touched";
    }
    for (int i = 0; i < 10; ++i) {
        const Spatial<double> v = six();
        Vec3<double> linear_momentum = Vec3<double>::Zero(), angular_momentum = Vec3<double>::Zero();
        for (const auto& [m, p] : cloud) {
            const Vec3<double> velocity = v.head<3>() + Vec3<double>(v.tail<3>()).cross(p);
            linear_momentum += m * velocity;
            angular_momentum += m * p.cross(velocity);
        }
        const Spatial<double> expected = spatial<double>(linear_momentum, angular_momentum);
        EXPECT_LE((body * v - expected).norm(), 10 * exact) << "sums of some tens";
        Matrix<double, 6, 6> full = K.array() - 0.25;
        full = Matrix<double, 6, 6>(full.selfadjointView<Eigen::Lower>());
        EXPECT_LE((full * v - expected).norm(), 10 * exact);
    }
}

}  // namespace
}  // namespace hamilcar
