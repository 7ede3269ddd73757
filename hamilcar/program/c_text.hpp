// A graph as C source: to check the other backends, for embedded hardware, and for other targets' compilers.
#pragma once

#include <string>
#include <string_view>

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program {

// One C99 function without includes, for one car; its own comment explains the arguments. Compiled with -ffp-contract=off it gives
// the bits of the other backends, on processors that compute in the requested precision.
std::string c_text(const Graph& graph, std::string_view function_name);

}  // namespace hamilcar::program
