// What is wrong with a spoke's loops, in a person's words.
#pragma once

#include <string>

#include "hamilcar/block/initial_process.hpp"

namespace hamilcar {

// Of a corner or a composed suspension, numbered as in a LoopReport.
std::string spoke_name(const VehicleDescription& vehicle, int spoke);

// Of a cut joint, numbered as in a LoopReport; "no joint" for -1.
std::string cut_name(const VehicleDescription& vehicle, const Model<double>& model, int spoke, int cut);

// Why a vehicle does not assemble.
std::string assembly_problem(const VehicleDescription& vehicle, const Model<double>& model, const LoopReport& loop);

}  // namespace hamilcar
