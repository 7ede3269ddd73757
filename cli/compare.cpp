// `hamilcar compare`: outcomes of maneuvers side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "browser.hpp"
#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/maneuver/comparison.hpp"
#include "page_run.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

struct CompareOptions {
    std::vector<std::string> outcomes;
    std::string output = "comparison.html", csv;
    long rows = 20000;
    bool open = false, json = false;
};

NamedOutcome read_one(const std::string& given, long rows, std::size_t outcomes) {
    const fs::path path = fs::is_directory(given) ? fs::path(given) / "outcome.json" : fs::path(given);
    if (!fs::exists(path)) {
        throw io::Error(io::ExitCode::input_output, path.string() +
                                                        ": not there; expected what 'hamilcar run --maneuver' wrote "
                                                        "('hamilcar view' compares results of scenarios)");
    }
    NamedOutcome run = read_outcome(path.string());
    if (run.first.interrupted) {
        fmt::print(stderr, "hamilcar: note: {} is of a maneuver that was interrupted\n", path.string());
    }
    const fs::path replay = path.parent_path() / "drive.nc";
    if (fs::exists(replay)) run.second.runs.push_back(read_run(replay.string(), rows, outcomes));
    return run;
}

std::string value_text(double value) {
    return std::isfinite(value) ? fmt::format("{:.5g}", without_round_off(value)) : "-";
}

// Of two runs with their difference, of more with those from the first.
void print_comparison(const Comparison& comparison) {
    fmt::print("Runs:\n");
    for (std::size_t i = 0; i < comparison.labels.size(); ++i) fmt::print("  {}  {}\n", i + 1, comparison.labels[i]);
    std::size_t width = 0;
    for (const Comparison::Row& row : comparison.figures) width = std::max(width, row.name.size());
    fmt::print("\n  {:<{}}  {:<12}", "", width, "unit");
    for (std::size_t i = 0; i < comparison.labels.size(); ++i) fmt::print("{:>11}", i + 1);
    for (std::size_t i = 1; i < comparison.labels.size(); ++i) fmt::print("{:>13}", fmt::format("{} - 1", i + 1));
    fmt::print("\n");
    for (const Comparison::Row& row : comparison.figures) {
        fmt::print("  {:<{}}  {:<12}", row.name, width, row.unit);
        for (const double value : row.values) fmt::print("{:>11}", value_text(value));
        for (std::size_t i = 1; i < row.values.size(); ++i) fmt::print("{:>13}", value_text(row.difference(i)));
        fmt::print("\n");
    }
    for (const Comparison::Judged& row : comparison.verdicts) {
        fmt::print("  {}:", row.criterion);
        for (std::size_t i = 0; i < row.passed.size(); ++i) {
            fmt::print("{} {} {}", i == 0 ? "" : ",", i + 1,
                       !row.passed[i]   ? "-"
                       : *row.passed[i] ? "passed"
                                        : "NOT PASSED");
        }
        fmt::print("\n");
    }
}

io::ExitCode compare(const CompareOptions& options) {
    if (options.outcomes.size() < 2) {
        throw io::Error(io::ExitCode::usage,
                        "compare: expected two outcomes or more, folders that 'hamilcar run --maneuver' "
                        "wrote; 'hamilcar view' shows one");
    }
    check_output(options.output);
    if (!options.csv.empty()) check_table_output(options.csv);
    std::vector<NamedOutcome> runs;
    for (const std::string& given : options.outcomes) {
        runs.push_back(read_one(given, options.rows, options.outcomes.size()));
        if (runs.back().first.maneuver != runs[0].first.maneuver) {
            fmt::print(stderr, "hamilcar: note: different maneuvers: {} has {}, {} has {}\n", options.outcomes[0],
                       runs[0].first.maneuver, given, runs.back().first.maneuver);
        }
    }
    const Comparison comparison = hamilcar::compare(runs);
    if (options.json) {
        fmt::print("{}\n", io::json_text(comparison_json(comparison, runs)));
    } else {
        print_comparison(comparison);
    }
    if (!options.csv.empty()) {
        write_file(options.csv, comparison_csv(comparison));
        tell_written(options.json, options.csv);
    }
    io::write_page(options.output, comparison_page(std::move(runs)));
    tell_written(options.json, options.output);
    if (options.open) open_in_browser(fs::absolute(options.output).string());
    return io::ExitCode::ok;
}

}  // namespace

void add_compare(CommandList& list) {
    auto [command, o] = list.add<CompareOptions>(
        "compare", "put the outcomes of several maneuvers side by side, with differences from the first", compare);
    command.add("outcomes", o.outcomes, "folders that 'run --maneuver' wrote, or their outcome.json").required();
    command.add("-o,--output", o.output, "the page");
    command.add("--csv", o.csv, "file for figures and verdicts as a table");
    command.add("--rows", o.rows, {100, 1e7}, "of all drives together, at most");
    command.add("--open", o.open, "open it in the browser");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
