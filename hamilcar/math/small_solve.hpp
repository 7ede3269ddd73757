// Small fixed-size solves without pivoting or branches, so that doubles, lanes and duals take the same path.
#pragma once

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Solves K x = b for symmetric positive definite K, of which only the lower triangle is read: K = L D L^T.
template <class T, int N>
HAMILCAR_CORE Vector<T, N> solve_positive_definite(Matrix<T, N, N> K, Vector<T, N> b) {
    Vector<T, N> inverse_pivot;
#pragma GCC unroll 8
    for (int j = 0; j < N; ++j) {
        inverse_pivot[j] = T(1) / K(j, j);
#pragma GCC unroll 8
        for (int i = j + 1; i < N; ++i) {
            const T l = K(i, j) * inverse_pivot[j];
#pragma GCC unroll 8
            for (int k = j + 1; k <= i; ++k) K(i, k) -= l * K(k, j);
            b[i] -= l * b[j];
        }
    }
    // K's strict lower triangle now holds L D column by column.
    Vector<T, N> x;
#pragma GCC unroll 8
    for (int j = N - 1; j >= 0; --j) {
        T sum = b[j];
#pragma GCC unroll 8
        for (int i = j + 1; i < N; ++i) sum -= K(i, j) * x[i];
        x[j] = sum * inverse_pivot[j];
    }
    return x;
}

// Inverse and determinant of a small general matrix by cofactors, for the sizes that linkages have (N = 1 and 3).
template <class T, int N>
struct Inverse {
    Matrix<T, N, N> matrix;
    T determinant;
};

template <class T>
HAMILCAR_CORE Inverse<T, 1> inverse(const Matrix<T, 1, 1>& A) {
    return {Matrix<T, 1, 1>(T(1) / A(0, 0)), A(0, 0)};
}

template <class T>
HAMILCAR_CORE Inverse<T, 3> inverse(const Matrix<T, 3, 3>& A) {
    const Vec3<T> a = A.col(0), b = A.col(1), c = A.col(2);
    const Vec3<T> bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
    const T determinant = a.dot(bc), scale = T(1) / determinant;
    Matrix<T, 3, 3> result;
    result.row(0) = bc * scale, result.row(1) = ca * scale, result.row(2) = ab * scale;
    return {result, determinant};
}

}  // namespace hamilcar
