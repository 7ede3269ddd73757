// A run on disk, to be gone on with by another process to the same bits.
#pragma once

#include <string>

#include "hamilcar/run/record.hpp"

namespace hamilcar {

// What is kept besides the simulation itself: how the run went so far.
struct Progressed {
    RunSummary summary;
    std::vector<double> x, y;  // where the vehicle has been, for the picture of its road [m]
};

// Complete or not at all: written beside `path` and moved there. Throws io::Error(input_output).
void write_checkpoint(const std::string& path, const Simulation& simulation, const Progressed& progressed);

// Brings a simulation that has been put on the road from the same files to where the other one was. Throws io::Error:
// input_output for a file that cannot be read, bad_file for one that is no checkpoint, or one of another vehicle, scenario,
// method or step; told by the rates at that instant, which must be the same to the bit.
Progressed read_checkpoint(const std::string& path, Simulation& simulation);

}  // namespace hamilcar
