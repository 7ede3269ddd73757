// Floating-point operations of a step, counted by a number that counts.
#pragma once

#include "hamilcar/run/simulation.hpp"
#include "hamilcar/scalar/counted.hpp"

namespace hamilcar {

// Of one turn of the ring, for one car at its present state.
OperationCount operations_of_a_turn(const Simulation& simulation);

// Of one step of its method: the turns, the sums over the past, the closing of loops and orientation.
OperationCount operations_of_a_step(const Simulation& simulation);

}  // namespace hamilcar
