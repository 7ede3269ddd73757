#include "hamilcar/io/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/netcdf_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t heights_of_tile = std::size_t{tile_nodes} * std::size_t{tile_nodes};

// Whether a picture can be drawn of it, and whether its road needs tiles.
bool check_scene(const std::string& path, const std::string& text) {
    const nlohmann::json scene = parse_json(text);
    if (scene.is_discarded()) {
        throw Error(ExitCode::bad_file,
                    fmt::format("{}: attribute 'scene': expected JSON, nested {} deep at most", path, max_json_depth));
    }
    for (const char* part : {"frames", "links", "wheels", "tires", "bodies"}) {
        if (scene.is_object() && scene.contains(part) && scene[part].is_array()) continue;
        throw Error(ExitCode::bad_file,
                    fmt::format("{}: attribute 'scene': expected what hamilcar writes there, with a "
                                "list '{}'",
                                path, part));
    }
    const auto road = scene.find("road");
    if (road == scene.end() || !road->is_object()) {
        throw Error(ExitCode::bad_file, path + ": attribute 'scene': expected a road in it");
    }
    const auto uneven = road->find("uneven");
    if (uneven == road->end()) return false;
    if (uneven->is_boolean()) return uneven->get<bool>();
    throw Error(ExitCode::bad_file, path + ": attribute 'scene': expected 'uneven' of its road to be true or false");
}

// Whether a variable is numbers over one dimension, the given one.
bool is_series(const NetcdfFile& file, int variable, int dimension) {
    int dimensions = 0, first = 0;
    nc_type type = NC_NAT;
    file.check(nc_inq_varndims(file.id(), variable, &dimensions), "read a shape");
    file.check(nc_inq_vartype(file.id(), variable, &type), "read a type");
    if (dimensions != 1 || type == NC_CHAR || type == NC_STRING) return false;
    return nc_inq_vardimid(file.id(), variable, &first) == NC_NOERR && first == dimension;
}

// Of every column all rows. A block of rows at a time: in the file all columns of a row stand together.
std::vector<std::vector<double>> read_rows(const NetcdfFile& file, const std::vector<int>& columns, std::size_t rows) {
    constexpr std::size_t rows_per_block = 1024;
    std::vector<std::vector<double>> values(columns.size(), std::vector<double>(rows));
    for (std::size_t row = 0; row < rows; row += rows_per_block) {
        const std::size_t count = std::min(rows_per_block, rows - row);
        for (std::size_t i = 0; i < columns.size(); ++i) {
            file.check(nc_get_vara_double(file.id(), columns[i], &row, &count, values[i].data() + row), "read rows");
        }
    }
    return values;
}

// The dimensions of a variable, by their lengths.
void expect_shape(const NetcdfFile& file, const std::string& path, int variable,
                  const std::vector<std::size_t>& shape) {
    int dimensions = 0;
    file.check(nc_inq_varndims(file.id(), variable, &dimensions), "read a shape");
    std::vector<int> ids(static_cast<std::size_t>(dimensions));
    file.check(nc_inq_vardimid(file.id(), variable, ids.data()), "read a shape");
    std::vector<std::size_t> lengths(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) nc_inq_dimlen(file.id(), ids[i], &lengths[i]);
    if (lengths != shape) throw Error(ExitCode::bad_file, path + ": expected the tiles of a road that hamilcar wrote");
}

std::vector<RoadTile> read_tiles(const std::string& path) {
    const NetcdfFile file(path, NetcdfFile::Mode::read);
    int dimension = 0, index = 0, height = 0;
    std::size_t count = 0;
    file.check(nc_inq_dimid(file.id(), "tile", &dimension), "find the dimension tile");
    file.check(nc_inq_dimlen(file.id(), dimension, &count), "read the dimension tile");
    file.check(nc_inq_varid(file.id(), "index", &index), "find index");
    file.check(nc_inq_varid(file.id(), "height", &height), "find height");
    expect_shape(file, path, index, {count, 2});
    expect_shape(file, path, height, {count, tile_nodes, tile_nodes});
    std::vector<RoadTile> tiles(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<int, 2> at{};
        const std::array<std::size_t, 3> start{i, 0, 0}, two{1, 2, 0}, square{1, tile_nodes, tile_nodes};
        file.check(nc_get_vara_int(file.id(), index, start.data(), two.data(), at.data()), "read index");
        tiles[i] = {at[0], at[1], std::vector<float>(heights_of_tile)};
        file.check(nc_get_vara_float(file.id(), height, start.data(), square.data(), tiles[i].heights.data()),
                   "read height");
    }
    return tiles;
}

}  // namespace

ResultFile read_result(const std::string& path) {
    const NetcdfFile file(path, NetcdfFile::Mode::read);
    ResultFile result{file.text(NC_GLOBAL, "title"), file.text(NC_GLOBAL, scene_attribute), {}, {}, {}};
    int time = 0, variables = 0, dimension = 0;
    std::size_t rows = 0;
    if (nc_inq_dimid(file.id(), "time", &dimension) != NC_NOERR || nc_inq_varid(file.id(), "time", &time) != NC_NOERR ||
        !is_series(file, time, dimension)) {
        throw Error(ExitCode::bad_file, path +
                                            ": expected a result of hamilcar, with a variable time [s] of numbers over "
                                            "the dimension time alone");
    }
    file.check(nc_inq_dimlen(file.id(), dimension, &rows), "read the dimension time");
    if (rows == 0) throw Error(ExitCode::bad_file, path + ": expected at least one row of results, found none");
    file.check(nc_inq_nvars(file.id(), &variables), "count the variables");
    std::vector<int> columns{time};
    for (int variable = 0; variable < variables; ++variable) {
        if (variable != time && is_series(file, variable, dimension)) columns.push_back(variable);
    }
    for (const int variable : columns) {
        std::array<char, NC_MAX_NAME + 1> name{};
        file.check(nc_inq_varname(file.id(), variable, name.data()), "read a name");
        result.columns.push_back({name.data(), file.text(variable, "units"), file.text(variable, "long_name"),
                                  role_named(file.text(variable, role_attribute)),
                                  file.text(variable, role_of_attribute)});
    }
    result.values = read_rows(file, columns, rows);
    const std::string tiles = tiles_beside(path);
    const bool uneven = !result.scene.empty() && check_scene(path, result.scene);
    if (uneven && std::filesystem::exists(tiles)) result.tiles = read_tiles(tiles);
    return result;
}

std::string tiles_beside(const std::string& result_path) {
    std::filesystem::path path(result_path);
    return path.replace_extension(".road").string();
}

void write_tiles(const std::string& path, const std::vector<RoadTile>& tiles) {
    const NetcdfFile file(path, NetcdfFile::Mode::create);
    const int tile = file.define_dimension("tile", tiles.size()), y = file.define_dimension("y", tile_nodes),
              x = file.define_dimension("x", tile_nodes), two = file.define_dimension("ix_iy", 2);
    const int index = file.define_variable("index", NC_INT, {tile, two});
    const int height = file.define_variable("height", NC_FLOAT, {tile, y, x});
    file.set_text(height, "units", "m");
    file.set_text(height, "long_name",
                  "road above z = 0; tile (ix, iy) begins at x = 16 ix, y = 16 iy, nodes every 0.25 m");
    file.check(nc_enddef(file.id()), "write the header");
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const std::array<int, 2> at{tiles[i].ix, tiles[i].iy};
        const std::array<std::size_t, 3> start{i, 0, 0}, pair{1, 2, 0}, square{1, tile_nodes, tile_nodes};
        file.check(nc_put_vara_int(file.id(), index, start.data(), pair.data(), at.data()), "write index");
        file.check(nc_put_vara_float(file.id(), height, start.data(), square.data(), tiles[i].heights.data()),
                   "write height");
    }
    file.check(nc_sync(file.id()), "write");
}

}  // namespace hamilcar::io
