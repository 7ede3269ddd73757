// Reads a scenario file (TOML) into a ScenarioDescription; docs/files/scenario.md lists the keys.
#pragma once

#include <string>

#include "hamilcar/description/scenario.hpp"

namespace hamilcar::io {

// Throws Error (bad_file or input_output) with file, line, column, key, value, expectation and unit.
ScenarioDescription read_scenario(const std::string& path);

// Whether a file, with what it inherits, names a vehicle; otherwise it is one. Throws like read_scenario.
bool is_scenario(const std::string& path);

}  // namespace hamilcar::io
