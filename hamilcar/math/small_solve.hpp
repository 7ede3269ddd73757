// Small solves without branches, so that doubles, lanes and duals take the same path.
#pragma once

#include <array>

#include "hamilcar/math/eigen.hpp"
#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Inverse and determinant of a small general matrix by cofactors, for the sizes that linkages have (N = 1 and 3).
template <class T, int N>
struct Inverse {
    Matrix<T, N, N> matrix;
    T determinant;
};

template <class T>
Inverse<T, 1> inverse(const Matrix<T, 1, 1>& A) {
    return {Matrix<T, 1, 1>(T(1) / A(0, 0)), A(0, 0)};
}

template <class T>
Inverse<T, 3> inverse(const Matrix<T, 3, 3>& A) {
    const Vec3<T> a = A.col(0), b = A.col(1), c = A.col(2);
    const Vec3<T> bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
    const T determinant = a.dot(bc), scale = T(1) / determinant;
    Matrix<T, 3, 3> result;
    result.row(0) = bc * scale, result.row(1) = ca * scale, result.row(2) = ab * scale;
    return {result, determinant};
}

namespace detail {

// Gauss-Jordan elimination on the leading n x n block of A, which becomes its inverse. Calls exchange(A, B, k) before the k-th
// pivot is taken from the diagonal. Returns the determinant up to the sign of the row exchanges.
template <class T, int max_size, class Exchange>
T gauss_jordan(Matrix<T, max_size, max_size>& A, int n, Exchange&& exchange) {
    Matrix<T, max_size, max_size> B;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) B(i, j) = T(i == j ? 1 : 0);
    }
    T determinant(1);
    for (int k = 0; k < n; ++k) {
        exchange(A, B, k);
        determinant *= A(k, k);
        const T scale = T(1) / A(k, k);
        for (int j = 0; j < n; ++j) A(k, j) *= scale, B(k, j) *= scale;
        for (int r = 0; r < n; ++r) {
            if (r == k) continue;
            const T factor = A(r, k);
            for (int j = 0; j < n; ++j) A(r, j) -= factor * A(k, j), B(r, j) -= factor * B(k, j);
        }
    }
    A = B;
    return determinant;
}

// Partial pivoting: rows are swapped pair by pair with select, so that every lane may have its own order.
template <class T, int max_size>
T gauss_jordan_with_exchange(Matrix<T, max_size, max_size>& A, int n) {
    T sign(1);
    const T determinant = gauss_jordan<T, max_size>(A, n, [&](auto& upper_A, auto& upper_B, int k) {
        for (int r = k + 1; r < n; ++r) {
            const auto swap_rows = abs(upper_A(r, k)) > abs(upper_A(k, k));
            sign = select(swap_rows, T(-sign), sign);
            for (int j = 0; j < n; ++j) {
                for (Matrix<T, max_size, max_size>* M : {&upper_A, &upper_B}) {
                    const T upper = (*M)(k, j), lower = (*M)(r, j);
                    (*M)(k, j) = select(swap_rows, lower, upper), (*M)(r, j) = select(swap_rows, upper, lower);
                }
            }
        }
    });
    return sign * determinant;
}

}  // namespace detail

// Replaces the leading n x n block of A by its inverse and returns its determinant. In the given order of rows and columns the
// diagonal nearly always provides good pivots; where one is less than a tenth of the entries below it, rows are exchanged.
template <class T, int max_size>
T invert_in_place(Matrix<T, max_size, max_size>& A, int n) {
    constexpr std::size_t size = static_cast<std::size_t>(max_size) * static_cast<std::size_t>(max_size) + 1;
    const auto index = [](int row, int column) {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(max_size) + static_cast<std::size_t>(column);
    };
    const auto packed = [&](const Matrix<T, max_size, max_size>& M, const T& determinant) {
        std::array<T, size> out;
        out.fill(T(0));
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) out[index(i, j)] = M(i, j);
        }
        out.back() = determinant;
        return out;
    };
    auto weak = T(1) < T(0);
    Matrix<T, max_size, max_size> ordered = A;
    const T determinant = detail::gauss_jordan<T, max_size>(ordered, n, [&](const auto& rest, const auto&, int k) {
        if (k + 1 == n) return;
        T largest(0);
        for (int r = k + 1; r < n; ++r) largest = max(largest, abs(rest(r, k)));
        weak = weak || abs(rest(k, k)) < T(0.1) * largest;
    });
    const std::array<T, size> common = packed(ordered, determinant);
    const std::array<T, size> found = unless(
        weak, [&] { return common; },
        [&] {
            Matrix<T, max_size, max_size> exchanged = A;
            const T its_determinant = detail::gauss_jordan_with_exchange<T, max_size>(exchanged, n);
            std::array<T, size> rare = packed(exchanged, its_determinant);
            for (std::size_t i = 0; i < size; ++i) rare[i] = select(weak, rare[i], common[i]);
            return rare;
        });
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) A(i, j) = found[index(i, j)];
    }
    return found.back();
}

// The inverse of the leading n x n block of a positive definite A, which needs no pivoting.
template <class T, int max_size>
void invert_positive_definite(Matrix<T, max_size, max_size>& A, int n) {
    detail::gauss_jordan<T, max_size>(A, n, [](auto&, auto&, int) {});
}

// The inverse of a symmetric matrix, of which only the lower triangle is read.
template <class T>
Mat3<T> symmetric_inverse(const Mat3<T>& A) {
    const T &a = A(0, 0), &b = A(1, 0), &c = A(2, 0), &d = A(1, 1), &e = A(2, 1), &f = A(2, 2);
    const T xx = d * f - e * e, xy = c * e - b * f, xz = b * e - c * d;
    const T scale = T(1) / (a * xx + (b * xy + c * xz));
    Mat3<T> X;
    X(0, 0) = xx * scale, X(1, 1) = (a * f - c * c) * scale, X(2, 2) = (a * d - b * b) * scale;
    X(0, 1) = X(1, 0) = xy * scale;
    X(0, 2) = X(2, 0) = xz * scale;
    X(1, 2) = X(2, 1) = (b * c - a * e) * scale;
    return X;
}

// Solves K x = b for a symmetric positive definite 6x6 matrix, of which only the lower triangle is read, by blocks of
// 3x3: two dependent divisions instead of six.
template <class T>
Vector<T, 6> solve_positive_definite(const Matrix<T, 6, 6>& K, const Vector<T, 6>& b) {
    const Mat3<T> A_inverse = symmetric_inverse<T>(K.template topLeftCorner<3, 3>());
    const Mat3<T> B = K.template bottomLeftCorner<3, 3>(), BA = B * A_inverse;
    const Vec3<T> b_1 = b.template head<3>(), b_2 = b.template tail<3>();
    Mat3<T> C;  // the Schur complement
    for (int j = 0; j < 3; ++j) {
        for (int i = j; i < 3; ++i) C(i, j) = K(3 + i, 3 + j) - BA.row(i).dot(B.row(j));
    }
    const Vec3<T> x_2 = symmetric_inverse<T>(C) * Vec3<T>(b_2 - BA * b_1);
    Vector<T, 6> x;
    x.template head<3>() = A_inverse * b_1 - BA.transpose() * x_2;
    x.template tail<3>() = x_2;
    return x;
}

}  // namespace hamilcar
