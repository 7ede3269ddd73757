// Floating-point operations of a step, counted on its program.
#pragma once

#include <cstdint>

#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct OperationCount {
    std::int64_t additions = 0;  // and subtractions
    std::int64_t multiplications = 0;
    std::int64_t divisions = 0;
    std::int64_t roots = 0;
    std::int64_t choices = 0;  // min, max, comparisons, choices by them
    OperationCount& operator+=(const OperationCount& other);
    std::int64_t total() const { return additions + multiplications + divisions + roots; }
};

// Of the main line of a graph, a node of n numbers as n; without regions, which are rarely entered.
OperationCount operations_of(const program::Graph& graph);
// What was recorded in one block.
OperationCount operations_of(const program::Graph& graph, program::Block block);

// Of one evaluation of the right-hand side, for one car.
OperationCount operations_of_rhs(const Simulation& simulation);

// Of one step of its method: the turns, the sums over the past, the closing of loops and orientation. Of the adaptive method
// one trial.
OperationCount operations_of_a_step(const Simulation& simulation);

}  // namespace hamilcar
