// What FMVSS 126 and UN R140 ask of the runs of the sine with dwell.
#pragma once

#include <vector>

#include "hamilcar/maneuver/dwell_run.hpp"

namespace hamilcar::dwell {

inline constexpr double early_limit = 35, late_limit = 20;  // of the yaw rate's peak [%]
inline constexpr double answering = 5;                      // from which on the displacement counts [A]
inline constexpr double stopped = 3;  // slower a vehicle hardly turns whatever it did before [m/s]

struct Driven : Run {
    double last_speed = nowhere;  // over the ground, when the later yaw rate is read [m/s]
};

// Evaluated from its history.
Driven driven(const History& history, double amplitude, double factor);

// 1.83 m, or 1.52 m of a heavy vehicle.
double displacement_limit(const VehicleDescription& vehicle);

// Three verdicts, two where no run went to 5 A, each telling the run that is farthest from passing; notes beside them.
void add_verdicts(const VehicleDescription& vehicle, const std::vector<Driven>& runs, Outcome& outcome);

}  // namespace hamilcar::dwell
