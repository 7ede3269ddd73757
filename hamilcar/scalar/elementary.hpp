// Arc tangent, sine, exponential and logarithm for every scalar by the same additions, multiplications and one division, so that
// a lane, a double and any machine get the same bits. Tire formulas use them: each is branch-free code that many lanes run
// together, and several of them side by side hide each other's latency.
//
// Errors stay below 4 units of the last place for any argument of the arc tangent and for angles below 50 rad, below 60 for
// the exponential of |x| < 5 and the logarithm (tests/scalar/elementary_test.cpp measures them). The polynomials of
// sine and arc tangent minimize the relative error (Remez exchange in 50 digits: 1.2e-16 and 3.4e-17); the arc tangent in
// single precision is that of Cephes (atanf.c).
#pragma once

#include <array>

#include "hamilcar/scalar/sincos.hpp"

namespace hamilcar {

namespace detail {

template <class Element>
struct ElementaryConstants {
    static constexpr double half_pi = 1.57079632679489661923;
    static constexpr double pi[2] = {3.14159265160560607910, 1.98418715936108088328e-9};  // 30 bits, and the rest
    static constexpr double inverse_pi = 0.318309886183790671538;
    static constexpr double round = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
    static constexpr double arctangent[10] = {0.33333333333330218425,  -0.19999999999104667983, 0.14285714196523826432,
                                              -0.11111106703400403163, 0.09090783524850441646,  -0.07690083304962501793,
                                              0.06641245861906453629,  -0.05693163055775933377, 0.04360821106438762076,
                                              -0.02128009835394213595};
    static constexpr double sine[7] = {-0.16666666666666260186,   0.0083333333332912600501,  -1.9841269826536777579e-4,
                                       2.7557316777245457047e-6,  -2.5051890955707595583e-8, 1.6048413523376057271e-10,
                                       -7.3770529581877735606e-13};
};
template <>
struct ElementaryConstants<float> {
    static constexpr float half_pi = 1.57079632679f;
    static constexpr float pi[2] = {3.140625f, 9.67653589793e-4f};
    static constexpr float inverse_pi = 0.318309886f;
    static constexpr float round = 12582912.0f;  // 1.5 * 2^23
    static constexpr float arctangent[4] = {3.33329491539e-1f, -1.99777106478e-1f, 1.38776856032e-1f,
                                            -8.05374449538e-2f};
    static constexpr float sine[4] = {-1.66666604624e-1f, 8.33308816792e-3f, -1.98111127755e-4f, 2.60893267965e-6f};
};

// The polynomial as its even and odd part, which are independent of each other.
template <class T, class Coefficient, std::size_t n>
T split_polynomial(const Coefficient (&c)[n], const T& z) {
    constexpr std::size_t last_even = (n - 1) / 2 * 2, last_odd = n / 2 * 2 - 1;
    const T zz = z * z;
    T even(c[last_even]), odd(c[last_odd]);
    for (std::size_t i = last_even; i >= 2; i -= 2) even = even * zz + T(c[i - 2]);
    for (std::size_t i = last_odd; i >= 3; i -= 2) odd = odd * zz + T(c[i - 2]);
    return even + z * odd;
}

// atan(size / x) as zero, pi/4 or pi/2 plus the arc tangent of above / below, which is at most tan(pi/8).
template <class T>
struct ReducedArctangent {
    T above, below, offset;

    ReducedArctangent() = default;
    ReducedArctangent(const T& size, const T& x) {
        const T half_pi =
            in_precision<T>([](auto element) { return T(ElementaryConstants<decltype(element)>::half_pi); });
        const T quarter_pi =
            in_precision<T>([](auto element) { return T(ElementaryConstants<decltype(element)>::half_pi / 2); });
        const auto steep = size > T(2.41421356237309504880) * x, slanted = size > T(0.41421356237309504880) * x;
        above = select(steep, T(-x), select(slanted, T(size - x), size));
        below = select(steep, size, select(slanted, T(size + x), x));
        offset = select(steep, half_pi, select(slanted, quarter_pi, T(0)));
    }
    // `t`: above / below; `y` gives the sign.
    T angle(const T& y, const T& t) const {
        const T z = t * t;
        const T series = in_precision<T>(
            [&](auto element) -> T { return split_polynomial(ElementaryConstants<decltype(element)>::arctangent, z); });
        const T size = offset + (t - t * z * series);
        return select(y < T(0), T(-size), size);
    }
};

}  // namespace detail

// 1 / x of several numbers with one division, which costs about ten multiplications and does not pipeline. The product of the
// numbers must neither vanish nor overflow.
template <class T, std::size_t n>
std::array<T, n> reciprocals(const std::array<T, n>& x) {
    std::array<T, n> product{x[0]}, out;
    for (std::size_t i = 1; i < n; ++i) product[i] = product[i - 1] * x[i];
    T rest = T(1) / product[n - 1];
    for (std::size_t i = n - 1; i > 0; --i) out[i] = rest * product[i - 1], rest = rest * x[i];
    out[0] = rest;
    return out;
}

// atan(y / x) for x > 0, between -pi/2 and pi/2 [rad], with a single division. Beyond tan(pi/8) the argument is reduced by pi/4 or
// pi/2.
template <class T>
T arctangent(const T& y, const T& x) {
    const detail::ReducedArctangent<T> turned(abs(y), x);
    return turned.angle(y, T(turned.above / turned.below));
}
// Several of them with one division, for x >= 1; |y| is limited to 1e8 x.
template <class T, std::size_t n>
std::array<T, n> arctangents(const std::array<T, n>& y, const std::array<T, n>& x) {
    std::array<detail::ReducedArctangent<T>, n> turned;
    std::array<T, n> below, out;
    for (std::size_t i = 0; i < n; ++i) {
        turned[i] = detail::ReducedArctangent<T>(min(abs(y[i]), T(1e8) * x[i]), x[i]);
        below[i] = turned[i].below;
    }
    const std::array<T, n> inverse = reciprocals(below);
    for (std::size_t i = 0; i < n; ++i) out[i] = turned[i].angle(y[i], T(turned[i].above * inverse[i]));
    return out;
}
template <class T>
T arctangent(const T& x) {
    return arctangent(x, T(1));
}

// The angle of (x, y) all around, as std::atan2, without the signs of zeros; 0 at the origin [rad].
template <class T>
T angle_of(const T& y, const T& x) {
    const T pi =
        in_precision<T>([](auto element) { return T(2) * T(detail::ElementaryConstants<decltype(element)>::half_pi); });
    const T size = arctangent(T(abs(y)), T(max(T(abs(x)), T(1e-30))));
    const T around = select(x < T(0), T(pi - size), size);
    return select(y < T(0), T(-around), around);
}
// Of a number that round-off may have carried beyond 1 or -1 [rad].
template <class T>
T arcsine(const T& x) {
    const T sine = clamp(x, T(-1), T(1));
    return arctangent(sine, T(max(T(sqrt((T(1) - sine) * (T(1) + sine))), T(1e-30))));
}

namespace detail {

// sin(r) for |r| <= pi/2, with the sign changed where `half_turns` is odd.
template <class T>
T sine_of_half_turn(const T& r, const T& half_turns, const T& big) {
    const T z = r * r;
    const T series = in_precision<T>(
        [&](auto element) -> T { return split_polynomial(ElementaryConstants<decltype(element)>::sine, z); });
    const T value = r + r * z * series;
    const T odd = abs(half_turns - T(2) * ((half_turns * T(0.5) + big) - big));
    return select(odd == T(1), T(-value), value);
}

}  // namespace detail

// Sine alone, of an angle [rad]: one polynomial, where sincos needs two.
template <class T>
T sine(const T& angle) {
    return in_precision<T>([&](auto element) -> T {
        using C = detail::ElementaryConstants<decltype(element)>;
        const T big(C::round);
        const T n = (angle * T(C::inverse_pi) + big) - big;
        return detail::sine_of_half_turn<T>((angle - n * T(C::pi[0])) - n * T(C::pi[1]), n, big);
    });
}

// Cosine alone. It is even, so pi/2 is subtracted from the magnitude: cos(x) = sin(pi/2 - |x|).
template <class T>
T cosine(const T& angle) {
    return in_precision<T>([&](auto element) -> T {
        using C = detail::ElementaryConstants<decltype(element)>;
        const T big(C::round), size = abs(angle);
        const T n = (size * T(C::inverse_pi) - T(0.5) + big) - big, quarter = n + T(0.5);  // size = (n + 1/2) pi + r
        const T r = (size - quarter * T(C::pi[0])) - quarter * T(C::pi[1]);
        return -detail::sine_of_half_turn<T>(r, n, big);
    });
}

// e^x for |x| < 40, constant beyond: the Pade approximant at x/8, squared three times.
template <class T>
T exponential(const T& x) {
    const T y = clamp(x, T(-40), T(40)) * T(1.0 / 8), z = y * y;
    const T even = T(1) + z * (T(5.0 / 44) + z * (T(1.0 / 792) + z * T(1.0 / 665280)));
    const T odd = y * (T(0.5) + z * (T(1.0 / 66) + z * T(1.0 / 15840)));
    const T root = (even + odd) / (even - odd), square = root * root, fourth = square * square;
    return fourth * fourth;
}

// ln x for 1e-4 < x < 1e4: the series of the inverse hyperbolic tangent for the sixteenth root of x.
template <class T>
T logarithm(const T& x) {
    const T root = sqrt(sqrt(sqrt(sqrt(x)))), t = (root - T(1)) / (root + T(1)), z = t * t;
    T sum(1.0 / 17);
    for (int k = 7; k >= 0; --k) sum = sum * z + T(1.0 / (2 * k + 1));
    return T(32) * t * sum;
}

}  // namespace hamilcar
