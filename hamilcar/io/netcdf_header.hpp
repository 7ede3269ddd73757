// The header of a netCDF classic file, held against the file's size before a library that believes it is let near.
#pragma once

#include <string>

namespace hamilcar::io {

// Throws Error: input_output for what cannot be read, bad_file for what is no netCDF classic file (its first bytes are
// "CDF" and 1, 2 or 5; a netCDF-4 file is HDF5, which hamilcar never writes), or one whose header asks for more data
// than the file has.
void check_netcdf_header(const std::string& path);

}  // namespace hamilcar::io
