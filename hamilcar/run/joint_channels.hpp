// Channels of the forces in links, arms, ball joints and hinges.
#pragma once

#include <vector>

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

void add_joint_channels(const VehicleDescription& vehicle, std::vector<Channel>& list);

}  // namespace hamilcar
