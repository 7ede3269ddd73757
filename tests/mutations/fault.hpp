// One fault at a time, chosen by the environment variable HAMILCAR_FAULT: tools/mutate.py puts these calls into a copy of the sources.
#pragma once

#include <cstdlib>
#include <type_traits>

namespace hamilcar_fault {

// Number of the fault that this process has; 0: none.
inline const int active = [] {
    const char* number = std::getenv("HAMILCAR_FAULT");
    return number ? std::atoi(number) : 0;
}();

// The value of an expression: Eigen's sums and products are evaluated, references are copied.
template <class X>
auto plain(const X& x) {
    if constexpr (requires { x.eval(); }) {
        return x.eval();
    } else {
        return x;
    }
}

template <class Original, class Fault>
auto pick(int number, Original&& original, Fault&& fault) -> decltype(original()) {
    if (active == number) return fault();
    return original();
}

}  // namespace hamilcar_fault
