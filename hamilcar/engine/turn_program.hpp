// A vehicle's turn of the ring made ready to run: recorded, cleaned, compiled. Made when a run starts, and kept for the next
// run of the same vehicle.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "hamilcar/engine/engines.hpp"
#include "hamilcar/engine/turn_trace.hpp"

namespace hamilcar {

struct TurnProgram {
    std::unique_ptr<const program::Executable> executable;
    std::vector<int> closing_places;  // as in TurnTrace
    std::vector<int> parameters;
    int state_size = 0;
    ChassisChart chart{};

    int report_size() const { return TurnReport::closing + static_cast<int>(closing_places.size()); }
    void run(const program::Frame& frame) const { executable->run(frame); }
};

// The graph of one vehicle as a backend is given it.
TurnTrace lean_turn_trace(const Model<double>& model);

// For one car at a time, all its numbers known.
std::shared_ptr<const TurnProgram> turn_program(const Model<double>& model, const Engine& engine);

// For a car in each lane, each with the numbers of its own; `cars` have one shape.
std::shared_ptr<const TurnProgram> turn_program(std::span<const Model<double>* const> cars, const Engine& engine,
                                                Precision precision);

// What programs call, by the precision that they compute in.
const program::CallFunction* turn_functions(Precision precision);

}  // namespace hamilcar
