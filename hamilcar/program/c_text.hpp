// A graph as C: to check the other backends by, for controllers' hardware, and for compilers to elsewhere.
#pragma once

#include <string>
#include <string_view>

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program {

// One C99 function without includes, for one car; its own comment explains the arguments. Compiled with -ffp-contract=off it gives
// the bits of the other backends, on processors that compute in the precision asked for.
std::string c_text(const Graph& graph, std::string_view function_name);

}  // namespace hamilcar::program
