// Reads what hangs on a suspension: wheel, damper, stops, brake.
#pragma once

#include <optional>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"
#include "hamilcar/io/tire_table.hpp"

namespace hamilcar::io {

WheelDescription read_wheel(const TableReader& wheel);
DamperDescription read_damper(const TableReader& damper);
StopDescription read_stop(const std::optional<TableReader>& stop);
BrakeDescription read_brake(const std::optional<TableReader>& brake);

}  // namespace hamilcar::io
