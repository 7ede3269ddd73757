#include "hamilcar/study/study_file.hpp"

#include <algorithm>
#include <array>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/choices.hpp"
#include "hamilcar/io/every_mistake.hpp"
#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/schema.hpp"
#include "hamilcar/study/sampling.hpp"

namespace hamilcar {

namespace {

using io::TableReader;

constexpr io::Range some{"whole number from 1 to 1e6", 1, 1e6, true, true};
constexpr std::size_t max_points = 1'000'000;

void read_values(const TableReader& table, StudyParameter& parameter) {
    table.choose({{"values"}, {"words"}, {"min", "max", "count"}}, [&](std::size_t group) {
        if (group == 0) {
            for (const double value : table.numbers("values", io::any_number)) {
                parameter.values.push_back(number_text(value));
            }
            table.expect(!parameter.values.empty(), "values", "one number at least");
        } else if (group == 1) {
            parameter.values = table.texts("words");
            table.expect(!parameter.values.empty(), "words", "one word at least");
        } else {
            parameter.min = table.number("min", io::any_number), parameter.max = table.number("max", io::any_number);
            table.expect(parameter.min < parameter.max, "max", "a number above min");
            parameter.count = static_cast<std::size_t>(table.number("count", some, 2));
        }
    });
}

StudyParameter read_parameter(const TableReader& table, std::vector<std::string>& names) {
    StudyParameter parameter;
    io::check_name(table, names, "parameter");
    parameter.name = table.text("name");
    table.choose({{"key"}, {"keys"}}, [&](std::size_t group) {
        parameter.keys = group == 0 ? std::vector{table.text("key")} : table.texts("keys");
    });
    table.expect(!parameter.keys.empty(), "keys", "one key at least");
    read_values(table, parameter);
    return parameter;
}

StudyRun read_run(const TableReader& table, std::vector<std::string>& names) {
    StudyRun run;
    io::check_name(table, names, "run");
    run.name = table.text("name");
    table.expect(run.name != "vehicle", "name", "another name: keys that begin with it are the vehicle's");
    table.choose({{"maneuver"}, {"scenario"}, {"analysis"}}, [&](std::size_t group) {
        constexpr std::array<std::string_view, 2> analyses{"vehicle", "kinematics"};
        if (group == 0) run.maneuver = table.text("maneuver");
        if (group == 1) run.scenario = table.path_to_file("scenario");
        if (group == 2) run.analysis = analyses[table.one_of("analysis", analyses)];
    });
    run.set = table.texts("set");
    run.figures = table.texts("figures");
    return run;
}

StudyGoal read_goal(const TableReader& table) {
    StudyGoal goal{.figure = table.text("figure"), .weight = table.number("weight", io::positive, 1)};
    table.choose({{"want"}, {"target"}}, [&](std::size_t group) {
        if (group == 0) {
            goal.want = io::word<Want>(table, "want", {{"min", Want::min}, {"max", Want::max}});
        } else {
            goal.want = Want::target, goal.target = table.number("target", io::any_number);
        }
    });
    return goal;
}

// Each parameter's key says whose it is.
void check_keys(const TableReader& file, const StudyDescription& study) {
    std::vector<TableReader> tables = file.tables("parameter");
    for (std::size_t i = 0; i < study.parameters.size(); ++i) {
        for (const std::string& key : study.parameters[i].keys) {
            const std::string owner = key.substr(0, key.find('.'));
            const bool is_run = std::ranges::any_of(
                study.runs, [&](const StudyRun& run) { return run.name == owner && run.analysis.empty(); });
            tables[i].expect(key.size() > owner.size() + 1 && (owner == "vehicle" || is_run), "key",
                             "'vehicle.' or the name of a run with a dot, then a key of the vehicle or of the run's "
                             "scenario (here '" +
                                 key + "')");
        }
    }
}

std::size_t point_count(const StudyDescription& study) {
    if (study.sampling != Sampling::full_factorial) return study.points;
    std::size_t count = 1;
    for (const StudyParameter& p : study.parameters) {
        count *= p.values.empty() ? p.count : p.values.size();
        if (count > max_points) break;
    }
    return count;
}

}  // namespace

StudyDescription read_study(const std::string& path) {
    io::Node document;
    StudyDescription study;
    io::expect_kind(path, io::FileKind::study, [&] {
        document = io::read_toml(path);
        io::with_every_mistake(
            document, [](const TableReader& file) { read_study(file); },
            [&] { study = read_study(TableReader(document, "")); });
    });
    study.file = path;
    study.places = io::places_of(document);
    return study;
}

StudyDescription read_study(const TableReader& file) {
    constexpr std::array<std::string_view, 3> samplings{"full_factorial", "latin_hypercube", "sobol"};
    StudyDescription study;
    study.name = file.text("name");
    study.vehicle = file.path_to_file("vehicle");
    file.choose("sampling", samplings, 0, [&](std::size_t word) {
        study.sampling = static_cast<Sampling>(word);
        if (word > 0) {
            const double points = file.number("points", some);
            study.points = file.is_recording() ? 0 : static_cast<std::size_t>(points);
        }
        if (word == 1) {
            constexpr io::Range seed{"whole number from 0 to 1e15", 0, 1e15, true, true};
            study.seed = static_cast<std::uint64_t>(file.number("seed", seed, 1));
        }
    });
    std::vector<std::string> names, run_names;
    for (const TableReader& table : file.tables("run")) study.runs.push_back(read_run(table, run_names));
    for (const TableReader& table : file.tables("parameter")) study.parameters.push_back(read_parameter(table, names));
    if (file.has("goal")) {
        for (const TableReader& table : file.tables("goal")) study.goals.push_back(read_goal(table));
    }
    if (!file.is_recording()) {
        check_keys(file, study);
        file.expect(study.sampling != Sampling::sobol || study.parameters.size() <= max_sobol_dimensions, "parameter",
                    std::to_string(max_sobol_dimensions) + " parameters at most with sobol");
        file.expect(point_count(study) <= max_points, "parameter", "a million points at most");
    }
    file.finish();
    return study;
}

std::string study_schema() {
    return io::schema_of("Hamilcar study", [](const TableReader& file) { read_study(file); });
}

}  // namespace hamilcar
