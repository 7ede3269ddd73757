// The backend without generated code: it walks the list with one block of numbers an operation. For processors that have no
// backend of their own, for systems that forbid generated code, and as the plain reading of what the others do.
#pragma once

#include <memory>

#include "hamilcar/program/executable.hpp"

namespace hamilcar::program {

// One car at a time (nodes of width 1, 2 and 4), or a car in each of 8 lanes of doubles or 16 of floats (width 1 alone).
std::unique_ptr<Executable> compile_portable(const Graph& graph, bool car_in_each_lane);

}  // namespace hamilcar::program
