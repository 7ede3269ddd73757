#pragma once

#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Reads the [[differential]] of a file that has some, for a vehicle whose axles are there already, in the order that a description wants: what is driven
// before what drives it. Returns their tables in that order; none where there is no file.
std::vector<TableReader> read_differentials(const TableReader& file, VehicleDescription& vehicle);

}  // namespace hamilcar::io
