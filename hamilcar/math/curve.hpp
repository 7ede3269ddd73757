// A piecewise linear function, constant beyond its ends, as a sum of clamped ramps: no search and no branch.
#pragma once

#include <tuple>
#include <vector>

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

template <class T>
struct Curve {
    T first{0};                        // value at and below the first point
    std::vector<T> start, end, slope;  // of the segments
    static constexpr auto members() { return std::tuple(&Curve::first, &Curve::start, &Curve::end, &Curve::slope); }

    Curve() = default;
    // As many x as y, at least one; x increases.
    Curve(const std::vector<double>& x, const std::vector<double>& y) : first(y.front()) {
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            start.push_back(T(x[i])), end.push_back(T(x[i + 1]));
            slope.push_back(T((y[i + 1] - y[i]) / (x[i + 1] - x[i])));
        }
    }

    T at(const T& x) const {
        T sum = first;
        for (std::size_t i = 0; i < slope.size(); ++i) sum += slope[i] * (clamp(x, start[i], end[i]) - start[i]);
        return sum;
    }
    // Of the segment at x; beyond both ends that of the last one there, as far as it goes.
    T slope_at(const T& x) const {
        T out = slope[0];
        for (std::size_t i = 1; i < slope.size(); ++i) out = select(x < start[i], out, slope[i]);
        return out;
    }
};

}  // namespace hamilcar
