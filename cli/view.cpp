// `hamilcar view RESULT...`: the replay of one run or of several beside each other, with their plots, as one page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "browser.hpp"
#include "commands.hpp"
#include "files.hpp"
#include "page_run.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

struct ViewOptions {
    std::vector<std::string> results;
    std::string output;
    long rows = 20000;
    bool open = false;
};

// Scenario and, where several results share that, the folder that tells them apart.
std::string name_of(const std::string& path, const std::string& title, bool alone) {
    if (alone) return title;
    const std::string folder = fs::absolute(path).parent_path().filename().string();
    return title.empty() ? folder : fmt::format("{} ({})", title, folder);
}

// Runs that have one name are told apart by their files'.
void name_apart(std::vector<io::PageRun>& runs) {
    std::vector<std::string> names;
    for (const io::PageRun& run : runs) names.push_back(run.name);
    for (io::PageRun& run : runs) {
        if (std::ranges::count(names, run.name) > 1) run.name = fs::path(run.file).stem().string() + ", " + run.name;
    }
}

struct Extremes {
    double min, max;
};

Extremes extremes(const std::vector<double>& values) {
    Extremes found{std::nan(""), std::nan("")};
    for (const double value : values) {
        found.min = std::fmin(found.min, value), found.max = std::fmax(found.max, value);
    }
    return found;
}

// The smallest and the largest value of every channel, run beside run.
io::Table comparison(const std::vector<io::PageRun>& runs) {
    io::Table table{"Smallest and largest values", {{"channel", ""}, {"unit", ""}}, {}};
    for (const io::PageRun& run : runs) {
        table.columns.emplace_back(run.name + ", smallest", "");
        table.columns.emplace_back("largest", "");
    }
    const std::vector<io::Column>& first = runs[0].columns;
    for (std::size_t i = 1; i < first.size(); ++i) {
        if (is_motion(runs[0].columns[i].role)) continue;
        std::vector<io::Cell> row{first[i].name, first[i].unit};
        for (const io::PageRun& run : runs) {
            const auto same = [&](const io::Column& column) { return column.name == first[i].name; };
            const auto at = std::ranges::find_if(run.columns, same) - run.columns.begin();
            if (at == static_cast<std::ptrdiff_t>(run.columns.size())) {
                row.insert(row.end(), 2, io::Cell());
                continue;
            }
            const Extremes range = extremes(run.values[static_cast<std::size_t>(at)]);
            row.emplace_back(range.min), row.emplace_back(range.max);
        }
        table.rows.push_back(row);
    }
    return table;
}

io::ExitCode view(const ViewOptions& options) {
    io::Page page;
    if (!options.output.empty()) check_output(options.output);
    for (const std::string& file : options.results) {
        page.runs.push_back(read_run(file, options.rows, options.results.size()));
        page.runs.back().name = name_of(file, page.runs.back().name, options.results.size() == 1);
    }
    name_apart(page.runs);
    const bool alone = page.runs.size() == 1;
    page.title = alone ? page.runs[0].name : fmt::format("{} runs", page.runs.size());
    for (const io::PageRun& run : page.runs) page.subtitle += (page.subtitle.empty() ? "" : ", ") + run.file;
    page.blocks = {io::Replay{}, io::Heading{alone ? "Range of every channel" : "Comparison"}, comparison(page.runs)};
    const fs::path folder = fs::path(options.results[0]).parent_path();
    const std::string path =
        options.output.empty() ? (folder / (alone ? "view.html" : "comparison.html")).string() : options.output;
    io::write_page(path, page);
    fmt::print("{}\n", path);
    if (options.open) open_in_browser(fs::absolute(path).string());
    return io::ExitCode::ok;
}

}  // namespace

void add_view(CommandList& list) {
    auto [command, o] = list.add<ViewOptions>(
        "view", "show results as an animation with plots: one page that opens in any browser", view);
    command.add("results", o.results, "result files (results.nc); several are compared").required();
    command.add("-o,--output", o.output, "the page [view.html or comparison.html beside the first result]");
    command.add("--rows", o.rows, {100, 1e7}, "of all runs together, at most");
    command.add("--open", o.open, "open it in the browser");
}

}  // namespace hamilcar::cli
