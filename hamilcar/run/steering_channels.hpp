// Channels of a steering whose rack moves on its own.
#pragma once

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

void add_steering_channels(const VehicleDescription& vehicle, std::vector<Channel>& list);

}  // namespace hamilcar
