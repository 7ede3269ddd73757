// What the benchmarks drive: always the same, so that figures of different days and machines can be compared.
#pragma once

#include <memory>
#include <vector>

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// Into a bend at 20 m/s, under power; it never ends. The rack's displacement in the bend [m].
ScenarioDescription bend(double rack = 0.003);

// Half a second into that bend.
Simulation cornering(const VehicleDescription& vehicle, const ScenarioDescription& scenario);

// Cars that differ: each with a mass, a road and a bend of its own.
std::vector<std::unique_ptr<Simulation>> fleet(const VehicleDescription& vehicle, int count);

// A double lane change at 20 m/s that lasts 15 s.
ScenarioDescription lane_change();

}  // namespace hamilcar
