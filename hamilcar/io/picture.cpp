#include "hamilcar/io/picture.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "hamilcar/io/error.hpp"

namespace hamilcar::io {

namespace {

// A string for gnuplot: single quotes are doubled, nothing else is special.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c);
    return out + "'";
}

// Everything that one chart sets and plots; what the one before has set is taken back.
std::string commands(const Chart& chart) {
    const char* colors[] = {"#1b5e9b", "#d1495b", "#2e8b57", "#e9a03b", "#6c4a9e", "#4a4a4a", "#17a2b8", "#a0522d"};
    std::string s = "unset label\nunset arrow\nunset logscale\nset format y '%g'\nset termoption noenhanced\n";
    s += fmt::format("set title {} font ',{}'\n", quoted(chart.title), 16);
    s += fmt::format("set xlabel {}\nset ylabel {}\n", quoted(chart.x_label), quoted(chart.y_label));
    s += "set grid lc rgb '#dddddd' lw 0.7\nset border 3 lc rgb '#666666'\nset tics nomirror\nset key top left\nset "
         "samples 2\n";
    s += "set autoscale xfix\nset rmargin 4\nset offsets 0, 0, graph 0.08, graph 0.05\n";
    if (chart.log_y) s += "set logscale y\nset format y '10^{%L}'\nset termoption enhanced\n";
    if (chart.log_x) s += "set logscale x\n";
    s += chart.curves.size() == 1 ? "set key off\n" : "set key on " + chart.legend + "\n";
    for (const auto& [x, label] : chart.vertical_marks) {
        s += fmt::format("set arrow from first {0}, graph 0 to first {0}, graph 1 nohead dt 2 lc rgb '#888888'\n", x);
        s += fmt::format(
            "set label {} at first {}, graph 0.96 right offset -0.6,0 font 'Helvetica,12' tc rgb '#555555'\n",
            quoted(label), x);
    }
    s += "plot ";
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        const Curve& curve = chart.curves[i];
        s += fmt::format("{}'-' with {} lw 2 lc rgb '{}' {} title {}", i ? ", " : "",
                         curve.points ? "linespoints" : "lines", colors[i % std::size(colors)],
                         curve.points ? "pt 7 ps 0.6" : "", quoted(curve.label));
    }
    s += "\n";
    for (const Curve& curve : chart.curves) {
        for (std::size_t i = 0; i < curve.x.size(); ++i) {
            if (std::isfinite(curve.y[i])) s += fmt::format("{:.9g} {:.9g}\n", curve.x[i], curve.y[i]);
        }
        s += "e\n";
    }
    return s;
}

std::string preamble(const std::string& path, int width, int height, int font) {
    return fmt::format(
        "set terminal svg size {},{} font 'Helvetica,{}' background '#ffffff' noenhanced\nset output {}\n", width,
        height, font, quoted(path));
}

// Gives a script to gnuplot.
void draw(const std::string& path, const std::string& text) {
    if (!std::ofstream(path)) {
        throw Error(ExitCode::input_output, fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
    }
    const auto old_handler = std::signal(SIGPIPE, SIG_IGN);  // a missing gnuplot must not end the program
    std::FILE* pipe = popen("gnuplot", "w");
    int status = -1;
    if (pipe) {
        std::fwrite(text.data(), 1, text.size(), pipe);
        status = pclose(pipe);
    }
    std::signal(SIGPIPE, old_handler);
    if (status == 0) return;
    constexpr int command_not_found = 127;
    const bool missing = status != -1 && WIFEXITED(status) && WEXITSTATUS(status) == command_not_found;
    std::remove(path.c_str());
    throw Error(
        ExitCode::input_output,
        fmt::format("{}: cannot draw: {}", path,
                    missing ? "gnuplot is not installed (Debian: apt-get install gnuplot-nox)" : "gnuplot failed"));
}

}  // namespace

void write_chart(const std::string& path, const Chart& chart) {
    draw(path, preamble(path, 900, 460, 14) + commands(chart));
}

void write_page(const std::string& path, const std::string& title, const std::vector<Chart>& charts, int columns) {
    std::vector<Chart> drawn;  // gnuplot has no picture of nothing
    for (Chart chart : charts) {
        std::erase_if(chart.curves, [](const Curve& curve) {
            return std::ranges::none_of(curve.y, [](double y) { return std::isfinite(y); });
        });
        if (!chart.curves.empty()) drawn.push_back(chart);
    }
    if (drawn.empty()) return;
    const int rows = (static_cast<int>(drawn.size()) + columns - 1) / columns;
    std::string text = preamble(path, 430 * columns, 300 * rows + 40, 11);
    text += fmt::format("set multiplot layout {},{} title {} font ',18'\n", rows, columns, quoted(title));
    for (const Chart& chart : drawn) text += commands(chart);
    draw(path, text + "unset multiplot\n");
}

}  // namespace hamilcar::io
