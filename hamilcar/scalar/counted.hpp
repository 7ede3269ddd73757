// A double that counts what is done to it, so that the cost of a block is a number and not a guess.
#pragma once

#include <cstdint>

#include "hamilcar/scalar/scalar.hpp"

namespace hamilcar {

// Floating-point operations by kind since the last reset, on this thread.
struct OperationCount {
    std::int64_t additions = 0;  // and subtractions
    std::int64_t multiplications = 0;
    std::int64_t divisions = 0;
    std::int64_t roots = 0;
    std::int64_t choices = 0;  // min, max, abs, comparisons
    std::int64_t total() const { return additions + multiplications + divisions + roots; }
};

class Counted {
public:
    Counted() = default;
    Counted(double value) : value_(value) {}  // implicit: constants enter formulas as numbers
    double value() const { return value_; }
    static OperationCount& count() {
        thread_local OperationCount count;
        return count;
    }

    friend Counted operator+(Counted a, Counted b) { return ++count().additions, Counted(a.value_ + b.value_); }
    friend Counted operator-(Counted a, Counted b) { return ++count().additions, Counted(a.value_ - b.value_); }
    friend Counted operator*(Counted a, Counted b) { return ++count().multiplications, Counted(a.value_ * b.value_); }
    friend Counted operator/(Counted a, Counted b) { return ++count().divisions, Counted(a.value_ / b.value_); }
    friend Counted operator-(Counted a) { return Counted(-a.value_); }
    Counted& operator+=(Counted b) { return *this = *this + b; }
    Counted& operator-=(Counted b) { return *this = *this - b; }
    Counted& operator*=(Counted b) { return *this = *this * b; }
    Counted& operator/=(Counted b) { return *this = *this / b; }
    friend bool operator<(Counted a, Counted b) { return ++count().choices, a.value_ < b.value_; }
    friend bool operator>(Counted a, Counted b) { return b < a; }
    friend bool operator<=(Counted a, Counted b) { return !(b < a); }
    friend bool operator>=(Counted a, Counted b) { return !(a < b); }
    friend bool operator==(Counted a, Counted b) { return a.value_ == b.value_; }
    friend bool operator!=(Counted a, Counted b) { return a.value_ != b.value_; }

private:
    double value_ = 0;
};

inline Counted sqrt(Counted x) {
    return ++Counted::count().roots, Counted(std::sqrt(x.value()));
}
inline Counted abs(Counted x) {
    return ++Counted::count().choices, Counted(std::fabs(x.value()));
}
inline Counted min(Counted a, Counted b) {
    return a < b ? a : b;
}
inline Counted max(Counted a, Counted b) {
    return a > b ? a : b;
}
inline double value_of(Counted x) {
    return x.value();
}
}  // namespace hamilcar
