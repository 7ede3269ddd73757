// A study's page: what is best, what each parameter does, what is traded for what, and every point.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/study/study_table.hpp"

namespace hamilcar {

namespace {

constexpr std::size_t max_rows = 2000;  // of the table of points; the CSV has all
constexpr std::size_t max_trade_offs = 6;

io::Cell cell(double value) {
    return std::isfinite(value) ? io::Cell(value) : io::Cell();
}

io::Cell cell(const std::string& word, const std::string& report) {
    if (!report.empty()) return io::FileCell{word.empty() ? "report" : word, report};
    return word.empty() ? io::Cell() : io::Cell(word);
}

std::string label_of(const StudyColumn& column) {
    return column.name + " [" + column.unit + "]";
}

std::vector<double> numbers_of(const StudyTable& table, std::size_t parameter) {
    std::vector<double> out;
    for (const StudyPoint& point : table.points) out.push_back(point.numbers[parameter]);
    return out;
}

// Marks without a line: a gap behind each.
io::Curve scattered(const std::string& label, const std::vector<double>& x, const std::vector<double>& y) {
    io::Curve curve{.label = label, .x = {}, .y = {}, .points = true};
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
        curve.x.insert(curve.x.end(), {x[i], x[i]}), curve.y.insert(curve.y.end(), {y[i], NAN});
    }
    return curve;
}

bool varies(const StudyColumn& column) {
    const auto finite = [](double value) { return std::isfinite(value); };
    const auto first = std::ranges::find_if(column.values, finite);
    return std::ranges::any_of(column.values, [&](double v) { return finite(v) && v != *first; });
}

// Those that goals name; without goals all that vary.
std::vector<const StudyColumn*> shown_figures(const StudyDescription& study, const StudyTable& table) {
    std::vector<const StudyColumn*> out;
    for (const StudyColumn& column : table.figures) {
        const bool wanted =
            std::ranges::any_of(study.goals, [&](const auto& goal) { return goal.figure == column.name; });
        if (varies(column) && (wanted || study.goals.empty())) out.push_back(&column);
    }
    return out;
}

void add_best(const StudyTable& table, io::Page& page) {
    const auto best = table.best();
    if (!best) return;
    io::Table found{
        fmt::format("Best by the weighted goals: point {}", *best + 1), {{"", ""}, {"value", ""}, {"unit", ""}}, {}};
    for (std::size_t k = 0; k < table.parameters.size(); ++k) {
        found.rows.push_back({table.parameters[k], table.points[*best].values[k], std::string()});
    }
    for (const StudyColumn& figure : table.figures) {
        found.rows.push_back({figure.name, cell(figure.values[*best]), figure.unit});
    }
    found.rows.push_back({std::string("score"), table.scores[*best], std::string("0 best, 1 worst")});
    page.blocks.push_back(std::move(found));
}

void add_effects(const StudyTable& table, const std::vector<const StudyColumn*>& figures, io::Page& page) {
    page.blocks.push_back(io::Heading{"Main effects"});
    for (const StudyColumn* figure : figures) {
        for (std::size_t k = 0; k < table.parameters.size(); ++k) {
            const MainEffect effect = main_effect(table, k, *figure);
            if (effect.values.size() < 2) continue;
            page.blocks.push_back(io::Chart{.title = figure->name + " over " + table.parameters[k],
                                            .x_label = table.parameters[k],
                                            .y_label = label_of(*figure),
                                            .curves = {scattered("points", numbers_of(table, k), figure->values),
                                                       {"mean", effect.values, effect.means, true}}});
        }
    }
}

void add_correlations(const StudyTable& table, const std::vector<const StudyColumn*>& figures, io::Page& page) {
    io::Table shown{"Correlation of figures with parameters and with each other", {{"", ""}}, {}};
    for (const std::string& parameter : table.parameters) shown.columns.emplace_back(parameter, "");
    for (const StudyColumn* figure : figures) shown.columns.emplace_back(figure->name, "");
    for (const StudyColumn* figure : figures) {
        std::vector<io::Cell> row{figure->name};
        for (std::size_t k = 0; k < table.parameters.size(); ++k) {
            row.push_back(cell(correlation(numbers_of(table, k), figure->values)));
        }
        for (const StudyColumn* other : figures) row.push_back(cell(correlation(other->values, figure->values)));
        shown.rows.push_back(std::move(row));
    }
    page.blocks.push_back(std::move(shown));
}

void add_trade_offs(const StudyTable& table, const std::vector<const StudyColumn*>& figures, io::Page& page) {
    if (figures.size() < 2) return;
    page.blocks.push_back(io::Heading{"Trade-offs"});
    std::size_t shown = 0;
    const auto best = table.best();
    for (std::size_t i = 0; i < figures.size(); ++i) {
        for (std::size_t k = i + 1; k < figures.size() && shown < max_trade_offs; ++k, ++shown) {
            io::Chart chart{.title = figures[k]->name + " against " + figures[i]->name,
                            .x_label = label_of(*figures[i]),
                            .y_label = label_of(*figures[k]),
                            .curves = {scattered("points", figures[i]->values, figures[k]->values)}};
            if (best) {
                chart.curves.push_back(scattered("best", {figures[i]->values[*best]}, {figures[k]->values[*best]}));
            }
            page.blocks.push_back(std::move(chart));
        }
    }
}

void add_points(const StudyTable& table, io::Page& page) {
    page.blocks.push_back(io::Heading{"All points"});
    io::Table all{"Points", {{"point", ""}}, {}};
    for (const std::string& parameter : table.parameters) all.columns.emplace_back(parameter, "");
    for (const StudyColumn& figure : table.figures) all.columns.emplace_back(figure.name, figure.unit);
    for (const std::string& run : table.runs) all.columns.emplace_back(run, "");
    all.columns.emplace_back("score", "");
    for (std::size_t i = 0; i < std::min(table.points.size(), max_rows); ++i) {
        std::vector<io::Cell> row{double(i + 1)};
        for (std::size_t k = 0; k < table.parameters.size(); ++k) {
            const double number = table.points[i].numbers[k];
            row.push_back(std::isfinite(number) ? io::Cell(number) : io::Cell(table.points[i].values[k]));
        }
        for (const StudyColumn& figure : table.figures) row.push_back(cell(figure.values[i]));
        for (std::size_t k = 0; k < table.runs.size(); ++k) {
            const auto& passed = table.passed[i][k];
            const std::string& failed = table.failed[i][k];
            const std::string word = !failed.empty() ? "failed: " + failed
                                     : !passed       ? ""
                                     : *passed       ? "passed"
                                                     : "not passed";
            row.push_back(cell(word, table.reports.empty() ? "" : table.reports[i][k]));
        }
        row.push_back(cell(table.scores[i]));
        all.rows.push_back(std::move(row));
    }
    page.blocks.push_back(std::move(all));
    if (table.points.size() > max_rows) {
        page.blocks.push_back(
            io::Paragraph{fmt::format("The first {} of {} points; study.csv has all.", max_rows, table.points.size())});
    }
}

}  // namespace

io::Page study_page(const StudyDescription& study, const StudyTable& table) {
    io::Page page{.title = study.name,
                  .subtitle = fmt::format("{} points, {}", table.points.size(), study.vehicle),
                  .blocks = {},
                  .runs = {}};
    const std::vector<const StudyColumn*> figures = shown_figures(study, table);
    add_best(table, page);
    add_effects(table, figures, page);
    add_trade_offs(table, figures, page);
    add_correlations(table, figures, page);
    add_points(table, page);
    return page;
}

}  // namespace hamilcar
