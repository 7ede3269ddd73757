// A run on disk, to be gone on with by another process to the same bits.
#pragma once

#include <cstdint>
#include <string>

#include "hamilcar/run/record.hpp"

namespace hamilcar {

// What a run was made from, told by checksums of its files. Zeros where it was made by a program, without files.
struct Origin {
    std::uint64_t vehicle = 0, scenario = 0;
};

// What is kept besides the simulation itself: how the run went so far.
struct Progressed {
    RunSummary summary;
    std::vector<double> x, y;  // where the vehicle has been, for the picture of its road [m]
};

// Complete or not at all: written beside `path` and moved there, in the place of nothing but an earlier checkpoint.
// Throws io::Error: input_output where it cannot be written, usage where another file has the name.
void write_checkpoint(const std::string& path, const Simulation& simulation, const Progressed& progressed,
                      const Origin& origin = {});

// Brings a simulation that has been put on the road from the same files to where the other one was. Throws io::Error:
// input_output for a file that cannot be read, bad_file for one that is no checkpoint, is damaged, or is of another
// vehicle, scenario, method, step or version. Beyond the checksums of the files, the rates at that instant must be the
// same to the bit.
Progressed read_checkpoint(const std::string& path, Simulation& simulation, const Origin& origin = {});

}  // namespace hamilcar
