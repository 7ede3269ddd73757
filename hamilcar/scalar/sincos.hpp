// Sine and cosine for every scalar by the same additions and multiplications, so that a lane, a double and any machine get
// the same bits. The angle is reduced to [-pi/4, pi/4] with a three-part pi/2 (Cody and Waite), where two polynomials apply.
//
// Errors stay below 1.5 units of the last place for |angle| < 100, below 2.5 up to 1e5 in double and 1e3 in float; beyond,
// the reduction loses digits gradually (tests/scalar/sincos_test.cpp measures them). The polynomials are those of FreeBSD's msun
// (k_sin.c, k_cos.c) and, for float, Cephes (sinf.c).
#pragma once

#include <array>

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Sine and cosine of one angle [rad].
template <class T>
struct SineCosine {
    T sine, cosine;
};

namespace detail {

template <class Element>
struct SineCosineConstants {
    static constexpr double round = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
    static constexpr double half_pi[3] = {1.57079632673412561417, 6.07710050630396597660e-11,
                                          2.02226624879595063154e-21};
    static constexpr double sine[6] = {-1.66666666666666324348e-01, 8.33333333332248946124e-03,
                                       -1.98412698298579493134e-04, 2.75573137070700676789e-06,
                                       -2.50507602534068634195e-08, 1.58969099521155010221e-10};
    static constexpr double cosine[6] = {4.16666666666666019037e-02, -1.38888888888741095749e-03,
                                         2.48015872894767294178e-05, -2.75573143513906633035e-07,
                                         2.08757232129817482790e-09, -1.13596475577881948265e-11};
};
template <>
struct SineCosineConstants<float> {
    static constexpr float round = 12582912.0f;  // 1.5 * 2^23
    static constexpr float half_pi[3] = {1.5703125f, 4.837512969970703125e-4f, 7.549789948768648e-8f};
    static constexpr float sine[3] = {-1.6666654611e-1f, 8.3321608736e-3f, -1.9515295891e-4f};
    static constexpr float cosine[3] = {4.166664568298827e-2f, -1.388731625493765e-3f, 2.443315711809948e-5f};
};

// c[0] + z (c[1] + z (...))
template <class T, class Coefficient, std::size_t n>
T polynomial(const Coefficient (&c)[n], const T& z) {
    T sum(c[n - 1]);
    for (std::size_t i = n - 1; i-- > 0;) sum = sum * z + T(c[i]);
    return sum;
}

}  // namespace detail

// For angles within [-pi/4, pi/4].
template <class T>
SineCosine<T> sincos_of_reduced(const T& x) {
    return in_precision<T>([&](auto element) -> SineCosine<T> {
        using C = detail::SineCosineConstants<decltype(element)>;
        const T z = x * x;
        return {x + x * z * detail::polynomial(C::sine, z),
                T(1) - (T(0.5) * z - z * z * detail::polynomial(C::cosine, z))};
    });
}

namespace detail {

// An angle as quarter turns and the rest, between -pi/4 and pi/4 [rad].
template <class T>
struct ReducedAngle {
    T big, turns, rest;  // `big` rounds what it is added to
};
template <class T>
ReducedAngle<T> reduce(const T& angle) {
    return in_precision<T>([&](auto element) -> ReducedAngle<T> {
        using C = SineCosineConstants<decltype(element)>;
        const T big(C::round);
        const T turns = (angle * T(0.636619772367581343076) + big) - big;
        return {big, turns, ((angle - turns * T(C::half_pi[0])) - turns * T(C::half_pi[1])) - turns * T(C::half_pi[2])};
    });
}

}  // namespace detail

// For any angle.
template <class T>
SineCosine<T> sincos_with_reduction(T angle) {
    const auto [big, turns, x] = detail::reduce(angle);
    const auto [s, c] = sincos_of_reduced(x);
    // turns modulo 4 as one of -2, -1, 0, 1, 2
    const T quarter = turns - T(4) * ((turns * T(0.25) + big) - big);
    const auto odd = abs(quarter) == T(1);
    const T sine = select(odd, c, s), cosine = select(odd, s, c);
    return {select(quarter < T(0) || quarter == T(2), T(-sine), sine),
            select(quarter == T(1) || abs(quarter) == T(2), T(-cosine), cosine)};
}

// Linkage angles are mostly below pi/4, where the reduction would not change a bit.
template <class T>
SineCosine<T> sincos(const T& angle) {
    const auto pair = [](const SineCosine<T>& both) { return std::array{both.sine, both.cosine}; };
    const auto [sine, cosine] = unless(
        !(abs(angle) <= T(0.78)), [&]() { return pair(sincos_of_reduced(angle)); },
        [&]() { return pair(sincos_with_reduction(angle)); });
    return {sine, cosine};
}

}  // namespace hamilcar
