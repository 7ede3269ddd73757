// The channels that a picture of the vehicle is drawn from: poses of its parts, contacts and forces of its tires.
#pragma once

#include "hamilcar/run/channels.hpp"

namespace hamilcar {

void add_motion_channels(const VehicleDescription& vehicle, std::vector<Channel>& list);

}  // namespace hamilcar
