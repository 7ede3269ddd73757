// Passes: from a graph to a graph that computes the same.
#pragma once

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program {

// Without the nodes that no output needs. An unneeded region is removed as a whole; a call stays while one result is needed.
Graph without_dead_code(const Graph& graph);

// Every wide node as nodes of width 1, number by number: for backends with a car in each lane.
Graph in_single_numbers(const Graph& graph);

}  // namespace hamilcar::program
