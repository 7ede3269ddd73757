#include "hamilcar/io/merged_chart.hpp"

#include <algorithm>

namespace hamilcar::io {

namespace {

// Under the run's label.
std::string labeled(const std::string& label, const std::string& own) {
    return own.empty() ? label : label + ", " + own;
}
std::pair<double, std::string> labeled(const std::string& label, const std::pair<double, std::string>& mark) {
    return {mark.first, labeled(label, mark.second)};
}
Marks labeled(const std::string& label, const Marks& marks) {
    return {labeled(label, marks.label), marks.x, marks.y};
}
Line labeled(const std::string&, const Line& line) {
    return line;
}

// What diagrams show beside their curves: once what all show, the rest under the run's label.
template <class T>
std::vector<T> united(const LabeledCharts& charts, std::vector<T> Chart::*what) {
    std::vector<T> out;
    for (const auto& [chart, label] : charts) {
        for (const T& one : chart->*what) {
            const bool common = std::ranges::all_of(
                charts, [&](const auto& other) { return std::ranges::count(other.first->*what, one) > 0; });
            if (!common) {
                out.push_back(labeled(label, one));
            } else if (chart == charts.front().first) {
                out.push_back(one);
            }
        }
    }
    return out;
}

}  // namespace

Chart merged(const LabeledCharts& charts) {
    Chart out = *charts.front().first;
    out.curves.clear();
    for (const auto& [chart, label] : charts) {
        for (Curve curve : chart->curves) {
            curve.label = labeled(label, chart->curves.size() == 1 ? "" : curve.label);
            out.curves.push_back(std::move(curve));
        }
    }
    out.vertical_marks = united(charts, &Chart::vertical_marks);
    out.horizontal_marks = united(charts, &Chart::horizontal_marks);
    out.marks = united(charts, &Chart::marks);
    out.lines = united(charts, &Chart::lines);
    return out;
}

}  // namespace hamilcar::io
