// Line charts as SVG files, drawn by gnuplot.
#pragma once

#include <string>
#include <vector>

namespace hamilcar::io {

struct Curve {
    std::string label;
    std::vector<double> x, y;
    bool points = false;  // marks as well as a line
};

struct Chart {
    std::string title, x_label, y_label;
    std::vector<Curve> curves;
    bool log_y = false;
    std::vector<std::pair<double, std::string>> vertical_marks;  // x and its label
    bool log_x = false;
    std::string legend = "top left";  // where the curves leave room for it
};

// Throws Error(input_output) if gnuplot is missing or the file cannot be written.
void write_chart(const std::string& path, const Chart& chart);

// Several charts on one page, row by row; those without a finite value are left out, and so is a page without charts.
void write_page(const std::string& path, const std::string& title, const std::vector<Chart>& charts, int columns);

}  // namespace hamilcar::io
