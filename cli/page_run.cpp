#include "page_run.hpp"

#include <fmt/format.h>

#include "hamilcar/io/result_file.hpp"
#include "hamilcar/run/film.hpp"

namespace hamilcar::cli {

namespace {

// Which columns only move the picture: those that its scene names.
bool moves_picture(const std::string& name) {
    for (const char* part : {".pose.", ".contact.", ".ground_force."}) {
        if (name.find(part) != std::string::npos) return true;
    }
    return false;
}

}  // namespace

io::PageRun read_run(const std::string& path, long rows) {
    io::ResultFile file = io::read_result(path);
    io::PageRun run{.name = std::move(file.title),
                    .file = path,
                    .columns = std::move(file.columns),
                    .values = std::move(file.values),
                    .motion = {},
                    .scene = std::move(file.scene),
                    .tiles = std::move(file.tiles)};
    for (const io::Column& column : run.columns) run.motion.push_back(moves_picture(column.name));
    const std::size_t all = run.values[0].size();
    thin(run, static_cast<std::size_t>(rows));
    if (run.values[0].size() < all) {
        fmt::print(stderr, "hamilcar: {}: {} of {} rows are shown; --rows {} shows all\n", path, run.values[0].size(),
                   all, all);
    }
    if (run.scene.empty()) {
        fmt::print(stderr, "hamilcar: {}: no motion was recorded (output.motion); plots only\n", path);
    }
    return run;
}

}  // namespace hamilcar::cli
