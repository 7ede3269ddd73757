// Results of a run as they are read back: the columns of a netCDF file with what a picture of the run needs.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/io/results.hpp"
#include "hamilcar/road/tile.hpp"

namespace hamilcar::io {

// Attribute that holds the scene (run/scene.hpp).
inline constexpr const char* scene_attribute = "scene";

struct ResultFile {
    std::string title;
    std::string scene;                        // JSON; empty if the file has none
    std::vector<Column> columns;              // the first is "time"
    std::vector<std::vector<double>> values;  // of each column, a number for every row
    std::vector<RoadTile> tiles;
};

// Throws Error(bad_file) for what is no result of hamilcar's, Error(input_output) for what cannot be read.
ResultFile read_result(const std::string& path);

// The tiles of an uneven road stand in a file beside the results: where the run will lead is not known when theirs begins.
std::string tiles_beside(const std::string& result_path);
void write_tiles(const std::string& path, const std::vector<RoadTile>& tiles);

}  // namespace hamilcar::io
