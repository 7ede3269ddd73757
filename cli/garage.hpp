// What `hamilcar drive` offers in its menus: the shipped vehicles, the roads of the shipped scenarios and the courses of
// maneuvers, with those that the person names.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/live/session.hpp"

namespace hamilcar::cli {

// A road that needs no file.
inline constexpr const char* level_ground = "level ground";

// Either may be empty. Vehicles stand still at first, wherever the scenario starts them.
live::Garage make_garage(const std::string& vehicle, const std::string& scenario);

// The id under which a file is offered, whatever path it was named by.
std::string choice_of(const std::vector<live::Choice>& choices, const std::string& file);

}  // namespace hamilcar::cli
