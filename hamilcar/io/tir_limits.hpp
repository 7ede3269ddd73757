// What the numbers of a tire may be if its forces are to be numbers too: far beyond any tire, but short of where arithmetic
// suffers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/description/tire.hpp"
#include "hamilcar/io/property_file.hpp"

namespace hamilcar::io {

// Of quantities that must be positive, and of any number of a file, in SI.
constexpr double min_in_tir = 1e-3, max_in_tir = 1e12;

// What is wrong with the coefficients once scaling factors and inflation pressure are multiplied in, and why. Nothing if all
// is well.
std::optional<std::string> complaint_about_coefficients(const MagicFormulaDescription& tire);

// Friction and cornering stiffness are polynomials that sooner or later vanish with load and camber, where the equations
// divide by zero, and are negative beyond. Takes loads and camber that leave less than a tenth out of the tire's ranges,
// where they are then kept as they are at the end of the range, and returns what is to be told about it.
std::vector<std::string> narrow_ranges(MagicFormulaDescription& tire);

// A pair of limits as it is where it leaves a range, about zero or not below it; else swapped, or one as far from zero as the
// other, or `own`.
std::array<double, 2> mended_range(std::array<double, 2> limits, const std::array<double, 2>& own, bool about_zero);

// Stiffness [N/m] and growth [N/m^2] of load = stiffness d + growth d^2, by least squares through the deflections and loads of a
// table in units of `length` and `force`. Nothing if there is no table, or what it makes is no spring.
std::optional<std::array<double, 2>> spring_through(const PropertySection* curve, double length, double force);

}  // namespace hamilcar::io
