// Maneuvers that a scenario file asks for.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/description/scenario.hpp"
#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/error.hpp"
#include "run_options.hpp"

namespace hamilcar::cli {

// Of all standard maneuvers.
std::vector<std::string> maneuver_names();

// As named by --maneuver, with the shipped vehicle unless another is named.
io::ExitCode run_maneuver(const RunOptions& options);
// With the scenario's vehicle, settings, solver and road.
io::ExitCode run_maneuver(const ScenarioDescription& scenario, const RunOptions& options);

// Throws io::Error for a maneuver or a setting that does not exist, or a vehicle that cannot do it.
void check_maneuver(const ScenarioDescription& scenario, const VehicleDescription& vehicle);

}  // namespace hamilcar::cli
