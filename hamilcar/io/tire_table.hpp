// Reads the tires of a vehicle file. A new model is one function that reads its keys and one line in a list.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hamilcar/description/tire.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

using NamedTires = std::vector<std::pair<std::string, TireDescription>>;

// All tables [tire.NAME] of a file, as they are on the left side of the vehicle.
NamedTires read_tires(const TableReader& file);
// The one that an axle names.
const TireDescription& tire_of(const TableReader& axle, const NamedTires& tires);

}  // namespace hamilcar::io
