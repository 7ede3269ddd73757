// The backend for x86-64: machine code with SSE2, AVX2 or AVX-512, by AsmJit's assembler.
#pragma once

#if defined(__x86_64__)

#include <memory>

#include "hamilcar/program/executable.hpp"
#include "hamilcar/program/graph.hpp"

namespace hamilcar::program {

// Whether processor and system support it.
bool has_sse2();
bool has_avx2();
bool has_avx512();  // with its F, DQ, VL and BW

// As Backend::compile. Results have the same bits as the portable backend's, lane by lane; MXCSR is left as the caller set it.
std::unique_ptr<Executable> compile_sse2(const Graph& graph, bool car_in_each_lane);
std::unique_ptr<Executable> compile_avx2(const Graph& graph, bool car_in_each_lane);
std::unique_ptr<Executable> compile_avx512(const Graph& graph, bool car_in_each_lane);

}  // namespace hamilcar::program

#endif
