// Reads the parts of a vehicle file that come in kinds: tires and axles. A new tire model or suspension is one function
// that reads its keys and one line in a list here.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

using NamedTires = std::vector<std::pair<std::string, TireDescription>>;

// All tables [tire.NAME] of a file.
NamedTires read_tires(const TableReader& file);

// The left corner of an [[axle]], named "<axle>_left"; it has half of the axle's share of the drive torque.
CornerDescription read_left_corner(const TableReader& axle, const NamedTires& tires);

}  // namespace hamilcar::io
