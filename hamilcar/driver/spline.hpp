// Interpolating cubic splines with a continuous second derivative; `chord` holds the knot spacings.
#pragma once

#include <array>
#include <vector>

namespace hamilcar::spline {

// Second derivatives at the knots: zero at both ends, or periodic, which takes as many chords as values, the last one leading back
// to the first.
std::vector<double> natural_second_derivatives(const std::vector<double>& value, const std::vector<double>& chord);
std::vector<double> periodic_second_derivatives(const std::vector<double>& value, const std::vector<double>& chord);

// Coefficients c0 + u (c1 + u (c2 + u c3)), u from 0 to the chord, between two values with their second derivatives.
std::array<double, 4> cubic(double from, double to, double second, double next_second, double chord);

}  // namespace hamilcar::spline
