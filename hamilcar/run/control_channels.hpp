// Channels of the brake system, of commands and of controllers.
#pragma once

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

void add_control_channels(const VehicleDescription& vehicle, std::vector<Channel>& list);

}  // namespace hamilcar
