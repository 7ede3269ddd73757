// The widest packs of the instruction set at hand.
#pragma once

#include "hamilcar/math/pack.hpp"

namespace hamilcar {

#if XSIMD_WITH_AVX512DQ
inline constexpr int register_bytes = 64;
#elif XSIMD_WITH_AVX2
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif
inline constexpr int lanes_double = register_bytes / sizeof(double), lanes_single = register_bytes / sizeof(float);

}  // namespace hamilcar
