// The vehicles and roads that `hamilcar drive` offers in its menus: shipped vehicles, roads of shipped scenarios and courses of
// maneuvers, plus those named on the command line.
#pragma once

#include <string>
#include <vector>

#include "files.hpp"
#include "hamilcar/live/session.hpp"

namespace hamilcar::cli {

// A road that needs no file.
inline constexpr const char* level_ground = "level ground";

// The scenario may be empty. Keys that were set are set of that vehicle alone. Vehicles start at rest, at the position that the scenario gives.
live::Catalog make_catalog(const VehicleChoice& vehicle, const std::string& scenario);

// The id under which a file is listed, by whatever path it was named.
std::string choice_of(const std::vector<live::Selectable>& choices, const std::string& file);

}  // namespace hamilcar::cli
