#include "outcome_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/result_file.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

void write_film(const std::string& path, const io::PageRun& run) {
    std::vector<io::Column> columns(run.columns.begin() + 1, run.columns.end());
    const auto file = io::open_netcdf(path, columns, run.name, {{io::scene_attribute, run.scene}});
    std::vector<double> row(columns.size());
    for (std::size_t i = 0; i < run.values[0].size(); ++i) {
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = run.values[k + 1][i];
        file->write(run.values[0][i], row);
    }
    file->close();
    if (!run.tiles.empty()) io::write_tiles(io::tiles_beside(path), run.tiles);
}

void print_outcome(const ManeuverRun& run, const Outcome& outcome) {
    fmt::print("{} ({}) with {}\n", run.title, run.standard, run.vehicle);
    std::size_t width = 0;
    for (const Figure& f : outcome.figures) width = std::max(width, f.name.size());
    for (const Figure& f : outcome.figures) {
        const std::string value = std::isfinite(f.value) ? fmt::format("{:.5g} {}", f.value, f.unit) : "not shown";
        fmt::print("  {:<{}}  {}\n", f.name, width, value);
    }
    for (const Verdict& v : outcome.verdicts) {
        fmt::print("  {}: {}{}\n", v.passed ? "passed" : "NOT PASSED", v.criterion,
                   v.found.empty() ? "" : " (" + v.found + ")");
    }
    for (const std::string& note : outcome.notes) fmt::print("  note: {}\n", note);
    const EnergyBook& energy = outcome.energy;
    if (outcome.stopped == Stopped::numerical) return;  // told with the reason
    if (!energy.is_kept) {
        fmt::print("  energy: no account was kept\n");
    } else {
        fmt::print("  energy: the account closes to {:.2g} of what was turned over\n",
                   energy.turnover > 0 ? energy.error() / energy.turnover : 0);
    }
}

// Null where it cannot be read.
nlohmann::json facts_of(const std::string& outcome) {
    try {
        return io::parse_json(io::read_whole_file(outcome, io::LargestFile::outcome));
    } catch (const io::Error&) {
        return nullptr;
    }
}

// Those of the earlier drive whose outcome this is: beside another one's figures they would be taken for its own.
void remove_pictures(const std::string& outcome, const nlohmann::json& facts) {
    if (!facts.is_object() || !facts.contains("files") || !facts["files"].is_array()) return;
    std::error_code gone_already;
    for (const nlohmann::json& file : facts["files"]) {
        if (!file.is_string()) continue;
        const fs::path name = fs::path(file.get<std::string>()).filename(),
                       path = fs::path(outcome).replace_filename(name);
        if (name.string().starts_with("drive") && name.extension() == ".nc") {
            fs::remove(io::tiles_beside(path.string()), gone_already);
            fs::remove(path, gone_already);
        }
        if (name == "report.html") fs::remove(path, gone_already);
    }
}

std::vector<std::string> files_of(const Outcome& outcome, const std::string& folder) {
    std::vector<std::string> files{folder + "/outcome.json"};
    for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
        files.push_back(fmt::format("{}/drive{}.nc", folder, i == 0 ? "" : fmt::format("_{}", i + 1)));
    }
    files.push_back(folder + "/report.html");
    return files;
}

// Whole or not at all: on a full disk the outcome of an earlier drive stays.
void write_outcome(const std::string& path, const std::string& text) {
    const nlohmann::json earlier = facts_of(path);
    write_file(path, text);
    remove_pictures(path, earlier);
}

}  // namespace

bool says_interrupted(const std::string& outcome) {
    const nlohmann::json facts = facts_of(outcome);
    return facts.is_object() && facts.value("interrupted", nlohmann::json(false)) == true;
}

void tell_and_write(const ManeuverRun& run, const Outcome& outcome, bool stopped, const std::string& folder,
                    const Options& options) {
    const std::vector<std::string> files = files_of(outcome, folder);
    nlohmann::ordered_json facts = outcome_json(run, outcome);
    facts["interrupted"] = stopped;
    if (stopped) facts["passed"] = false;
    facts["files"] = files;
    const bool keeps_earlier = stopped && fs::exists(files.front()) && !says_interrupted(files.front());
    const std::string text = io::json_text(facts, 1) + "\n";
    if (options.json) {
        if (keeps_earlier) facts["files"] = nlohmann::ordered_json::array();
        facts.erase("charts");
        fmt::print("{}\n", io::json_text(facts));
    } else {
        print_outcome(run, outcome);
    }
    if (stopped) {
        fmt::print(stderr, "hamilcar: interrupted: what is told is of a part of {}{}\n", run.maneuver,
                   keeps_earlier ? "; " + files.front() + " stays that of the whole drive before" : "");
    }
    if (keeps_earlier) return;
    write_outcome(files.front(), text);
    const auto wrote = [&](const std::string& file) {
        if (!options.json) fmt::print("  wrote {}\n", file);
    };
    wrote(files.front());
    for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
        write_film(files[i + 1], outcome.runs[i]);
        wrote(files[i + 1]);
    }
    io::write_page(files.back(), outcome_page(run, outcome));
    wrote(files.back());
}

}  // namespace hamilcar::cli
