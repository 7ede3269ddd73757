// The channels of suspensions and trailers.
#pragma once

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

void add_suspension_channels(const VehicleDescription& vehicle, std::vector<Channel>& list);

}  // namespace hamilcar
