// One suspension of a scene, whichever program carries it.
#pragma once

#include "hamilcar/run/scene.hpp"

namespace hamilcar {

// Where a part of the suspension stands, in the axes of its unit.
using PartPose = std::function<Pose<double>(const Sample&, std::size_t part)>;

void add_suspension(const SuspensionDescription& suspension, const PartPose& pose, Scene& scene);

}  // namespace hamilcar
