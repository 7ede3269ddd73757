#include "outcome_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

void write_rows(io::ResultWriter& file, const io::PageRun& run) {
    std::vector<double> row(run.columns.size() - 1);
    for (std::size_t i = 0; i < run.values[0].size(); ++i) {
        for (std::size_t k = 0; k < row.size(); ++k) row[k] = run.values[k + 1][i];
        file.write(run.values[0][i], row);
    }
    file.close();
}

// With what it takes to drive it again.
std::vector<std::pair<std::string, std::string>> attributes_of(const ManeuverRun& driven, const io::PageRun& run) {
    std::vector<std::pair<std::string, std::string>> out{
        {io::scene_attribute, run.scene},      {"vehicle", driven.vehicle},
        {"vehicle_file", driven.vehicle_file}, {"vehicle_set", fmt::format("{}", fmt::join(driven.vehicle_set, " "))},
        {"maneuver", driven.maneuver},         {"integrator", driven.integrator},
        {"step_s", number_text(driven.step)}};
    for (const auto& [setting, value] : driven.settings) {
        out.emplace_back("setting_" + setting_key(setting), setting_text(setting, value));
    }
    return out;
}

void write_recording(const std::string& path, const ManeuverRun& driven, const io::PageRun& run) {
    const std::vector<io::Column> columns(run.columns.begin() + 1, run.columns.end());
    if (path.ends_with(".csv")) return write_rows(*io::open_csv(path, columns), run);
    write_rows(*io::open_netcdf(path, columns, run.name, attributes_of(driven, run)), run);
    if (!run.tiles.empty()) io::write_tiles(io::tiles_beside(path), run.tiles);
}

void print_outcome(const ManeuverRun& run, const Outcome& outcome) {
    fmt::print("{} ({}) with {}\n", run.title, run.standard, run.vehicle);
    for (const std::string& assignment : run.vehicle_set) fmt::print("  vehicle with {}\n", assignment);
    std::size_t width = 0;
    for (const Figure& f : outcome.figures) width = std::max(width, f.name.size());
    for (const Figure& f : outcome.figures) {
        std::string value =
            std::isfinite(f.value) ? fmt::format("{:.5g} {}", without_round_off(f.value), f.unit) : "not shown";
        const std::optional<Figure> other = per_g(f);
        if (other && std::isfinite(f.value)) value += fmt::format(" = {:.4g} {}", other->value, other->unit);
        fmt::print("  {:<{}}  {}\n", f.name, width, value);
    }
    for (const Verdict& v : outcome.verdicts) {
        fmt::print("  {}: {}{}\n", v.passed ? "passed" : "NOT PASSED", v.criterion,
                   v.found.empty() ? "" : " (" + v.found + ")");
    }
    for (const std::string& note : outcome.notes) fmt::print("  note: {}\n", note);
    for (const std::string& line : sentences(outcome.validity)) fmt::print("  validity: {}\n", line);
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
        const bool recording =
            name.string().starts_with("drive") && (name.extension() == ".nc" || name.extension() == ".csv");
        if (name.extension() == ".nc" && recording) fs::remove(io::tiles_beside(path.string()), gone_already);
        if (recording || name == "report.html") fs::remove(path, gone_already);
    }
}

// The outcome first, the page last, between them the recordings of each run.
std::vector<std::string> files_of(const Outcome& outcome, const OutcomePlace& place) {
    std::vector<std::string> files{place.folder + "/outcome.json"};
    for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
        const std::string name = fmt::format("{}/drive{}", place.folder, i == 0 ? "" : fmt::format("_{}", i + 1));
        files.push_back(name + ".nc");
        if (place.csv) files.push_back(name + ".csv");
    }
    files.push_back(place.folder + "/report.html");
    return files;
}

}  // namespace

void print_and_write(ManeuverRun run, const Outcome& outcome, const OutcomePlace& place) {
    const std::vector<std::string> files = run.files = files_of(outcome, place);
    nlohmann::ordered_json facts = outcome_json(run, outcome);
    const std::optional<ManeuverRun> earlier = earlier_run(files.front());
    const bool keeps_earlier = run.interrupted && fs::exists(files.front()) && !(earlier && earlier->interrupted);
    const std::string text = io::json_text(facts, 1) + "\n";
    if (place.json) {
        if (keeps_earlier) facts["files"] = nlohmann::ordered_json::array();
        facts.erase("charts");
        fmt::print("{}\n", io::json_text(facts));
    } else if (!place.silent) {
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
        if (!place.json && !place.silent) fmt::print("  wrote {}\n", file);
    };
    wrote(files.front());
    const std::size_t files_each = place.csv ? 2 : 1;
    for (std::size_t i = 1; i + 1 < files.size(); ++i) {
        write_recording(files[i], run, outcome.runs[(i - 1) / files_each]);
        wrote(files[i]);
    }
    io::write_page(files.back(), outcome_page(run, outcome));
    wrote(files.back());
}

}  // namespace hamilcar::cli
