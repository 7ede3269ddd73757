// Reads a vehicle file (TOML) into a VehicleDescription; docs/files/vehicle.md lists the keys.
#pragma once

#include <string>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Throws Error (bad_file or input_output) with file, line, column, key, value, expectation and unit.
VehicleDescription read_vehicle(const std::string& path);
VehicleDescription read_vehicle(Node& document);  // of read_toml
VehicleDescription read_vehicle(const TableReader& file);

}  // namespace hamilcar::io
