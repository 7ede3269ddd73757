// Everything about one instant as recorded numbers, for what is read off a car in its compiled step: channels.
#pragma once

#include <functional>
#include <memory>

#include "hamilcar/block/rhs.hpp"
#include "hamilcar/engine/rhs_program.hpp"
#include "hamilcar/math/traced.hpp"

namespace hamilcar {

struct TracedSample {
    using Number = Traced<>;
    const Model<Number>& model;
    const State<Number>& state;
    Input<Number> input;
    Velocity<Number, Paired<Number>> velocity;  // whose pairs are not used: suspensions are recorded one by one
    Momenta<Number> momenta;
};

// Numbers of a car, one after the other.
using TracedReaders = std::vector<std::function<Traced<>(const TracedSample&)>>;

// Recorded from the state, inputs and parameters of the right-hand side; the results are in the array of the rates.
RhsTrace trace_sample(const Model<double>& example, const CommonCar& common, Precision precision,
                      const TracedReaders& readers);

// A program that computes them for a car in each lane from the state, inputs and parameters of the right-hand side of those cars; its
// results are in the array of the rates.
std::shared_ptr<const program::Executable> sample_program(const Model<double>& example, const CommonCar& common,
                                                          const Engine& engine, Precision precision,
                                                          const TracedReaders& readers);

}  // namespace hamilcar
