// By what an integration method multiplies a solution of y' = lambda y in a step, and the longest step with which none of
// several such solutions grows that would not grow by itself.
#pragma once

#include <complex>
#include <span>

#include "hamilcar/integrator/methods.hpp"

namespace hamilcar {

// Of the classical method or a multi-step one, z = lambda h: the modulus of its stability function, or of the largest root of
// its characteristic polynomial. The adaptive method chooses its own steps: that of one of its stages' passes.
double growth(const Method& method, std::complex<double> z);

// How fast a step of `step` seconds makes a solution grow beyond the growth that it has by itself [1/s]; not above zero where
// the method is stable.
double spurious_growth(const Method& method, double step, std::complex<double> lambda);

// Slower growth than this is not told: what is indifferent, a place or a heading, may drift by round-off [1/s].
inline constexpr double tolerated_growth = 1;

// Whether a step is within the stability limit of all of these, and the longest one up to `step` that is [s].
bool is_stable(const Method& method, double step, std::span<const std::complex<double>> lambda);
double stable_step(const Method& method, double step, std::span<const std::complex<double>> lambda);

}  // namespace hamilcar
