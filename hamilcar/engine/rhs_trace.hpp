// The right-hand side (Fig. 10 without Integration) of one vehicle as a graph, recorded once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hamilcar/block/model.hpp"
#include "hamilcar/program/graph.hpp"

namespace hamilcar {

// The arrays of the program.
enum RhsArray : int {
    rhs_state,       // as in State
    rhs_input,       // as in RhsInput
    rhs_parameters,  // those that differ between the cars of a batch
    rhs_rate,        // of the state
    rhs_report,      // as in RhsReport
};

// Indices of the inputs; behind them the commands of a car with controllers (vehicle/command_layout.hpp).
struct RhsInput {
    enum : int {
        rack,
        rack_rate,
        rack_acceleration,
        drive_torque,
        brake,
        throttle,
        clutch,
        gear,
        wind_x,
        wind_y,
        hands_hold,
        hands_torque,
        parking_brake,
        size
    };
};

// Results besides the rates: health, then the Newton corrections from index `correction` on, and behind them what sensors read
// (block/measurement.hpp) of a car with controllers.
struct RhsReport {
    enum : int { violation, mobility, correction };
};

// All numbers of a model, and everything else that its program depends on.
struct ModelNumbers {
    std::vector<double> numbers;
    std::vector<int> shape;  // counts, kinds, modes
};
ModelNumbers numbers_of(const Model<double>& model);

// Copies all numbers and counts that ModelNumbers has, in its order.
template <class To, class Convert>
void transcribe_model(Model<To>& to, const Model<double>& from, Convert&& convert) {
    transcribe(to.vehicle, from.vehicle, convert);
    transcribe(to.road, from.road, convert);
    transcribe(to.stabilization_gain, from.stabilization_gain, convert);
}

struct RhsTrace {
    program::Graph graph;
    std::vector<int>
        correction_indices;       // in the state, of the coordinates that the corrections in RhsReport belong to
    std::vector<int> parameters;  // indices into ModelNumbers::numbers of the program's parameters
    int measured = 0;             // numbers that sensors read
};

// What several cars of one topology have in common, for one program of all.
struct CommonCar {
    std::vector<bool> differs;  // for each number; empty for a single car
    std::vector<int> shape;     // the largest of the cars' counts
};

// Of cars of one structure; `example` becomes a model with all that any of them has.
CommonCar common_car(std::span<const Model<double>* const> cars, Model<double>& example);

// Numbers that differ between the cars become inputs, all others constants.
RhsTrace trace_rhs(const Model<double>& model, const CommonCar& common, program::Precision precision);

}  // namespace hamilcar
