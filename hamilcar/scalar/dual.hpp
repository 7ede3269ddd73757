// Dual number for forward-mode differentiation: a value with N partial derivatives, exact to round-off. Comparisons use the
// values, so a derivative is that of the branch taken.
#pragma once

#include <array>

#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

template <class T, int N>
class Dual {
public:
    using Partials = std::array<T, N>;

    Dual() = default;
    Dual(T value) : value_(value) {}  // implicit: constants enter formulas as numbers
    template <class Number>
    requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, T>) Dual(Number value)
        : value_(static_cast<T>(value)) {}
    Dual(T value, const Partials& partials) : value_(value), partials_(partials) {}
    // The independent variable with that index.
    static Dual variable(T value, int number) {
        Dual out(value);
        out.partials_[static_cast<std::size_t>(number)] = T(1);
        return out;
    }
    const T& value() const { return value_; }
    const T& partial(int i) const { return partials_[static_cast<std::size_t>(i)]; }
    // f(value) with the derivative f'(value).
    Dual chained(const T& f, const T& slope) const {
        Dual out(f);
        for (std::size_t i = 0; i < N; ++i) out.partials_[i] = slope * partials_[i];
        return out;
    }

    friend Dual operator+(const Dual& a, const Dual& b) { return combined(a.value_ + b.value_, a, T(1), b, T(1)); }
    friend Dual operator-(const Dual& a, const Dual& b) { return combined(a.value_ - b.value_, a, T(1), b, T(-1)); }
    friend Dual operator*(const Dual& a, const Dual& b) {
        return combined(a.value_ * b.value_, a, b.value_, b, a.value_);
    }
    friend Dual operator/(const Dual& a, const Dual& b) {
        const T ratio = a.value_ / b.value_, scale = T(1) / b.value_;
        return combined(ratio, a, scale, b, T(-ratio * scale));
    }
    friend Dual operator-(const Dual& a) { return a.chained(-a.value_, T(-1)); }
    Dual& operator+=(const Dual& b) { return *this = *this + b; }
    Dual& operator-=(const Dual& b) { return *this = *this - b; }
    Dual& operator*=(const Dual& b) { return *this = *this * b; }
    Dual& operator/=(const Dual& b) { return *this = *this / b; }
    friend bool operator<(const Dual& a, const Dual& b) { return a.value_ < b.value_; }
    friend bool operator>(const Dual& a, const Dual& b) { return b.value_ < a.value_; }
    friend bool operator<=(const Dual& a, const Dual& b) { return a.value_ <= b.value_; }
    friend bool operator>=(const Dual& a, const Dual& b) { return b.value_ <= a.value_; }
    friend bool operator==(const Dual& a, const Dual& b) { return a.value_ == b.value_; }
    friend bool operator!=(const Dual& a, const Dual& b) { return a.value_ != b.value_; }

private:
    static Dual combined(const T& value, const Dual& a, const T& by_a, const Dual& b, const T& by_b) {
        Dual out(value);
        for (std::size_t i = 0; i < N; ++i) out.partials_[i] = by_a * a.partials_[i] + by_b * b.partials_[i];
        return out;
    }

    T value_{0};
    Partials partials_{};
};

// At zero the derivative of the root is taken as zero, which is right for roots of squares, such as a speed of zero.
template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& x) {
    const T root = sqrt(x.value());
    return x.chained(root, root > T(0) ? T(T(0.5) / root) : T(0));
}
template <class T, int N>
Dual<T, N> abs(const Dual<T, N>& x) {
    return x.value() < T(0) ? -x : x;
}
template <class T, int N>
Dual<T, N> min(const Dual<T, N>& a, const Dual<T, N>& b) {
    return a.value() < b.value() ? a : b;
}
template <class T, int N>
Dual<T, N> max(const Dual<T, N>& a, const Dual<T, N>& b) {
    return a.value() > b.value() ? a : b;
}
template <class T, int N>
double value_of(const Dual<T, N>& x) {
    return value_of(x.value());
}
template <class T, int N>
SineCosine<Dual<T, N>> sincos(const Dual<T, N>& angle) {
    const auto [s, c] = sincos(angle.value());
    return {angle.chained(s, c), angle.chained(c, -s)};
}
template <class T, int N>
Dual<T, N> arctangent(const Dual<T, N>& x) {
    return x.chained(arctangent(x.value()), T(T(1) / (T(1) + x.value() * x.value())));
}
template <class T, int N>
Dual<T, N> arctangent(const Dual<T, N>& y, const Dual<T, N>& x) {
    return arctangent(y / x);
}
template <class T, int N>
Dual<T, N> sine(const Dual<T, N>& angle) {
    return angle.chained(sine(angle.value()), cosine(angle.value()));
}
template <class T, int N>
Dual<T, N> cosine(const Dual<T, N>& angle) {
    return angle.chained(cosine(angle.value()), T(-sine(angle.value())));
}
template <class T, int N>
Dual<T, N> exponential(const Dual<T, N>& x) {
    const T value = exponential(x.value());
    return x.chained(value, value);
}
template <class T, int N>
Dual<T, N> logarithm(const Dual<T, N>& x) {
    return x.chained(logarithm(x.value()), T(T(1) / x.value()));
}

// The value of a dual number; a plain number itself.
inline double without_partials(double x) {
    return x;
}
template <class T, int N>
const T& without_partials(const Dual<T, N>& x) {
    return x.value();
}

// f(x, y) from a known value and known partial derivatives.
inline double chained(double value, double, double, double, double) {
    return value;
}
template <class T, int N>
Dual<T, N> chained(const T& value, const Dual<T, N>& x, const T& slope_x, const Dual<T, N>& y, const T& slope_y) {
    std::array<T, N> partials;
    for (int i = 0; i < N; ++i) partials[static_cast<std::size_t>(i)] = slope_x * x.partial(i) + slope_y * y.partial(i);
    return {value, partials};
}

}  // namespace hamilcar
