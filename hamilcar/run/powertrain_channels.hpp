// Channels of what drives: power units, differentials, and the pedals that they listen to.
#pragma once

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

// None where the vehicle has no power units; zero where they do not run (is_powered).
void add_powertrain_channels(const VehicleDescription& vehicle, std::vector<Channel>& list);

}  // namespace hamilcar
