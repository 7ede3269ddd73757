// What the core asks of a number, written so that one that records can answer too: choices are values, never branches.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>

namespace hamilcar {

// `condition ? yes : no` as a function; numbers that record overload it.
template <class T>
T select(bool condition, const T& yes, const T& no) {
    return condition ? yes : no;
}

// Whether a condition holds in any lane: the only question that may skip work.
inline bool any(bool condition) {
    return condition;
}

// n numbers: `rare()` if the condition holds in any lane, `usual()` otherwise. Where it does not hold both must come to the
// same, so that a lane never depends on its neighbors.
template <class Condition, class Usual, class Rare>
auto unless(const Condition& condition, const Usual& usual, const Rare& rare) {
    if (any(condition)) [[unlikely]]
        return rare();
    return usual();
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

// min(max(x, low), high); `low` wins nothing when the bounds cross, so keep low <= high.
template <class T>
T clamp(const T& x, const T& low, const T& high) {
    return min(max(x, low), high);
}

// a / sqrt(x); the root and the quotient side by side, since either keeps the next operation waiting.
template <class T>
T over_root(const T& a, const T& x) {
    return sqrt(x) * (a / x);
}

// The plain number behind a scalar, for decisions outside a step.
template <std::floating_point T>
double value_of(T x) {
    return x;
}

// The lanes of a number: one of itself, unless it is several side by side. `Element` is what a lane holds.
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

// The precision that a number computes in: float, or double for all others.
template <class T>
struct RealOf {
    using type = std::conditional_t<std::is_same_v<Element<T>, float>, float, double>;
};
template <class T>
using Real = typename RealOf<T>::type;

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
