// A corner that has a program of its own, as a composition of parts: the same car by the other program.
#pragma once

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

ComposedSpokeDescription compose_corner(const CornerDescription& corner);

// All corners of a vehicle composed, none with a program of its own.
VehicleDescription composed_throughout(VehicleDescription vehicle);

}  // namespace hamilcar
