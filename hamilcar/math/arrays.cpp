#include "hamilcar/math/arrays.hpp"

#include <bit>
#include <cstdint>
#include <limits>

// Compiles a function in several versions, of which the loader picks the best; sanitizers do not support this.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(HAMILCAR_SANITIZED)
#define HAMILCAR_FOR_EVERY_SET [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define HAMILCAR_FOR_EVERY_SET
#endif

namespace hamilcar {

namespace {

// With the number of terms known at compile time, they stay in registers.
template <int count, class T>
[[gnu::always_inline]] inline void add_terms(const T* from, const T* const* rate, const T* weight, T* to, int size) {
    const T* terms[count];
    T weights[count];
    for (int j = 0; j < count; ++j) terms[j] = rate[j], weights[j] = weight[j];
#pragma GCC ivdep
    for (int i = 0; i < size; ++i) {
        T sum = weights[0] * terms[0][i];
#pragma GCC unroll 8
        for (int j = 1; j < count; ++j) sum += weights[j] * terms[j][i];
        to[i] = from[i] + sum;
    }
}

template <class T>
[[gnu::always_inline]] inline void add_any(const T* from, const T* const* rate, const T* weight, int count, T* to,
                                           int size) {
    switch (count) {
        case 1: return add_terms<1>(from, rate, weight, to, size);
        case 2: return add_terms<2>(from, rate, weight, to, size);
        case 3: return add_terms<3>(from, rate, weight, to, size);
        case 4: return add_terms<4>(from, rate, weight, to, size);
        case 5: return add_terms<5>(from, rate, weight, to, size);
        case 6: return add_terms<6>(from, rate, weight, to, size);
        case 7: return add_terms<7>(from, rate, weight, to, size);
        default: return add_weighted<T>(from, rate, weight, count, to, size);
    }
}

template <class T>
[[gnu::always_inline]] inline void add_one(const T& weight, const T* x, T* to, int size) {
    const T w = weight;
#pragma GCC ivdep
    for (int i = 0; i < size; ++i) to[i] += w * x[i];
}

// The exponent of infinities and NaN is all ones.
template <class Bits, class T>
[[gnu::always_inline]] inline bool none_is_infinite(const T* numbers, int size) {
    constexpr Bits exponent = std::bit_cast<Bits>(std::numeric_limits<T>::infinity());
    Bits found = 0;
    for (int i = 0; i < size; ++i) {
        found |= (std::bit_cast<Bits>(numbers[i]) & exponent) == exponent ? ~Bits{0} : Bits{0};
    }
    return found == 0;
}

}  // namespace

HAMILCAR_FOR_EVERY_SET
void add_weighted(const double* from, const double* const* rate, const double* weight, int count, double* to,
                  int size) {
    add_any(from, rate, weight, count, to, size);
}
HAMILCAR_FOR_EVERY_SET
void add_weighted(const float* from, const float* const* rate, const float* weight, int count, float* to, int size) {
    add_any(from, rate, weight, count, to, size);
}
HAMILCAR_FOR_EVERY_SET
void add_scaled(const double& weight, const double* x, double* to, int size) {
    add_one(weight, x, to, size);
}
HAMILCAR_FOR_EVERY_SET
void add_scaled(const float& weight, const float* x, float* to, int size) {
    add_one(weight, x, to, size);
}

HAMILCAR_FOR_EVERY_SET
bool all_finite(const double* numbers, int size) {
    return none_is_infinite<std::uint64_t>(numbers, size);
}
HAMILCAR_FOR_EVERY_SET
bool all_finite(const float* numbers, int size) {
    return none_is_infinite<std::uint32_t>(numbers, size);
}

}  // namespace hamilcar
