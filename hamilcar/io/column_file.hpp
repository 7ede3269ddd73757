// A table of numbers under headings, as instruments and `hamilcar run` write it: one of its columns over another.
#pragma once

#include <string>
#include <string_view>

#include "hamilcar/io/table_reader.hpp"

namespace hamilcar::io {

// Headings are asked for without their units: "steer" finds "steer" and "steer [rad]". A unit in brackets counts; without
// one the numbers are in the unit of the key.
struct ColumnRequest {
    std::string argument, value;               // headings
    std::string_view argument_key, value_key;  // what the numbers would be called in a scenario: "time_s", "angle_deg"
    Range range;                               // of the value, in the key's unit
};

// The first line that is neither empty nor begins with # has the headings, and its first comma, semicolon or tab tells what
// separates. The argument must increase. Throws Error(bad_file, "path:line: ...").
Samples parse_columns(std::string_view text, const std::string& path, const ColumnRequest& request);

// The text of the file that a key of a scenario names, without a mark before UTF-8. Throws Error(input_output) at that key, with
// the cause.
std::string read_named_file(const TableReader& table, std::string_view key);

}  // namespace hamilcar::io
