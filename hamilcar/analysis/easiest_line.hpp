// The line through lanes that is easiest to drive.
#pragma once

#include <array>
#include <vector>

#include "hamilcar/analysis/dimensions.hpp"

namespace hamilcar {

// From `begin` to `end` along x, between `right` and `left` along y [m].
struct Lane {
    double begin, end, right, left;
    double width() const { return left - right; }
    double center() const { return 0.5 * (left + right); }
};

// The line of the center of mass that bends least, in the sense of the least mean squared curvature, while the box whose
// heading is the line's stays between all rows with some of the room to spare: a driver who knows the course uses its width.
std::vector<std::array<double, 2>> easiest_line(const std::vector<Lane>& lanes, const Footprint& box);

}  // namespace hamilcar
