// Mistakes of programmers, not of people: HAMILCAR_ASSERT(condition) ends the program with the place and the condition. Looked for in
// debug and sanitized builds; elsewhere the condition is only compiled.
#pragma once

namespace hamilcar {

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace hamilcar

#if !defined(NDEBUG) || defined(HAMILCAR_SANITIZED)
#define HAMILCAR_ASSERT(condition) \
    ((condition) ? static_cast<void>(0) : ::hamilcar::assertion_failed(#condition, __FILE__, __LINE__))
#else
#define HAMILCAR_ASSERT(condition) static_cast<void>(sizeof((condition) ? 1 : 0))
#endif
