// What a study found, as a table: a row for every point, a column for every figure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hamilcar/io/page.hpp"
#include "hamilcar/study/study.hpp"

namespace hamilcar {

// By point and run; nothing where it has not been evaluated.
using StudyResults = std::vector<std::vector<std::optional<RunResult>>>;

struct StudyColumn {
    std::string name, unit, meaning;  // "turn: roll gradient"
    std::vector<double> values;       // of each point; NaN where it has none
};

struct StudyTable {
    std::string name, vehicle;
    std::vector<std::string> parameters;
    std::vector<StudyPoint> points;
    std::vector<StudyColumn> figures;
    std::vector<std::string> runs;
    std::vector<std::vector<std::optional<bool>>> passed;  // by point and run
    std::vector<std::vector<std::string>> failed;          // by point and run; empty: has not
    std::vector<std::vector<std::string>> reports = {};    // by point and run: a file from the page's folder, or empty
    std::vector<double> scores;  // weighted distance from the best of every goal, 0 to 1; NaN without goals or figures
    std::optional<std::size_t> best() const;
};

StudyTable study_table(const StudyDescription& study, const std::vector<StudyPoint>& points,
                       const StudyResults& results);

// How much a figure changes over a parameter, the others taken together: its means at the parameter's values, or in ten parts
// of its range where every point has its own value.
struct MainEffect {
    std::vector<double> values, means;
};
MainEffect main_effect(const StudyTable& table, std::size_t parameter, const StudyColumn& figure);

// Pearson's coefficient over the points that have both; NaN where one does not vary.
double correlation(const std::vector<double>& x, const std::vector<double>& y);

std::string study_csv(const StudyTable& table);
void write_study_netcdf(const std::string& path, const StudyTable& table);
io::Page study_page(const StudyDescription& study, const StudyTable& table);

}  // namespace hamilcar
