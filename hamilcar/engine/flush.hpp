// Numbers too small to have all their digits become zero while this is alive: what decays in a car at rest would end among
// them, and many processors take a hundred times longer for each.
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace hamilcar {

class FlushTinyNumbers {
public:
    FlushTinyNumbers(const FlushTinyNumbers&) = delete;
    FlushTinyNumbers& operator=(const FlushTinyNumbers&) = delete;
#if defined(__SSE2__)
    FlushTinyNumbers() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | to_zero);
    }
    ~FlushTinyNumbers() {
        _mm_setcsr(before_);
    }

private:
    static constexpr unsigned to_zero = 0x8040;  // results and arguments
    unsigned before_;
#elif defined(__aarch64__)
    FlushTinyNumbers() {
        asm volatile("mrs %0, fpcr" : "=r"(before_));
        asm volatile("msr fpcr, %0" : : "r"(before_ | (1UL << 24)));
    }
    ~FlushTinyNumbers() {
        asm volatile("msr fpcr, %0" : : "r"(before_));
    }

private:
    unsigned long before_;
#else
    FlushTinyNumbers() {}
#endif
};

}  // namespace hamilcar
