// This file alone is compiled so that products and sums are fused where the instruction set can.
#include "hamilcar/bench/peak.hpp"

#if defined(__x86_64__)
#define HAMILCAR_TARGET(set) [[gnu::target(set)]]
#else
#define HAMILCAR_TARGET(set)
#endif

namespace hamilcar {

namespace {

constexpr int chains = 12;  // more than latency times units of any core, few enough for 16 registers

template <class Number, int bytes>
struct Register {
    typedef Number type __attribute__((vector_size(bytes)));
};

template <class Number, int bytes>
[[gnu::always_inline]] inline double rounds_of(long rounds) {
    typename Register<Number, bytes>::type sum[chains], factor = {}, term = {};
    factor += static_cast<Number>(0.999), term += static_cast<Number>(1e-3);
    for (int i = 0; i < chains; ++i) sum[i] = term * static_cast<Number>(i);
    asm volatile("" : "+m"(factor), "+m"(term));  // unknown to the compiler, which would sum the series
    for (long n = 0; n < rounds; ++n) {
#pragma GCC unroll 12
        for (int i = 0; i < chains; ++i) sum[i] = sum[i] * factor + term;
    }
    for (auto& s : sum) asm volatile("" : : "m"(s));
    constexpr int lanes = bytes / static_cast<int>(sizeof(Number));
    return 2.0 * chains * lanes * static_cast<double>(rounds);
}

HAMILCAR_TARGET("avx512f") double doubles_of_64(long rounds) {
    return rounds_of<double, 64>(rounds);
}
HAMILCAR_TARGET("avx512f") double singles_of_64(long rounds) {
    return rounds_of<float, 64>(rounds);
}
HAMILCAR_TARGET("avx2,fma") double doubles_of_32(long rounds) {
    return rounds_of<double, 32>(rounds);
}
HAMILCAR_TARGET("avx2,fma") double singles_of_32(long rounds) {
    return rounds_of<float, 32>(rounds);
}
double doubles_of_16(long rounds) {
    return rounds_of<double, 16>(rounds);
}
double singles_of_16(long rounds) {
    return rounds_of<float, 16>(rounds);
}

}  // namespace

double multiply_and_add(const Engine& engine, Precision precision, long rounds) {
    const bool singles = precision == Precision::single_precision;
    if (engine.name == "avx512") return singles ? singles_of_64(rounds) : doubles_of_64(rounds);
    if (engine.name == "avx2") return singles ? singles_of_32(rounds) : doubles_of_32(rounds);
    return singles ? singles_of_16(rounds) : doubles_of_16(rounds);
}

}  // namespace hamilcar
