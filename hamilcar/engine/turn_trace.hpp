// The turn of the ring (Fig. 10) of one vehicle as a graph: what a step computes, recorded once.
#pragma once

#include <cstdint>
#include <vector>

#include "hamilcar/block/model.hpp"
#include "hamilcar/program/graph.hpp"

namespace hamilcar {

// The arrays of a turn's program.
enum TurnArray : int {
    turn_state,       // as in State
    turn_input,       // as in TurnInput
    turn_parameters,  // those that differ between the cars of a batch
    turn_rate,        // of the state
    turn_report,      // as in TurnReport
};

// Places of what the driver does.
struct TurnInput {
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
        size
    };
};

// What a turn tells besides rates; then what closes the loops.
struct TurnReport {
    enum : int { violation, mobility, closing };
};

// All numbers of a model, and all else that a program of it depends on.
struct ModelNumbers {
    std::vector<double> numbers;
    std::vector<int> shape;  // counts, kinds, modes
};
ModelNumbers numbers_of(const Model<double>& model);

// Of all that ModelNumbers has, in its order.
template <class To, class Convert>
void transcribe_model(Model<To>& to, const Model<double>& from, Convert&& convert) {
    transcribe(to.vehicle, from.vehicle, convert);
    transcribe(to.road, from.road, convert);
    transcribe(to.stabilization_gain, from.stabilization_gain, convert);
}

struct TurnTrace {
    program::Graph graph;
    std::vector<int> closing_places;  // in the state, of the coordinates that TurnReport's closing belongs to
    std::vector<int> parameters;      // places in ModelNumbers of the numbers that the program is given
};

// What several cars of one topology have in common, for one program of all.
struct CommonCar {
    std::vector<bool> differs;  // a mark for each of the numbers; none at all: for the one car
    std::vector<int> shape;     // of counts the largest
};

// Numbers that `common` marks become inputs, all others constants.
TurnTrace trace_turn(const Model<double>& model, const CommonCar& common, program::Precision precision);

}  // namespace hamilcar
