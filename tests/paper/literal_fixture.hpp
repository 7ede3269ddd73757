// What the tests of the literal car share: states without symmetry, derivatives by extrapolated central differences.
#pragma once

#include "paper/literal.hpp"
#include "paper/reference_car.hpp"

namespace hamilcar::paper {

// d/dx f at 0: central differences at two steps, extrapolated to fourth order.
template <class F>
auto derivative(F&& f, double step) {
    const auto coarse = ((f(step) - f(-step)) / (2 * step)).eval();
    const auto fine = ((f(step / 2) - f(-step / 2)) / step).eval();
    return ((4 * fine - coarse) / 3).eval();
}

// The same for a function that returns one number.
template <class F>
double scalar_derivative(F&& f, double step) {
    return (8 * (f(step / 2) - f(-step / 2)) - (f(step) - f(-step))) / (6 * step);
}

// An assembled position away from the origin, rolled, pitched and yawed, with every suspension elsewhere and the rack
// moving.
inline Coordinates general_position(const LiteralCar& car) {
    Coordinates q = car.design_position();
    q(4) -= 0.03;
    q(8) += 0.02;
    q(9) = 0.08;
    q(10) = -0.05;
    q(11) = 12;
    q(12) = -7;
    q(13) = 1.4;
    q(14) = 0.3;
    q(15) = -0.4;
    q(16) = 0.9;
    q(17) = 0.015;
    q.q17_dot = 0.2;
    return car.assemble(q);
}

// The same with every cut joint a few millimeters open, for the terms that stabilization adds.
inline Coordinates violated_position(const LiteralCar& car) {
    Coordinates q = general_position(car);
    const std::array<double, 6> off{0.004, -0.006, 0.01, -0.005, 0.003, -0.008};
    for (std::size_t i = 0; i < dependent.size(); ++i) q(dependent[i]) += off[i];
    return q;
}

inline Vector general_rates() {
    Vector adot(10);
    adot << 3, -1, 0.5, 0.7, -0.4, 0.6, 0.3, -0.5, 0.8, 0.4;
    return adot;
}

}  // namespace hamilcar::paper
