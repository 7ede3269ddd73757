// Lanes: N numbers that take every step together, one vector register wide. A thin face over xsimd, which chooses the
// instructions; comparisons give masks, and a mask is never a bool, so that no `if` can mean "in some lane" unseen.
//
// Every operation is that of IEEE 754 in each lane, none is fused: a lane computes the bits that a lone number does.
#pragma once

#include <xsimd/xsimd.hpp>

#include <array>
#include <utility>

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

namespace detail {
template <std::size_t bytes>
struct VectorArchitecture;
template <>
struct VectorArchitecture<16> {
#if XSIMD_WITH_SSE4_2
    using type = xsimd::sse4_2;
#elif XSIMD_WITH_SSE2
    using type = xsimd::sse2;
#elif XSIMD_WITH_NEON64
    using type = xsimd::neon64;
#endif
};
#if XSIMD_WITH_AVX2
template <>
struct VectorArchitecture<32> {
    using type = xsimd::avx2;
};
#endif
#if XSIMD_WITH_AVX512DQ
template <>
struct VectorArchitecture<64> {
    using type = xsimd::avx512dq;
};
#endif
}  // namespace detail

template <class T, int N>
using Register = xsimd::batch<T, typename detail::VectorArchitecture<sizeof(T) * N>::type>;

// A condition per lane.
template <class T, int N>
struct Mask {
    using Bits = typename Register<T, N>::batch_bool_type;
    Bits bits;
    explicit operator bool() const = delete;

    HAMILCAR_CORE friend Mask operator&&(const Mask& a, const Mask& b) { return {a.bits & b.bits}; }
    HAMILCAR_CORE friend Mask operator||(const Mask& a, const Mask& b) { return {a.bits | b.bits}; }
    HAMILCAR_CORE friend Mask operator!(const Mask& a) { return {!a.bits}; }
    HAMILCAR_CORE friend bool any(const Mask& a) { return xsimd::any(a.bits); }
};

template <class T, int N>
struct Pack {
    using Value = Register<T, N>;
    Value value;

    Pack() = default;
    HAMILCAR_CORE Pack(T same) : value(same) {}  // implicit: constants enter formulas as numbers
    template <class Number>
    requires(std::is_arithmetic_v<Number> && !std::is_same_v<Number, T>) HAMILCAR_CORE Pack(Number same)
        : value(static_cast<T>(same)) {}
    HAMILCAR_CORE explicit Pack(const Value& lanes) : value(lanes) {}
    HAMILCAR_CORE explicit Pack(const std::array<T, N>& lanes) {
        [&]<std::size_t... i>(std::index_sequence<i...>) HAMILCAR_INLINED {
            value = typename Value::register_type{lanes[i]...};  // of the compiler's own vectors: no way through memory
        }
        (std::make_index_sequence<N>());
    }

    HAMILCAR_CORE friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.value + b.value); }
    HAMILCAR_CORE friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.value - b.value); }
    HAMILCAR_CORE friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.value * b.value); }
    HAMILCAR_CORE friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.value / b.value); }
    HAMILCAR_CORE friend Pack operator-(const Pack& a) { return Pack(-a.value); }
    HAMILCAR_CORE Pack& operator+=(const Pack& b) { return *this = *this + b; }
    HAMILCAR_CORE Pack& operator-=(const Pack& b) { return *this = *this - b; }
    HAMILCAR_CORE Pack& operator*=(const Pack& b) { return *this = *this * b; }
    HAMILCAR_CORE Pack& operator/=(const Pack& b) { return *this = *this / b; }
    HAMILCAR_CORE friend Mask<T, N> operator<(const Pack& a, const Pack& b) { return {a.value < b.value}; }
    HAMILCAR_CORE friend Mask<T, N> operator>(const Pack& a, const Pack& b) { return {b.value < a.value}; }
    HAMILCAR_CORE friend Mask<T, N> operator<=(const Pack& a, const Pack& b) { return {a.value <= b.value}; }
    HAMILCAR_CORE friend Mask<T, N> operator>=(const Pack& a, const Pack& b) { return {b.value <= a.value}; }
    HAMILCAR_CORE friend Mask<T, N> operator==(const Pack& a, const Pack& b) { return {a.value == b.value}; }
    HAMILCAR_CORE friend Mask<T, N> operator!=(const Pack& a, const Pack& b) { return {a.value != b.value}; }

    HAMILCAR_CORE friend Pack sqrt(const Pack& x) { return Pack(xsimd::sqrt(x.value)); }
    HAMILCAR_CORE friend Pack abs(const Pack& x) { return Pack(xsimd::fabs(x.value)); }
    // The second number where the lanes do not compare, as for doubles; so x86-64 does.
    HAMILCAR_CORE friend Pack min(const Pack& a, const Pack& b) { return Pack(xsimd::min(a.value, b.value)); }
    HAMILCAR_CORE friend Pack max(const Pack& a, const Pack& b) { return Pack(xsimd::max(a.value, b.value)); }
};

template <class T, int N>
HAMILCAR_CORE Pack<T, N> select(const Mask<T, N>& condition, const Pack<T, N>& yes, const Pack<T, N>& no) {
    return Pack<T, N>(xsimd::select(condition.bits, yes.value, no.value));
}

template <class T, int N>
struct Lanes<Pack<T, N>> {
    static constexpr int count = N;
    using Element = T;
    using Vector = typename Pack<T, N>::Value::register_type;
    HAMILCAR_CORE static T get(const Pack<T, N>& number, int i) { return static_cast<Vector>(number.value)[i]; }
    HAMILCAR_CORE static void set(Pack<T, N>& number, int i, const T& element) {
        Vector lanes = number.value;
        lanes[i] = element;
        number.value = lanes;
    }
};

}  // namespace hamilcar
