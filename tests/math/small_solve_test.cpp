// The small solvers against Eigen, and against the definition of an inverse.
#include "hamilcar/math/small_solve.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <limits>
#include <random>

#include "hamilcar/math/convert.hpp"

namespace hamilcar {
namespace {

template <int N>
Matrix<double, N, N> random_matrix(std::mt19937& source) {
    std::uniform_real_distribution<double> unit(-1, 1);
    return Matrix<double, N, N>::NullaryExpr([&] { return unit(source); });
}

// Random and as badly scaled as a car's 6x6 system: masses of a ton and inertias of a few kg m^2.
TEST(SolvePositiveDefinite, AgreesWithEigenAndReadsTheLowerTriangleOnly) {
    constexpr int N = 6;
    std::mt19937 source(N);
    for (int trial = 0; trial < 20; ++trial) {
        const Matrix<double, N, N> A = random_matrix<N>(source);
        Matrix<double, N, N> scale = Matrix<double, N, N>::Identity();
        for (int i = 0; i < N; ++i) scale(i, i) = std::pow(10.0, i % 3);
        const Matrix<double, N, N> K = scale * (A * A.transpose() + Matrix<double, N, N>::Identity()) * scale;
        const Vector<double, N> b = K * random_matrix<N>(source).col(0);
        Matrix<double, N, N> lower = K;
        for (int i = 0; i < N; ++i) {
            for (int j = i + 1; j < N; ++j) lower(i, j) = std::numeric_limits<double>::quiet_NaN();
        }
        const Vector<double, N> x = solve_positive_definite<double>(lower, b);
        EXPECT_LE((scale * (x - K.llt().solve(b))).norm(), 1e-12 * (scale * x).norm()) << N;
        EXPECT_LE((K * x - b).norm(), 1e-13 * K.norm() * x.norm()) << N;
    }
}

TEST(Inverse, InvertsItsMatrixAndGivesItsDeterminant) {
    std::mt19937 source(9);
    for (int trial = 0; trial < 20; ++trial) {
        const Mat3<double> A = random_matrix<3>(source);
        const auto result = inverse<double>(A);
        const double tolerance = 1e-14 * A.norm() * result.matrix.norm();
        EXPECT_LE((result.matrix * A - Mat3<double>::Identity()).norm(), tolerance);
        EXPECT_LE((A * result.matrix - Mat3<double>::Identity()).norm(), tolerance);
        EXPECT_NEAR(result.determinant, Eigen::PartialPivLU<Mat3<double>>(A).determinant(), 1e-15);
    }
    const auto one = inverse<double>(Matrix<double, 1, 1>(-4.0));
    EXPECT_EQ(one.matrix(0, 0), -0.25);
    EXPECT_EQ(one.determinant, -4);
}

// With zeros on the diagonal, where rows have to be exchanged, as many times as it takes.
TEST(InvertInPlace, ExchangesRowsAndKeepsTheDeterminantsSign) {
    constexpr int N = 5;
    std::mt19937 source(11);
    int negative = 0;
    for (int trial = 0; trial < 50; ++trial) {
        Matrix<double, N, N> A = random_matrix<N>(source);
        for (int i = 0; i < N; ++i) A(i, i) = 0;
        Matrix<double, N, N> result = A;
        const double determinant = invert_in_place<double, N>(result, N);
        EXPECT_LE((result * A - Matrix<double, N, N>::Identity()).norm(), 1e-12 * A.norm() * result.norm());
        EXPECT_NEAR(determinant, A.partialPivLu().determinant(), 1e-13);
        negative += determinant < 0 ? 1 : 0;
    }
    EXPECT_GT(negative, 5);
    EXPECT_LT(negative, 45);
}

TEST(Convert, KeepsTheOrderOfTheNumbers) {
    EXPECT_EQ(vec3({1, 2, 3}), Vec3<double>(1, 2, 3));
    EXPECT_EQ(as<float>(Vec3<double>(1, 2, 3)), Vec3<float>(1, 2, 3));
}

}  // namespace
}  // namespace hamilcar
