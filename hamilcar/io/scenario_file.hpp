// Reads a scenario file (TOML) into a ScenarioDescription; docs/files/scenario.md lists the keys.
#pragma once

#include <string>
#include <string_view>

#include "hamilcar/description/scenario.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Throws Error (bad_file or input_output) with file, line, column, key, value, expectation and unit.
ScenarioDescription read_scenario(const std::string& path);
ScenarioDescription read_scenario(const TableReader& file);

// "file:line:column" of a dotted key, in the file or in what it inherits; of the deepest part that is there. Throws like
// read_scenario.
std::string place_of(const std::string& path, std::string_view key);

// Whether a file, with what it inherits, names a vehicle; otherwise it is one. Throws like read_scenario.
bool is_scenario(const std::string& path);

}  // namespace hamilcar::io
