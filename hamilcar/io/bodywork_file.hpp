// The table [body]: what a vehicle or a trailer looks like from outside.
#pragma once

#include <optional>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

std::optional<BodyworkDescription> read_bodywork(const std::optional<TableReader>& table);

}  // namespace hamilcar::io
