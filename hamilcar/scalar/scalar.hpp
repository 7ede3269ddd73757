// The operations that the core requires of a scalar, such that a recording number supports them too: choices are values, never
// branches.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>

namespace hamilcar {

// `condition ? yes : no` as a function; recording numbers overload it.
template <class T>
T select(bool condition, const T& yes, const T& no) {
    return condition ? yes : no;
}

// Whether a condition holds in any lane; the only test that may skip work.
inline bool any(bool condition) {
    return condition;
}

// An array of numbers: `rare()` if the condition holds in any lane, `common()` otherwise. Where it does not hold both must give the
// same result, so that a lane never depends on its neighbors.
template <class Condition, class Common, class Rare>
auto unless(const Condition& condition, const Common& common, const Rare& rare) {
    if (any(condition)) [[unlikely]]
        return rare();
    return common();
}

template <std::floating_point T>
T sqrt(T x) {
    return std::sqrt(x);
}
template <std::floating_point T>
T abs(T x) {
    return std::fabs(x);
}
template <std::floating_point T>
T min(T a, T b) {
    return a < b ? a : b;
}
template <std::floating_point T>
T max(T a, T b) {
    return a > b ? a : b;
}

// min(max(x, low), high), for low <= high.
template <class T>
T clamp(const T& x, const T& low, const T& high) {
    return min(max(x, low), high);
}

// a / sqrt(x); root and division are independent, since both have high latency.
template <class T>
T over_root(const T& a, const T& x) {
    return sqrt(x) * (a / x);
}

// The value of a scalar as a double, for decisions outside a step.
template <std::floating_point T>
double value_of(T x) {
    return x;
}

// The lanes of a number: one, unless it holds several side by side. `Element` is the type of a lane.
template <class T>
struct Lanes {
    static constexpr int count = 1;
    using Element = T;
    static constexpr const T& get(const T& number, int) { return number; }
    static constexpr void set(T& number, int, const T& element) { number = element; }
};
template <class T>
inline constexpr int lane_count = Lanes<T>::count;
template <class T>
using Element = typename Lanes<T>::Element;

// The precision that a number computes in: `choose` calls f with a zero of type float or double.
template <class T>
struct PrecisionOf {
    template <class F>
    static auto choose(const F& f) {
        return f(std::conditional_t<std::is_same_v<Element<T>, float>, float, double>{});
    }
};
// For formulas whose constants differ between float and double.
template <class T, class F>
auto in_precision(const F& f) {
    return PrecisionOf<T>::choose(f);
}

// Lane `i` of a number.
template <class T>
Element<T> lane(const T& number, int i) {
    return Lanes<T>::get(number, i);
}
template <class T>
void set_lane(T& number, int i, const Element<T>& element) {
    Lanes<T>::set(number, i, element);
}

}  // namespace hamilcar
