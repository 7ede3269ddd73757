// What the core asks of a number, written so that a pack of lanes can answer too: choices are values, never branches.
#pragma once

#include <cmath>
#include <concepts>

// Marks the small functions of the core: always inlined, and the one place where a device build adds its qualifiers. A
// lambda is marked after its parameters, and what takes all of it into itself, a turn of the ring, by the third. In an
// instrumented build they are plain calls: a step in one piece would be too much for the instruments.
#ifdef HAMILCAR_PLAIN_CALLS
#define HAMILCAR_CORE inline
#define HAMILCAR_INLINED
#define HAMILCAR_IN_ONE_PIECE
#else
#define HAMILCAR_CORE [[gnu::always_inline]] inline
#define HAMILCAR_INLINED __attribute__((always_inline))
#define HAMILCAR_IN_ONE_PIECE [[gnu::flatten]]
#endif

namespace hamilcar {

// `condition ? yes : no` as a function; lanes overload it with a blend.
template <class T>
HAMILCAR_CORE T select(bool condition, const T& yes, const T& no) {
    return condition ? yes : no;
}

// Whether a condition holds in any lane: the only question that may skip work.
HAMILCAR_CORE bool any(bool condition) {
    return condition;
}

template <std::floating_point T>
HAMILCAR_CORE T sqrt(T x) {
    return std::sqrt(x);
}
template <std::floating_point T>
HAMILCAR_CORE T abs(T x) {
    return std::fabs(x);
}
template <std::floating_point T>
HAMILCAR_CORE T min(T a, T b) {
    return a < b ? a : b;
}
template <std::floating_point T>
HAMILCAR_CORE T max(T a, T b) {
    return a > b ? a : b;
}

// min(max(x, low), high); `low` wins nothing when the bounds cross, so keep low <= high.
template <class T>
HAMILCAR_CORE T clamp(const T& x, const T& low, const T& high) {
    return min(max(x, low), high);
}

// a / sqrt(x); the root and the quotient side by side, since either keeps the next operation waiting.
template <class T>
HAMILCAR_CORE T over_root(const T& a, const T& x) {
    return sqrt(x) * (a / x);
}

// The plain number behind a scalar, for decisions outside a step.
template <std::floating_point T>
double value_of(T x) {
    return x;
}

// The lanes of a number: one of itself, unless it is a pack. `Element` is what a lane holds.
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

// Lane `i` of a number.
template <class T>
HAMILCAR_CORE Element<T> lane(const T& number, int i) {
    return Lanes<T>::get(number, i);
}
template <class T>
HAMILCAR_CORE void set_lane(T& number, int i, const Element<T>& element) {
    Lanes<T>::set(number, i, element);
}

}  // namespace hamilcar
