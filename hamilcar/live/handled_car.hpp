// What hands need to know of a car, read off its linkages at design.
#pragma once

#include "hamilcar/live/hands.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar::live {

HandledCar handled_car(const Simulation& simulation);

// Of the car as it moves: driven wheels count by their share of the torque.
Felt feel(const VehicleDescription& vehicle, const Sample& sample);

}  // namespace hamilcar::live
