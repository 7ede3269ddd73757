// Preloads that a vehicle's description leaves open: the forces with which its suspensions stand at design.
#pragma once

#include <optional>
#include <string>

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

// Sets the force at design of every spring that `carries`, so that on level ground all forces balance while the suspensions
// that have such springs are at design; the others, hitches and tires deflect as they must. Seats of these springs do not count: they
// press with what they add. Returns what is in the way of it.
std::optional<std::string> find_preloads(VehicleDescription& vehicle);

}  // namespace hamilcar
