// A vehicle's right-hand side as a compiled program: recorded, freed of dead code, compiled. Made when a run starts, and cached
// for the next run of the same vehicle.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "hamilcar/engine/engines.hpp"
#include "hamilcar/engine/rhs_trace.hpp"

namespace hamilcar {

struct RhsProgram {
    std::unique_ptr<const program::Executable> executable;
    std::vector<int> correction_indices;  // as in RhsTrace
    std::vector<int> parameters;
    int state_size = 0, commands = 0, measured = 0;
    ChassisChart chart{};

    // Where in the report the measurement begins, and the report's size.
    int measurement() const { return RhsReport::correction + static_cast<int>(correction_indices.size()); }
    int report_size() const { return measurement() + measured; }
    void run(const program::Frame& frame) const { executable->run(frame); }
};

// The graph of one vehicle, as it is passed to a backend.
RhsTrace rhs_trace_without_dead_code(const Model<double>& model);

// For one car at a time, with all its numbers as constants.
std::shared_ptr<const RhsProgram> rhs_program(const Model<double>& model, const Engine& engine);

// For a car in each lane, each with its own numbers; `cars` have one structure.
std::shared_ptr<const RhsProgram> rhs_program(std::span<const Model<double>* const> cars, const Engine& engine,
                                              Precision precision);

// Where the system grants no more executable memory, for the portable engine: slower, with the same bits.
std::unique_ptr<const program::Executable> compiled(const program::Graph& graph, const Engine& engine,
                                                    bool car_in_each_lane);

// Programs of the same cars run together. Throws std::runtime_error for one that, for want of executable memory, has other lanes.
void expect_lanes(const program::Executable& executable, int lanes);

// The functions that programs of this precision call; in double precision also those of derivatives, by their offset.
struct RhsCall {
    enum : int { tangents = 1, adjoints = 2 };
};
const program::CallFunction* rhs_functions(Precision precision);

}  // namespace hamilcar
