#include "page_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hamilcar/io/result_file.hpp"
#include "hamilcar/run/replay_rows.hpp"

namespace hamilcar::cli {

namespace {

constexpr std::size_t fewest_rows = 100;  // of a run, however many share a page

}  // namespace

io::PageRun read_run(const std::string& path, long rows, std::size_t runs) {
    io::ResultFile file = io::read_result(path);
    io::PageRun run{.name = std::move(file.title),
                    .file = path,
                    .columns = std::move(file.columns),
                    .values = std::move(file.values),
                    .scene = std::move(file.scene),
                    .tiles = std::move(file.tiles)};
    const auto moves = [](const io::Column& column) { return is_motion(column.role); };
    const bool of_earlier_version = !run.scene.empty() && std::ranges::none_of(run.columns, moves);
    if (of_earlier_version) run.scene.clear();
    const std::size_t all = run.values[0].size();
    thin(run, std::max(static_cast<std::size_t>(rows) / runs, fewest_rows));
    if (run.values[0].size() < all) {
        fmt::print(stderr, "hamilcar: {}: {} of {} rows are shown; --rows {} shows all\n", path, run.values[0].size(),
                   all, all * runs);
    }
    if (run.scene.empty()) {
        fmt::print(stderr, "hamilcar: {}: {}; plots only\n", path,
                   of_earlier_version ? "recorded by an earlier version, whose channels do not say what they are"
                                      : "no motion was recorded (output.motion)");
    }
    return run;
}

}  // namespace hamilcar::cli
