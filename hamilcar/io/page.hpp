// Pages for people: one self-contained HTML file with charts, tables and the replay of runs. The page itself, what draws them, is
// built from web/ and part of the program; what is written here is the document that it shows (schemas/page.schema.json).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hamilcar/io/results.hpp"
#include "hamilcar/road/tile.hpp"

namespace hamilcar::io {

struct Curve {
    std::string label;
    std::vector<double> x, y;  // NaN: a gap
    bool points = false;       // marks as well as a line
};

// Cones on the ground, in the units of the axes.
struct Marks {
    std::string label;  // "" where the legend is not to name them
    std::vector<double> x, y;
    bool operator==(const Marks&) const = default;
};

// A barrier that is not to be crossed, straight.
struct Line {
    double x0, y0, x1, y1;
    bool operator==(const Line&) const = default;
};

struct Chart {
    std::string title, x_label, y_label;  // labels with their unit: "time [s]"
    std::vector<Curve> curves;
    bool log_y = false;
    std::vector<std::pair<double, std::string>> vertical_marks;  // x and its label
    bool log_x = false;
    std::vector<std::pair<double, std::string>> horizontal_marks;  // limits: y and their label
    bool equal_axes = false;  // both to one scale, as on a map; neither logarithmic
    std::vector<Marks> marks;
    std::vector<Line> lines;
};

struct FileCell {  // a text that opens a file
    std::string text;
    std::string file;  // by its path from the page's folder
    bool operator==(const FileCell&) const = default;
};

using Cell = std::variant<std::monostate, double, std::string, FileCell>;  // monostate: does not exist

struct Table {
    std::string title;
    std::vector<std::pair<std::string, std::string>> columns;  // name and unit, "" for none
    std::vector<std::vector<Cell>> rows;
};

struct Heading {
    std::string text;
};
struct Paragraph {
    std::string text;
};
struct Replay {};  // the replay of the page's runs with their plots

struct Verdict {
    std::string criterion;  // "no cone is hit"
    bool passed;
    std::string found;  // "2 cones"; "" where there is nothing to tell
};
struct Verdicts {
    std::vector<Verdict> list;  // all are to be passed
};

using PageBlock = std::variant<Heading, Paragraph, Chart, Table, Replay, Verdicts>;

// A run as rows of a result file, column by column; the first is "time".
struct PageRun {
    std::string name;
    std::string file;  // that it was read from, or empty
    std::vector<Column> columns;
    std::vector<std::vector<double>> values;
    std::string scene;  // JSON (run/scene.hpp); empty: nothing to draw but plots
    std::vector<RoadTile> tiles;
};

struct Page {
    std::string title, subtitle;
    std::vector<PageBlock> blocks;
    std::vector<PageRun> runs;
};

// The page without a document: `hamilcar drive` serves it so.
std::string_view page_template();

// The same bytes for the same page.
std::string page_text(const Page& page);
// Throws Error(input_output) where the file cannot be written.
void write_page(const std::string& path, const Page& page);

}  // namespace hamilcar::io
