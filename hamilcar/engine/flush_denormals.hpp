// Sets flush-to-zero and denormals-are-zero (FTZ, DAZ) for its lifetime: states of a car at rest decay into denormals, which
// many processors compute a hundred times slower.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace hamilcar {

class FlushDenormals {
public:
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;
#if defined(__SSE2__)
    FlushDenormals() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | to_zero);
    }
    ~FlushDenormals() {
        _mm_setcsr(before_);
    }

private:
    static constexpr unsigned to_zero = 0x8040;  // FTZ for results, DAZ for arguments
    unsigned before_;
#elif defined(__aarch64__)
    FlushDenormals() {
        asm volatile("mrs %0, fpcr" : "=r"(before_));
        asm volatile("msr fpcr, %0" : : "r"(before_ | (1UL << 24)));
    }
    ~FlushDenormals() {
        asm volatile("msr fpcr, %0" : : "r"(before_));
    }

private:
    unsigned long before_;
#else
    FlushDenormals() {}
#endif
};

}  // namespace hamilcar
