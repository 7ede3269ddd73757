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

// What differs between two cars that cannot have one compiled program, or nothing.
std::string program_difference(const Simulation& a, const Simulation& b);
// The same of a program that exists, with these parameters (indices as in RhsTrace): they must differ in nothing else.
std::string program_difference(const Simulation& a, const Simulation& b, const std::vector<int>& parameters);

}  // namespace hamilcar
