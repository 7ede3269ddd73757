#include "hamilcar/program/executable.hpp"
#include "hamilcar/program/portable.hpp"
#if defined(__x86_64__)
#include "hamilcar/program/x86_backend.hpp"
#endif

namespace hamilcar::program {

const std::vector<Backend>& backends() {
    static const std::vector<Backend> all {
#if defined(__x86_64__)
        {"avx512", 64, has_avx512, compile_avx512}, {"avx2", 32, has_avx2, compile_avx2},
            {"sse2", 16, has_sse2, compile_sse2},
#endif
            {"portable", 64, [] { return true; }, compile_portable},
    };
    return all;
}

}  // namespace hamilcar::program
