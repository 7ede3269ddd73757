// Derivatives of a graph by the chain rule through every operation, as graphs of their own: exact, and compiled like any other.
//
// Where an operation has a kink (absolute value, minimum, selection) the derivative is that of the side that is taken; that of a square root
// of zero counts as zero, as for dual numbers, and so does that of rounding by a large constant. Regions are always entered, which changes no value (see Region).
#pragma once

#include <array>

#include "hamilcar/program/graph.hpp"

namespace hamilcar::program {

// Where derivatives are found: that of number i of an array is number `first + i` of `array`. For an array of inputs `none` says that nothing
// is derived by it, for one of outputs that nothing depends on it.
struct DerivativePlace {
    int array = none, first = 0;
};
using DerivativePlaces = std::array<DerivativePlace, max_arrays>;

// What calls are replaced by: function f becomes f + offset. With the tangents of its arguments behind the arguments it computes the tangents
// of its results; with the adjoints of its results there the adjoints of its arguments.
struct DerivativeOptions {
    DerivativePlaces places;
    int call_offset = 0;
};

// The outputs of the graph and, for given tangents of the inputs, those of the outputs: with x' of x comes (df/dx) x' of f(x).
Graph with_tangents(const Graph& graph, const DerivativeOptions& options);

// For given adjoints of the outputs those of the inputs: with f^ of f(x) comes (df/dx)^T f^ of x. Nothing else is computed, and that of an
// input on which nothing depends is not written: it is zero.
Graph adjoint(const Graph& graph, const DerivativeOptions& options);

}  // namespace hamilcar::program
