// What is odd about a vehicle that can be computed all the same: numbers out of any car's range, each with what may be the cause.
// The limits are in docs/analyses.md ("Plausibility"); every shipped vehicle keeps them.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/analysis/vehicle_figures.hpp"

namespace hamilcar {

struct Oddity {
    std::string where;  // "front", "rear_left"
    std::string what;   // "stands 67 mm below design"
    std::string cause;  // "is force_at_design_N of its spring missing?"
};

// Of its points and rods alone, whatever becomes of it.
std::vector<Oddity> odd_geometry(const VehicleDescription& vehicle);
// Of how it stands, steers and rides.
std::vector<Oddity> odd_figures(const VehicleDescription& vehicle, const VehicleFigures& figures,
                                const std::vector<AxleReport>& kinematics);

}  // namespace hamilcar
