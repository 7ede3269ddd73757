#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Reads [[differential]] and [[power_unit]] of a vehicle whose axles are there already; both may be left out, and
// `powertrain = false` leaves out those of a base.
void read_powertrain(const TableReader& file, VehicleDescription& vehicle);

}  // namespace hamilcar::io
