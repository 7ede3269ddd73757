// Cubic splines with a continuous second derivative through values that stand some chords apart.
#pragma once

#include <array>
#include <vector>

namespace hamilcar::spline {

// Second derivatives at the knots: zero at both ends, or as of a function that repeats itself; that has as many chords as
// values, the last one back to the first.
std::vector<double> natural_bends(const std::vector<double>& value, const std::vector<double>& chord);
std::vector<double> periodic_bends(const std::vector<double>& value, const std::vector<double>& chord);

// Coefficients c0 + u (c1 + u (c2 + u c3)), u from 0 to the chord, between two values with their second derivatives.
std::array<double, 4> cubic(double from, double to, double bend, double next_bend, double chord);

}  // namespace hamilcar::spline
