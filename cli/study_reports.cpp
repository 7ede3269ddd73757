#include "study_reports.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "hamilcar/base/text.hpp"
#include "interrupt.hpp"
#include "maneuver.hpp"
#include "run_options.hpp"

namespace hamilcar::cli {

namespace {

std::string folder_of(std::size_t point, const std::string& run) {
    return fmt::format("point_{}/{}", point + 1, run);
}

}  // namespace

std::vector<std::size_t> points_called(const std::vector<std::string>& words, const StudyTable& table) {
    std::vector<std::size_t> out;
    for (const std::string& word : words) {
        if (word == "all") {
            out.resize(table.points.size());
            std::iota(out.begin(), out.end(), std::size_t{0});
            return out;
        }
        const auto number = number_in(word);
        const auto best = word == "best" ? table.best() : std::nullopt;
        const double count = static_cast<double>(table.points.size());
        if (best) {
            out.push_back(*best);
        } else if (number && *number >= 1 && *number <= count && *number == std::floor(*number)) {
            out.push_back(static_cast<std::size_t>(*number) - 1);
        } else if (word == "best") {
            throw io::Error(io::ExitCode::usage, "--report best: the study has no goals that a point could meet");
        } else {
            throw io::Error(io::ExitCode::usage,
                            fmt::format("--report '{}': expected a point, 1 to {}, 'best' or 'all'", word, count));
        }
    }
    return out;
}

void write_reports(const StudyDescription& study, const StudyTable& table, std::size_t point,
                   const std::string& folder) {
    const VehicleChoice vehicle{study.vehicle, vehicle_set(study, table.points[point]), study.file};
    for (const StudyRun& run : study.runs) {
        if (!run.analysis.empty() || interrupted()) continue;
        const RunOptions options{.scenario = run.scenario.empty() ? study.file : run.scenario,
                                 .vehicle = vehicle,
                                 .output = folder + "/" + folder_of(point, run.name),
                                 .silent = true};
        try {
            run_scenario(options, scenario_of(study, table.points[point], run));
        } catch (const io::Error& error) {
            if (error.code() == io::ExitCode::input_output) throw;
            fmt::print(stderr, "hamilcar: point {}, {}: {}\n", point + 1, run.name, error.what());
        }
    }
}

void remove_reports(const StudyTable& table, const std::string& folder) {
    for (const std::vector<std::string>& point : reports_in(folder, table)) {
        for (const std::string& report : point) {
            if (!report.empty()) std::filesystem::remove(std::filesystem::path(folder) / report);
        }
    }
}

std::vector<std::vector<std::string>> reports_in(const std::string& folder, const StudyTable& table) {
    std::vector<std::vector<std::string>> out(table.points.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        for (const std::string& run : table.runs) {
            const std::string report = folder_of(i, run) + "/report.html";
            out[i].push_back(std::filesystem::exists(std::filesystem::path(folder) / report) ? report : "");
        }
    }
    return out;
}

}  // namespace hamilcar::cli
