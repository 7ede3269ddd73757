// Derivatives by central differences of fourth order, independent of the formulas under test.
#pragma once

#include <type_traits>

namespace hamilcar::test {

// df/dx at x for numbers and matrices. The error is about step^4 f'''''/30 + 1.5e-16 |f| / step.
template <class F>
auto derivative(F&& f, double x, double step = 1e-3) {
    using Value = std::decay_t<decltype(f(x))>;
    const Value near = f(x + step) - f(x - step), far = f(x + 2 * step) - f(x - 2 * step);
    const Value result = (8 * near - far) / (12 * step);
    return result;
}

}  // namespace hamilcar::test
