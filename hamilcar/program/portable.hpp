// The backend without generated code: it interprets the list, one block of numbers per operation. For processors without a
// backend of their own, for systems that forbid generated code, and as the reference for the other backends.
#pragma once

#include <memory>

#include "hamilcar/program/executable.hpp"

namespace hamilcar::program {

// One car at a time (nodes of width 1, 2 and 4), or a car in each of 8 lanes of doubles or 16 of floats (width 1 alone).
std::unique_ptr<Executable> compile_portable(const Graph& graph, bool car_in_each_lane);

}  // namespace hamilcar::program
