// Heights on a grid from an ESRI ASCII grid (`.asc`), the plain text that terrain programs exchange: ncols, nrows, xllcorner or
// xllcenter, yllcorner or yllcenter, cellsize, optionally NODATA_value, then rows of heights from north to south.
#pragma once

#include <string>
#include <string_view>

#include "hamilcar/description/road.hpp"

namespace hamilcar::io {

// Throws Error: input_output if it cannot be read, bad_file "path:line: ..." for what is no such grid.
HeightGridDescription read_grid(const std::string& path);
// Takes no more memory than a small multiple of the text, whatever sizes it announces.
HeightGridDescription parse_grid(std::string_view text, const std::string& path);

}  // namespace hamilcar::io
