// Curves at rising levels of a second argument, between which they are interpolated; constant beyond the first and the last level.
#pragma once

#include "hamilcar/math/curve.hpp"

namespace hamilcar {

template <class T>
struct CurveFamily {
    std::vector<T> level,
        inverse_rise;  // of all curves but the last: where the rise to the next one begins, 1 / its width
    std::vector<Curve<T>> curves;
    static constexpr auto members() {
        return std::tuple(&CurveFamily::level, &CurveFamily::inverse_rise, &CurveFamily::curves);
    }

    bool exists() const { return !curves.empty(); }
    // With a level that is above that of the last curve.
    void add(double at, double level_of_last, const std::vector<double>& x, const std::vector<double>& y) {
        if (exists()) level.push_back(T(level_of_last)), inverse_rise.push_back(T(1 / (at - level_of_last)));
        curves.emplace_back(x, y);
    }
    T at(const T& where, const T& x) const {
        T sum = curves[0].at(x), below = sum;
        for (std::size_t i = 0; i < level.size(); ++i) {
            const T above = curves[i + 1].at(x);
            sum += (above - below) * clamp(T((where - level[i]) * inverse_rise[i]), T(0), T(1));
            below = above;
        }
        return sum;
    }
};

}  // namespace hamilcar
