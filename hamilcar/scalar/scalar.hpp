// What the core asks of a number, written so that a pack of lanes can answer too: choices are values, never branches.
#pragma once

#include <algorithm>
#include <cmath>

// Marks the small functions of the core: always inlined, and the one place where a device build adds its qualifiers.
#define HAMILCAR_CORE [[gnu::always_inline]] inline

namespace hamilcar {

// `condition ? yes : no` as a function; lanes overload it with a blend.
template <class T>
T select(bool condition, const T& yes, const T& no) {
    return condition ? yes : no;
}

// Whether a condition holds in any lane: the only question that may skip work.
inline bool any(bool condition) {
    return condition;
}

inline double sqrt(double x) {
    return std::sqrt(x);
}
inline double abs(double x) {
    return std::fabs(x);
}
inline double min(double a, double b) {
    return a < b ? a : b;
}
inline double max(double a, double b) {
    return a > b ? a : b;
}

// Sine and cosine of one angle [rad].
template <class T>
struct SineCosine {
    T sine, cosine;
};

inline SineCosine<double> sincos(double angle) {
    return {std::sin(angle), std::cos(angle)};
}

// min(max(x, low), high); `low` wins nothing when the bounds cross, so keep low <= high.
template <class T>
T clamp(const T& x, const T& low, const T& high) {
    return min(max(x, low), high);
}

// The plain number behind a scalar, for decisions outside a step.
inline double value_of(double x) {
    return x;
}

}  // namespace hamilcar
