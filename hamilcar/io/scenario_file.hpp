// Reads a scenario file (TOML) into a ScenarioDescription; docs/files/scenario.md lists the keys.
#pragma once

#include <string>

#include "hamilcar/description/scenario.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Throws Error (bad_file or input_output) with file, line, column, key, value, expectation and unit.
ScenarioDescription read_scenario(const std::string& path);
ScenarioDescription read_scenario(Node& document);  // of read_toml
ScenarioDescription read_scenario(const TableReader& file);

// Whether a file, with what it inherits, names a vehicle; otherwise it is one.
bool is_scenario(const Node& document);

}  // namespace hamilcar::io
