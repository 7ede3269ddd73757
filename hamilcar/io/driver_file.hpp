// Reads the driver of a scenario.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/description/driver.hpp"
#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

DriverDescription read_driver(const TableReader& table);

// Points of a path from text: a line "x,y" for each [m]; empty lines, lines that start with '#' and one line of headings, with
// no number in it, do not count. `path` is for messages.
std::vector<std::array<double, 2>> parse_path_points(std::string_view text, const std::string& path);

}  // namespace hamilcar::io
