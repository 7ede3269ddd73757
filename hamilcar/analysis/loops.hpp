// What is wrong with a suspension's loops, in a person's words.
#pragma once

#include <string>

#include "hamilcar/block/initial_process.hpp"

namespace hamilcar {

// Numbered as in a LoopReport.
std::string suspension_name(const VehicleDescription& vehicle, int suspension);

// Of a cut joint, numbered as in a LoopReport; "no joint" for -1.
std::string cut_name(const VehicleDescription& vehicle, const Model<double>& model, int suspension, int cut);

// Why a vehicle does not assemble.
std::string assembly_problem(const VehicleDescription& vehicle, const Model<double>& model, const LoopReport& loop);

}  // namespace hamilcar
