// The right side of an axle: the left one seen in the plane y = 0.
#pragma once

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar::io {

WheelDescription mirrored(WheelDescription left);
void mirror(BodyDescription& body);

}  // namespace hamilcar::io
