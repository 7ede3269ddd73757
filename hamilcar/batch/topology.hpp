// What cars must share to run in one program.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// What differs between two cars that cannot share a chunk, or nothing: "tire model of wheel 2", "step", ...
std::string topology_difference(const Simulation& a, const Simulation& b);

// In which order the equations of a vehicle's linkages are solved: cars of one program have one.
std::vector<int> elimination_order(const Vehicle<double>& vehicle);

// Whether two cars differ in a number that is none of the program's parameters (indices as in RhsTrace).
bool differs_in_constant(const std::vector<int>& parameters, const Model<double>& a, const Model<double>& b);

}  // namespace hamilcar
