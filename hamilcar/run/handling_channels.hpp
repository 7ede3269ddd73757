// Channels that tests of vehicle dynamics are evaluated by: motion in the horizontal plane along and across the heading
// (ISO 8855, intermediate axes), and accelerations on the seat.
#pragma once

#include <vector>

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

void add_handling_channels(const VehicleDescription& vehicle, std::vector<Channel>& list);

}  // namespace hamilcar
