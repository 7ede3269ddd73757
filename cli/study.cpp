// `hamilcar study STUDY`: variants of a vehicle through maneuvers and analyses, as one table and one page.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "browser.hpp"
#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/study/study_file.hpp"
#include "hamilcar/study/study_record.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "resume.hpp"
#include "study_reports.hpp"

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

struct StudyOptions {
    std::string file, output;
    std::vector<std::string> reports;
    long jobs = 0;  // as many as there are cores
    bool json = false, again = false, open = false;
};

// Of all files that the results depend on; goals may change afterwards.
std::uint64_t sum_of_study(const StudyDescription& study) {
    io::Node file = io::read_toml(study.file);
    std::erase_if(std::get<io::TableValue>(file.value).entries,
                  [](const io::Node& entry) { return entry.key == "goal" || entry.key == "name"; });
    std::uint64_t sum = 31 * sum_of(file) + sum_of(io::read_toml(study.vehicle));
    for (const StudyRun& run : study.runs) {
        if (!run.scenario.empty()) sum = 31 * sum + sum_of(io::read_toml(run.scenario));
    }
    return sum;
}

// Every run of every point that has no result yet, on so many threads. False where it was interrupted.
bool evaluate_all(const StudyDescription& study, const std::vector<StudyPoint>& points, long jobs, StudyRecord& record,
                  StudyResults& results) {
    const std::size_t runs = study.runs.size(), count = points.size() * runs;
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> stop = false;
    std::size_t done = record.found();
    std::mutex mutex;  // of all below: the record, the results, the bar
    std::exception_ptr trouble;
    Progress progress("study");
    const auto work = [&] {
        for (std::size_t task = next++; task < count && !stop; task = next++) {
            const std::size_t i = task / runs, k = task % runs;
            if (results[i][k]) continue;
            const auto result = evaluate(study, points[i], study.runs[k], [&] { return !stop && !interrupted(); });
            if (!result) return;
            const std::lock_guard lock(mutex);
            try {
                record.add(i, k, *result);
            } catch (...) {
                trouble = std::current_exception(), stop = true;
                return;
            }
            results[i][k] = *result;
            progress.show(static_cast<double>(++done) / static_cast<double>(count));
        }
    };
    const long cores = std::max(1L, static_cast<long>(std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> threads;
        for (long i = 1; i < (jobs > 0 ? jobs : cores); ++i) threads.emplace_back(work);
        work();
    }
    progress.clear();
    if (trouble) std::rethrow_exception(trouble);
    return !interrupted();
}

nlohmann::ordered_json json_of(const StudyTable& table) {
    using Json = nlohmann::ordered_json;
    const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
    Json figures = Json::array(), points = Json::array();
    for (const StudyColumn& figure : table.figures) {
        figures.push_back({{"name", figure.name}, {"unit", figure.unit}, {"meaning", figure.meaning}});
    }
    for (std::size_t i = 0; i < table.points.size(); ++i) {
        Json parameters, values = Json::array(), passed, failed;
        for (std::size_t k = 0; k < table.parameters.size(); ++k) {
            const double value = table.points[i].numbers[k];
            parameters[table.parameters[k]] = std::isfinite(value) ? Json(value) : Json(table.points[i].values[k]);
        }
        for (const StudyColumn& figure : table.figures) values.push_back(number(figure.values[i]));
        for (std::size_t k = 0; k < table.runs.size(); ++k) {
            passed[table.runs[k]] = table.passed[i][k] ? Json(*table.passed[i][k]) : Json(nullptr);
            failed[table.runs[k]] = table.failed[i][k].empty() ? Json(nullptr) : Json(table.failed[i][k]);
        }
        points.push_back({{"parameters", parameters},
                          {"figures", values},
                          {"passed", passed},
                          {"failed", failed},
                          {"score", number(table.scores[i])}});
    }
    const auto best = table.best();
    return {{"study", table.name},
            {"vehicle_file", table.vehicle},
            {"figures", figures},
            {"points", points},
            {"best", best ? Json(*best + 1) : Json(nullptr)}};
}

// What each figure ranges over, and the best point.
void print_study(const StudyDescription& study, const StudyTable& table) {
    fmt::print("{}: {} points, {} runs each\n", table.name, table.points.size(), table.runs.size());
    std::size_t width = 0;
    for (const StudyColumn& figure : table.figures) width = std::max(width, figure.name.size());
    fmt::print("  {:<{}}  {:>12}{:>12}\n", "", width, "min", "max");
    for (const StudyColumn& figure : table.figures) {
        double min = INFINITY, max = -INFINITY;
        for (const double value : figure.values) {
            if (std::isfinite(value)) min = std::min(min, value), max = std::max(max, value);
        }
        if (min > max) continue;
        fmt::print("  {:<{}}  {:>12.5g}{:>12.5g} {}\n", figure.name, width, without_round_off(min),
                   without_round_off(max), figure.unit);
    }
    std::size_t failures = 0;
    for (const auto& runs : table.failed)
        failures += static_cast<std::size_t>(std::ranges::count_if(runs, [](const auto& f) { return !f.empty(); }));
    if (failures > 0)
        fmt::print("  {} failed: the table says why\n", failures == 1 ? "1 run" : fmt::format("{} runs", failures));
    if (const auto best = table.best()) {
        fmt::print("  best: point {}", *best + 1);
        for (std::size_t k = 0; k < table.parameters.size(); ++k) {
            fmt::print(", {} {}", table.parameters[k], table.points[*best].values[k]);
        }
        fmt::print(" (score {:.3g})\n", table.scores[*best]);
        for (const std::string& assignment : vehicle_set(study, table.points[*best])) {
            fmt::print("    --vehicle-set '{}'\n", assignment);
        }
    }
}

// Goals and figures are words that must be among those that there are.
void check_figures(const StudyDescription& study, const StudyTable& table) {
    for (const StudyGoal& goal : study.goals) {
        if (std::ranges::find(table.figures, goal.figure, &StudyColumn::name) != table.figures.end()) continue;
        fmt::print(stderr, "hamilcar: {}: no run gave the figure '{}' of a goal\n", study.file, goal.figure);
    }
}

io::ExitCode run_study(const StudyOptions& options) {
    const StudyDescription study = read_study(options.file);
    const std::vector<StudyPoint> points = points_of(study);
    check_point(study, points.front());
    const std::string folder =
        options.output.empty() ? "out/" + fs::path(options.file).stem().string() : options.output;
    const io::FolderLock lock = take_folder(folder);
    const InterruptWatch watch;
    const std::string record_file = folder + "/results.jsonl";
    if (options.again) fs::remove(record_file);
    StudyResults results(points.size(), std::vector<std::optional<RunResult>>(study.runs.size()));
    StudyRecord record(record_file, sum_of_study(study), results);
    const std::size_t done_before = record.found();
    if (done_before > 0) {
        fmt::print(stderr, "hamilcar: {} of {} runs were there already\n", done_before,
                   points.size() * study.runs.size());
    }
    const bool whole = evaluate_all(study, points, options.jobs, record, results);
    StudyTable table = study_table(study, points, results);
    if (!whole) {
        fmt::print(stderr, "hamilcar: interrupted; the same command goes on where it was\n");
        return io::ExitCode::interrupted;
    }
    check_figures(study, table);
    if (done_before == 0) remove_reports(table, folder);
    for (const std::size_t point : points_called(options.reports, table)) {
        write_reports(study, table, point, folder);
        if (interrupted()) break;
    }
    table.reports = reports_in(folder, table);
    const nlohmann::ordered_json facts = json_of(table);
    if (options.json) {
        fmt::print("{}\n", io::json_text(facts));
    } else {
        print_study(study, table);
    }
    write_file(folder + "/study.json", io::json_text(facts) + "\n");
    write_file(folder + "/study.csv", study_csv(table));
    write_study_netcdf(folder + "/study.nc", table);
    io::write_page(folder + "/study.html", study_page(study, table));
    for (const char* name : {"study.json", "study.csv", "study.nc", "study.html"}) {
        tell_written(options.json, folder + "/" + name);
    }
    if (options.open) open_in_browser(fs::absolute(folder + "/study.html").string());
    return table.figures.empty() ? io::ExitCode::numerical : io::ExitCode::ok;
}

}  // namespace

void add_study(CommandList& list) {
    auto [command, o] = list.add<StudyOptions>(
        "study", "vary parameters of a vehicle and its runs: a table, main effects, trade-offs, the best", run_study);
    command.add("study", o.file, "study file (TOML)").required();
    command.add("-o,--output", o.output, "folder for the results [out/NAME]; what is there is gone on with");
    command.add("--jobs", o.jobs, {0, 1024}, "runs at a time, as many as there are cores if 0");
    command.add("--again", o.again, "do all of it anew");
    command.add("--report", o.reports,
                "a point's number, 'best' or 'all', whose runs get reports, linked from the page; may be repeated");
    command.add("--open", o.open, "open the page in the browser");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
