#include "hamilcar/maneuver/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "hamilcar/io/csv.hpp"

namespace hamilcar {

namespace {

// A label that tells runs apart: their vehicles, or their settings where these are what differs.
std::vector<std::string> labels_of(const std::vector<NamedOutcome>& runs) {
    const auto all_alike = [&](std::string ManeuverRun::*what) {
        return std::ranges::all_of(runs, [&](const NamedOutcome& r) { return r.first.*what == runs[0].first.*what; });
    };
    const bool one_kind = all_alike(&ManeuverRun::title), one_vehicle = all_alike(&ManeuverRun::vehicle);
    std::vector<std::string> labels;
    for (const auto& [run, outcome] : runs) {
        labels.push_back(one_kind ? run.vehicle : one_vehicle ? run.title : run.title + ", " + run.vehicle);
    }
    const auto have_it = [&](const Setting& setting, double value) {
        return std::ranges::all_of(runs, [&](const NamedOutcome& run) {
            return std::ranges::any_of(run.first.settings, [&](const auto& theirs) {
                return theirs.first.name == setting.name && theirs.second == value;
            });
        });
    };
    std::vector<std::string> out = labels;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (std::ranges::count(labels, labels[i]) == 1) continue;
        for (const auto& [setting, value] : runs[i].first.settings) {
            if (!have_it(setting, value))
                out[i] += fmt::format(", {} {} {}", setting.name, setting_text(setting, value), setting.unit);
        }
        for (const std::string& assignment : runs[i].first.vehicle_set) {
            const auto has_it = [&](const NamedOutcome& run) {
                return std::ranges::count(run.first.vehicle_set, assignment) > 0;
            };
            if (!std::ranges::all_of(runs, has_it)) out[i] += ", " + assignment;
        }
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (std::ranges::count(out, out[i]) > 1) out[i] += fmt::format(" ({})", i + 1);
    }
    return out;
}

io::Cell cell(double value) {
    return std::isfinite(value) ? io::Cell(value) : io::Cell();
}

nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string word(const std::optional<bool>& passed) {
    return !passed ? "" : *passed ? "passed" : "not passed";
}

}  // namespace

Comparison compare(const std::vector<NamedOutcome>& runs) {
    Comparison out{.labels = labels_of(runs), .figures = {}, .verdicts = {}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        for (const Figure& f : runs[i].second.figures) {
            auto row = std::ranges::find(out.figures, f.name, &Comparison::Row::name);
            if (row == out.figures.end()) {
                const std::vector<double> none(runs.size(), std::numeric_limits<double>::quiet_NaN());
                row = out.figures.insert(row, {f.name, f.unit, f.meaning, none});
            }
            row->values[i] = f.value;
        }
        for (const Verdict& v : runs[i].second.verdicts) {
            auto row = std::ranges::find(out.verdicts, v.criterion, &Comparison::Judged::criterion);
            if (row == out.verdicts.end()) {
                row = out.verdicts.insert(row, {v.criterion, std::vector<std::optional<bool>>(runs.size())});
            }
            row->passed[i] = v.passed;
        }
    }
    return out;
}

std::string comparison_csv(const Comparison& comparison) {
    std::vector<std::string> headings{"kind", "name", "unit"};
    headings.insert(headings.end(), comparison.labels.begin(), comparison.labels.end());
    io::CsvText text(headings);
    for (const Comparison::Row& row : comparison.figures) {
        text.cell("figure").cell(row.name).cell(row.unit);
        for (const double value : row.values) text.cell(value);
        text.end_row();
    }
    for (const Comparison::Judged& row : comparison.verdicts) {
        text.cell("verdict").cell(row.criterion).cell("");
        for (const auto& passed : row.passed) text.cell(word(passed));
        text.end_row();
    }
    return text.text();
}

nlohmann::ordered_json comparison_json(const Comparison& comparison, const std::vector<NamedOutcome>& runs) {
    using Json = nlohmann::ordered_json;
    Json whole = {{"runs", Json::array()}, {"figures", Json::array()}, {"verdicts", Json::array()}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto& [run, outcome] = runs[i];
        whole["runs"].push_back(
            {{"label", comparison.labels[i]},
             {"maneuver", run.maneuver},
             {"vehicle", {{"name", run.vehicle}, {"file", run.vehicle_file}, {"set", run.vehicle_set}}},
             {"passed", outcome.passed() && !run.interrupted},
             {"interrupted", run.interrupted}});
    }
    for (const Comparison::Row& row : comparison.figures) {
        Json values = Json::array(), differences = Json::array();
        for (std::size_t i = 0; i < row.values.size(); ++i) {
            values.push_back(number(row.values[i]));
            differences.push_back(number(row.difference(i)));
        }
        whole["figures"].push_back({{"name", row.name},
                                    {"unit", row.unit},
                                    {"meaning", row.meaning},
                                    {"values", values},
                                    {"differences_from_first", differences}});
    }
    for (const Comparison::Judged& row : comparison.verdicts) {
        Json passed = Json::array();
        for (const auto& one : row.passed) passed.push_back(one ? Json(*one) : Json(nullptr));
        whole["verdicts"].push_back({{"criterion", row.criterion}, {"passed", passed}});
    }
    return whole;
}

io::Table values_table(const Comparison& comparison) {
    io::Table table{"Characteristic values", {{"", ""}, {"unit", ""}}, {}};
    for (const std::string& label : comparison.labels) table.columns.emplace_back(label, "");
    for (const Comparison::Row& figure : comparison.figures) {
        std::vector<io::Cell> row{figure.name, figure.unit};
        for (const double value : figure.values) row.push_back(cell(value));
        table.rows.push_back(std::move(row));
    }
    for (const Comparison::Judged& verdict : comparison.verdicts) {
        std::vector<io::Cell> row{verdict.criterion, std::string()};
        for (const auto& passed : verdict.passed) row.push_back(passed ? io::Cell(word(passed)) : io::Cell());
        table.rows.push_back(std::move(row));
    }
    return table;
}

io::Table differences_table(const Comparison& comparison) {
    io::Table table{"Differences from " + comparison.labels[0], {{"", ""}, {"unit", ""}}, {}};
    for (std::size_t i = 1; i < comparison.labels.size(); ++i) {
        table.columns.emplace_back(comparison.labels[i], "");
        table.columns.emplace_back("in percent", "%");
    }
    for (const Comparison::Row& figure : comparison.figures) {
        std::vector<io::Cell> row{figure.name, figure.unit};
        for (std::size_t i = 1; i < figure.values.size(); ++i) {
            row.push_back(cell(figure.difference(i)));
            row.push_back(cell(100 * figure.difference(i) / std::abs(figure.values[0])));
        }
        const bool any =
            std::ranges::any_of(std::span(row).subspan(2), [](const io::Cell& one) { return one.index() != 0; });
        if (any) table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace hamilcar
