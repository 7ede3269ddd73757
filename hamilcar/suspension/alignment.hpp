// Toe, camber and caster as they are set on an alignment rack: what the suspension has for it is turned or shimmed, and everything else follows.
//
// The wheel stays at the height of its design position. What comes out is a suspension with other design points, in which all poses are
// again the identity: nothing that is derived from a description knows that it was aligned. Springs keep their free lengths.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

// What a wheel's angle shall be at design, of its own side: toe-in and camber top outboard positive [rad]; what is left out follows.
using AlignmentTargets = std::array<std::optional<double>, wheel_angle_names.size()>;

// Whether the suspension has something to set that angle by.
bool can_set(const Composition& composition, WheelAngle angle);

// Aligns all wheels of a suspension that was made from this composition, `targets` of each. Returns what is in the way of it, and leaves
// the suspension alone then.
std::optional<std::string> align(SuspensionDescription& suspension, const Composition& composition,
                                 const std::vector<AlignmentTargets>& targets);

}  // namespace hamilcar
