// As many chains of multiply-adds as hide the latency of one. This file alone is compiled so that they are fused where the
// instruction set can.
#include "hamilcar/engine/engine.hpp"
#include "hamilcar/engine/lanes.hpp"

namespace hamilcar::engine_parts {

namespace {

constexpr int chains = 12;  // more than latency times units of any core, few enough for 16 registers

template <class Batch>
double multiply_and_add_with(long rounds) {
    using Number = typename Batch::value_type;
    Batch sum[chains], factor(static_cast<Number>(0.999)), term(static_cast<Number>(1e-3));
    for (int i = 0; i < chains; ++i) sum[i] = Batch(static_cast<Number>(i));
    asm volatile("" : "+x"(factor.data), "+x"(term.data));  // unknown to the compiler, which would sum the series
    for (long n = 0; n < rounds; ++n) {
#pragma GCC unroll 12
        for (int i = 0; i < chains; ++i) sum[i] = sum[i] * factor + term;
    }
    for (Batch& s : sum) asm volatile("" : : "x"(s.data));
    return 2.0 * chains * static_cast<double>(Batch::size) * static_cast<double>(rounds);
}

}  // namespace

double multiply_and_add(Precision precision, long rounds) {
    if (precision == Precision::single_precision) return multiply_and_add_with<Register<float, lanes_single>>(rounds);
    return multiply_and_add_with<Register<double, lanes_double>>(rounds);
}

}  // namespace hamilcar::engine_parts
