#include "hamilcar/driver/spline.hpp"

#include <cstddef>

namespace hamilcar::spline {

namespace {

// Thomas algorithm for rows lower z[i-1] + diagonal z[i] + upper z[i+1] = right; the matrix is diagonally dominant.
std::vector<double> solve_tridiagonal(const std::vector<double>& lower, std::vector<double> diagonal,
                                      const std::vector<double>& upper, std::vector<double> right) {
    const std::size_t n = diagonal.size();
    for (std::size_t i = 1; i < n; ++i) {
        const double factor = lower[i] / diagonal[i - 1];
        diagonal[i] -= factor * upper[i - 1];
        right[i] -= factor * right[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) {
        if (i + 1 < n) right[i] -= upper[i] * right[i + 1];
        right[i] /= diagonal[i];
    }
    return right;
}

}  // namespace

std::vector<double> natural_second_derivatives(const std::vector<double>& value, const std::vector<double>& chord) {
    const std::size_t n = value.size();
    std::vector<double> lower(n, 0.0), diagonal(n, 1.0), upper(n, 0.0), right(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        lower[i] = chord[i - 1], upper[i] = chord[i], diagonal[i] = 2 * (chord[i - 1] + chord[i]);
        right[i] = 6 * ((value[i + 1] - value[i]) / chord[i] - (value[i] - value[i - 1]) / chord[i - 1]);
    }
    return solve_tridiagonal(lower, diagonal, upper, right);
}

// The two corner entries of the matrix are handled by the Sherman-Morrison formula.
std::vector<double> periodic_second_derivatives(const std::vector<double>& value, const std::vector<double>& chord) {
    const std::size_t n = value.size();
    std::vector<double> lower(n), diagonal(n), upper(n), right(n), corner(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
        lower[i] = chord[before], upper[i] = chord[i], diagonal[i] = 2 * (chord[before] + chord[i]);
        right[i] = 6 * ((value[after] - value[i]) / chord[i] - (value[i] - value[before]) / chord[before]);
    }
    const double wrap = chord[n - 1], pivot = -diagonal[0];
    diagonal[0] -= pivot, diagonal[n - 1] -= wrap * wrap / pivot;
    corner[0] = pivot, corner[n - 1] = wrap;
    std::vector<double> second = solve_tridiagonal(lower, diagonal, upper, right);
    const std::vector<double> influence = solve_tridiagonal(lower, diagonal, upper, corner);
    const double share =
        (second[0] + wrap / pivot * second[n - 1]) / (1 + influence[0] + wrap / pivot * influence[n - 1]);
    for (std::size_t i = 0; i < n; ++i) second[i] -= share * influence[i];
    return second;
}

std::array<double, 4> cubic(double from, double to, double second, double next_second, double chord) {
    return {from, (to - from) / chord - chord * (2 * second + next_second) / 6, second / 2,
            (next_second - second) / (6 * chord)};
}

}  // namespace hamilcar::spline
