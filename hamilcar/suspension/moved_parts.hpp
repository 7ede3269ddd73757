// A suspension whose parts stand elsewhere at design.
#pragma once

#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/linkage/frame.hpp"

namespace hamilcar {

// Every point, axis and inertia goes with its part, `poses` in the order of the parts, the unit first. A joint's point and second axis go
// with what it carries, its first axis and where a cut joint starts with what they stand on.
SuspensionDescription with_parts_moved(SuspensionDescription suspension, const std::vector<Pose<double>>& poses);

// The poses where one part is shifted with all that hangs on it.
std::vector<Pose<double>> shifted(const LinkageDescription& linkage, std::size_t part, const Vec3<double>& by);

}  // namespace hamilcar
