// What a driver knows of a car, read off its linkages at design; and what a person at the wheel feels.
#pragma once

#include "hamilcar/block/model.hpp"
#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/driver/observation.hpp"

namespace hamilcar {

// `state`: the car at its start.
DrivenCar driven_car(const VehicleDescription& vehicle, const Model<double>& model, const State<double>& state);

}  // namespace hamilcar
