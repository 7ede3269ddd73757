// Maneuvers that a scenario file asks for.
#pragma once

#include "commands.hpp"
#include "hamilcar/description/scenario.hpp"

namespace hamilcar::cli {

// With the scenario's vehicle, settings, solver and road.
io::ExitCode run_maneuver(const ScenarioDescription& scenario, const Options& options);

// Throws io::Error for a maneuver or a setting that does not exist, or a vehicle that cannot do it; `file` is the scenario's.
void check_maneuver(const ScenarioDescription& scenario, const VehicleDescription& vehicle, const std::string& file);

}  // namespace hamilcar::cli
