#include "outcome_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "files.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/result_file.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

void write_replay(const std::string& path, const io::PageRun& run) {
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
        const std::string value =
            std::isfinite(f.value) ? fmt::format("{:.5g} {}", without_round_off(f.value), f.unit) : "not shown";
        fmt::print("  {:<{}}  {}\n", f.name, width, value);
    }
    for (const Verdict& v : outcome.verdicts) {
        fmt::print("  {}: {}{}\n", v.passed ? "passed" : "NOT PASSED", v.criterion,
                   v.found.empty() ? "" : " (" + v.found + ")");
    }
    for (const std::string& note : outcome.notes) fmt::print("  note: {}\n", note);
    for (const ValidityWarning& warning : outcome.validity) fmt::print("  validity: {}\n", sentence(warning));
    const EnergyBalance& energy = outcome.energy;
    if (outcome.stopped == Stopped::numerical) return;  // told with the reason
    if (!energy.is_kept) {
        fmt::print("  energy: no account was kept\n");
    } else {
        fmt::print("  energy balance error: {:.2g} of the energy exchanged\n",
                   energy.exchanged > 0 ? energy.error() / energy.exchanged : 0);
    }
}

// The one that stands there of an earlier drive, if any.
std::optional<ManeuverRun> earlier_run(const std::string& outcome) {
    try {
        return read_outcome(outcome).first;
    } catch (const io::Error&) {
        return {};
    }
}

// Those of the earlier drive whose outcome this is: beside another one's figures they would be taken for its own.
void remove_pictures(const std::string& outcome, const ManeuverRun& earlier) {
    std::error_code gone_already;
    for (const std::string& file : earlier.files) {
        const fs::path name = fs::path(file).filename(), path = fs::path(outcome).replace_filename(name);
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

}  // namespace

void print_and_write(ManeuverRun run, const Outcome& outcome, const std::string& folder, bool json) {
    const std::vector<std::string> files = run.files = files_of(outcome, folder);
    nlohmann::ordered_json facts = outcome_json(run, outcome);
    const std::optional<ManeuverRun> earlier = earlier_run(files.front());
    const bool keeps_earlier = run.interrupted && fs::exists(files.front()) && !(earlier && earlier->interrupted);
    const std::string text = io::json_text(facts, 1) + "\n";
    if (json) {
        if (keeps_earlier) facts["files"] = nlohmann::ordered_json::array();
        facts.erase("charts");
        fmt::print("{}\n", io::json_text(facts));
    } else {
        print_outcome(run, outcome);
    }
    if (run.interrupted) {
        fmt::print(stderr, "hamilcar: interrupted: what is told is of a part of {}{}\n", run.maneuver,
                   keeps_earlier ? "; " + files.front() + " stays that of the whole drive before" : "");
    }
    if (keeps_earlier) return;
    write_file(files.front(), text);  // whole or not at all: on a full disk that of the earlier drive stays
    if (earlier) remove_pictures(files.front(), *earlier);
    const auto wrote = [&](const std::string& file) {
        if (!json) fmt::print("  wrote {}\n", file);
    };
    wrote(files.front());
    for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
        write_replay(files[i + 1], outcome.runs[i]);
        wrote(files[i + 1]);
    }
    io::write_page(files.back(), outcome_page(run, outcome));
    wrote(files.back());
}

}  // namespace hamilcar::cli
