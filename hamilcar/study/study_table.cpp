#include "hamilcar/study/study_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "hamilcar/io/csv.hpp"

namespace hamilcar {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

StudyColumn& column_of(StudyTable& table, const std::string& name, const Figure& figure) {
    const auto there = std::ranges::find(table.figures, name, &StudyColumn::name);
    if (there != table.figures.end()) return *there;
    table.figures.push_back({name, figure.unit, figure.meaning, std::vector<double>(table.points.size(), none)});
    return table.figures.back();
}

// 0 at the best of all points, 1 at the worst.
std::vector<double> distances(const StudyGoal& goal, const std::vector<double>& values) {
    std::vector<double> cost;
    for (const double value : values) {
        cost.push_back(goal.want == Want::min   ? value
                       : goal.want == Want::max ? -value
                                                : std::abs(value - goal.target));
    }
    double min = INFINITY, max = -INFINITY;
    for (const double one : cost) {
        if (std::isfinite(one)) min = std::min(min, one), max = std::max(max, one);
    }
    if (goal.want == Want::target) min = 0;
    for (double& one : cost) one = max > min ? (one - min) / (max - min) : 0 * one;
    return cost;
}

void add_scores(const StudyDescription& study, StudyTable& table) {
    table.scores.assign(table.points.size(), study.goals.empty() ? none : 0.0);
    double weights = 0;
    for (const StudyGoal& goal : study.goals) weights += goal.weight;
    for (const StudyGoal& goal : study.goals) {
        const auto column = std::ranges::find(table.figures, goal.figure, &StudyColumn::name);
        const std::vector<double> missing(table.points.size(), none);
        const std::vector<double> far = distances(goal, column == table.figures.end() ? missing : column->values);
        for (std::size_t i = 0; i < far.size(); ++i) table.scores[i] += goal.weight / weights * far[i];
    }
}

}  // namespace

std::optional<std::size_t> StudyTable::best() const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (std::isfinite(scores[i]) && (!best || scores[i] < scores[*best])) best = i;
    }
    return best;
}

StudyTable study_table(const StudyDescription& study, const std::vector<StudyPoint>& points,
                       const StudyResults& results) {
    StudyTable table{.name = study.name,
                     .vehicle = study.vehicle,
                     .parameters = {},
                     .points = points,
                     .figures = {},
                     .runs = {},
                     .passed = {},
                     .failed = {},
                     .scores = {}};
    for (const StudyParameter& parameter : study.parameters) table.parameters.push_back(parameter.name);
    for (const StudyRun& run : study.runs) table.runs.push_back(run.name);
    table.passed.assign(points.size(), std::vector<std::optional<bool>>(study.runs.size()));
    table.failed.assign(points.size(), std::vector<std::string>(study.runs.size()));
    for (std::size_t k = 0; k < study.runs.size(); ++k) {  // columns in the order of the runs
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!results[i][k]) continue;
            for (const Figure& figure : results[i][k]->figures) {
                column_of(table, study.runs[k].name + ": " + figure.name, figure).values[i] = figure.value;
            }
            table.passed[i][k] = results[i][k]->passed, table.failed[i][k] = results[i][k]->failed;
        }
    }
    add_scores(study, table);
    return table;
}

MainEffect main_effect(const StudyTable& table, std::size_t parameter, const StudyColumn& figure) {
    constexpr std::size_t max_values = 20, parts = 10;
    std::vector<double> x, y;
    for (std::size_t i = 0; i < table.points.size(); ++i) {
        const double at = table.points[i].numbers[parameter];
        if (std::isfinite(at) && std::isfinite(figure.values[i])) x.push_back(at), y.push_back(figure.values[i]);
    }
    if (x.empty()) return {};
    std::map<double, std::pair<double, double>> sums;  // by value: sum and count
    for (const double at : x) sums[at] = {0, 0};
    if (sums.size() > max_values) {
        const auto [min, max] = std::ranges::minmax(x);
        sums.clear();
        for (double& at : x) {
            const double part = std::min(std::floor((at - min) / (max - min) * parts), parts - 1.0);
            at = min + (part + 0.5) * (max - min) / parts;
        }
    }
    for (std::size_t i = 0; i < x.size(); ++i) sums[x[i]].first += y[i], sums[x[i]].second += 1;
    MainEffect effect;
    for (const auto& [at, sum] : sums) effect.values.push_back(at), effect.means.push_back(sum.first / sum.second);
    return effect;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
    double n = 0, mean_x = 0, mean_y = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {  // Welford's update: no difference of large sums
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
        n += 1;
        const double dx = x[i] - mean_x, dy = y[i] - mean_y;
        mean_x += dx / n, mean_y += dy / n;
        xx += dx * (x[i] - mean_x), yy += dy * (y[i] - mean_y), xy += dx * (y[i] - mean_y);
    }
    return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : none;
}

std::string study_csv(const StudyTable& table) {
    std::vector<std::string> headings{"point"};
    headings.insert(headings.end(), table.parameters.begin(), table.parameters.end());
    for (const StudyColumn& figure : table.figures) headings.push_back(figure.name + " [" + figure.unit + "]");
    for (const std::string& run : table.runs) headings.push_back(run + ": passed");
    for (const std::string& run : table.runs) headings.push_back(run + ": failed");
    headings.emplace_back("score");
    io::CsvText text(headings);
    for (std::size_t i = 0; i < table.points.size(); ++i) {
        text.cell(static_cast<double>(i + 1));
        for (const std::string& value : table.points[i].values) text.cell(value);
        for (const StudyColumn& figure : table.figures) text.cell(figure.values[i]);
        for (const auto& passed : table.passed[i]) text.cell(!passed ? "" : *passed ? "yes" : "no");
        for (const std::string& failed : table.failed[i]) text.cell(failed);
        text.cell(table.scores[i]);
        text.end_row();
    }
    return text.text();
}

}  // namespace hamilcar
