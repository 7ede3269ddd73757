// Reads what hangs on a suspension: wheel, tire, damper, stops, brake. A new tire model is one function that reads its keys
// and one line in a list.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

using NamedTires = std::vector<std::pair<std::string, TireDescription>>;

// All tables [tire.NAME] of a file.
NamedTires read_tires(const TableReader& file);
// The one that an axle names.
const TireDescription& tire_of(const TableReader& axle, const NamedTires& tires);

WheelDescription read_wheel(const TableReader& wheel);
DamperDescription read_damper(const TableReader& damper);
StopDescription read_stop(const std::optional<TableReader>& stop);
BrakeDescription read_brake(const std::optional<TableReader>& brake);

}  // namespace hamilcar::io
