// What the numbers of a tire may be if its forces are to be numbers too: far beyond any tire, but short of where arithmetic
// suffers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamilcar/description/tire.hpp"

namespace hamilcar::io {

// Of quantities that must be positive, and of any number of a file, in SI.
constexpr double least_in_tir = 1e-3, largest_in_tir = 1e12;

// What is wrong with the coefficients once scaling factors and inflation pressure are multiplied in, and why. Nothing if all
// is well.
std::optional<std::string> complaint_about_coefficients(const MagicFormulaDescription& tire);

// Friction and cornering stiffness are polynomials that sooner or later vanish with load and camber, where the equations
// divide by zero, and are negative beyond. Takes loads and camber that leave less than a tenth out of the tire's ranges,
// where they are then kept as they are at the end of the range, and returns what is to be told about it.
std::vector<std::string> narrow_ranges(MagicFormulaDescription& tire);

}  // namespace hamilcar::io
