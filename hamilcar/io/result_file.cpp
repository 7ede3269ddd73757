#include "hamilcar/io/result_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "hamilcar/base/assert.hpp"
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
bool is_series(const NetcdfVariable& variable, std::size_t dimension) {
    return variable.dimensions == std::vector{dimension} && variable.type != NetcdfType::character;
}

// The numbers of a variable of this type and shape.
std::vector<double> numbers(NetcdfReader& file, const char* name, NetcdfType type,
                            const std::vector<std::uint64_t>& shape) {
    const auto found = file.header().variable(name);
    const NetcdfVariable* variable = found ? &file.header().variables[*found] : nullptr;
    if (!variable || variable->type != type || file.header().shape(*variable) != shape) {
        throw Error(ExitCode::bad_file, file.path() + ": expected the tiles of a road that hamilcar wrote");
    }
    return file.numbers(*variable);
}

std::vector<RoadTile> read_tiles(const std::string& path) {
    NetcdfReader file(path);
    const auto tile = file.header().dimension("tile");
    const std::uint64_t count = tile ? file.header().length(*tile) : 0;
    const std::vector<double> index = numbers(file, "index", NetcdfType::integer, {count, 2});
    const std::vector<double> heights =
        numbers(file, "height", NetcdfType::single_number, {count, tile_nodes, tile_nodes});
    std::vector<RoadTile> tiles(count);
    HAMILCAR_ASSERT(index.size() == 2 * count && heights.size() == heights_of_tile * count);
    for (std::size_t i = 0; i < count; ++i) {
        tiles[i] = {static_cast<int>(index[2 * i]), static_cast<int>(index[2 * i + 1]),
                    std::vector<float>(heights_of_tile)};
        for (std::size_t k = 0; k < heights_of_tile; ++k) {
            tiles[i].heights[k] = static_cast<float>(heights[i * heights_of_tile + k]);
        }
    }
    return tiles;
}

}  // namespace

ResultFile read_result(const std::string& path) {
    NetcdfReader file(path);
    const NetcdfHeader& header = file.header();
    ResultFile result{header.text("title"), header.text(scene_attribute), {}, {}, {}};
    const auto dimension = header.dimension("time"), time = header.variable("time");
    if (!dimension || !time || !is_series(header.variables[*time], *dimension)) {
        throw Error(ExitCode::bad_file, path +
                                            ": expected a result of hamilcar, with a variable time [s] of numbers over "
                                            "the dimension time alone");
    }
    if (header.length(*dimension) == 0)
        throw Error(ExitCode::bad_file, path + ": expected at least one row of results, found none");
    std::vector<std::size_t> columns{*time};
    for (std::size_t i = 0; i < header.variables.size(); ++i) {
        if (i != *time && is_series(header.variables[i], *dimension)) columns.push_back(i);
    }
    for (const std::size_t column : columns) {
        const NetcdfVariable& variable = header.variables[column];
        result.columns.push_back({variable.name, variable.text("units"), variable.text("long_name"),
                                  role_named(variable.text(role_attribute)), variable.text(role_of_attribute)});
    }
    result.values = file.series(columns);
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
    NetcdfHeader header{.dimensions = {{"tile", tiles.size()}, {"y", tile_nodes}, {"x", tile_nodes}, {"ix_iy", 2}}};
    header.variables = {
        {.name = "index", .type = NetcdfType::integer, .dimensions = {0, 3}},
        {.name = "height",
         .type = NetcdfType::single_number,
         .dimensions = {0, 1, 2},
         .attributes = {
             {"units", "m"},
             {"long_name", "road above z = 0; tile (ix, iy) begins at x = 16 ix, y = 16 iy, nodes every 0.25 m"}}}};
    std::string bytes;
    for (const RoadTile& tile : tiles) append_big_endian(bytes, tile.ix), append_big_endian(bytes, tile.iy);
    for (const RoadTile& tile : tiles) {
        for (const float height : tile.heights) append_big_endian(bytes, height);
    }
    write_netcdf(path, header, bytes);
}

}  // namespace hamilcar::io
