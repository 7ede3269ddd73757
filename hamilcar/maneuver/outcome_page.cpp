// Pages of outcomes: one maneuver, or several beside each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "hamilcar/maneuver/outcome_file.hpp"

namespace hamilcar {

namespace {

using Named = std::pair<ManeuverRun, Outcome>;

io::Cell cell(double value) {
    return std::isfinite(value) ? io::Cell(value) : io::Cell();
}

io::Table figures_table(const Outcome& outcome) {
    io::Table table{"Characteristic values", {{"", ""}, {"value", ""}, {"unit", ""}, {"meaning", ""}}, {}};
    for (const Figure& f : outcome.figures) table.rows.push_back({f.name, cell(f.value), f.unit, f.meaning});
    return table;
}

io::Table inputs_table(const ManeuverRun& run) {
    io::Table table{"What was driven", {{"", ""}, {"value", ""}, {"unit", ""}, {"meaning", ""}}, {}};
    table.rows.push_back({std::string("vehicle"), run.vehicle, std::string(), run.vehicle_file});
    for (const auto& [setting, value] : run.settings) {
        table.rows.push_back({setting.name, value, setting.unit, setting.meaning});
    }
    table.rows.push_back({std::string("integration step"), run.step, std::string("s"), "by " + run.integrator});
    table.rows.push_back({std::string("program"), run.program, std::string(), std::string()});
    return table;
}

io::Table energy_table(const EnergyBook& book) {
    io::Table table{"Energy", {{"", ""}, {"value", ""}, {"unit", ""}}, {}};
    const auto add = [&](const char* name, double joule) {
        table.rows.push_back({std::string(name), 1e-3 * joule, std::string("kJ")});
    };
    add("supplied by engine or wheel torque", book.supplied);
    add("gained by the vehicle", book.stored);
    add("dissipated, less what the steering put in", book.dissipated);
    add("left over: the books do not close by", book.gap());
    return table;
}

// A label that tells runs apart: their vehicles, or their settings where these are what differs.
std::vector<std::string> labels_of(const std::vector<Named>& runs) {
    std::vector<std::string> labels;
    const bool one_kind =
        std::ranges::all_of(runs, [&](const Named& r) { return r.first.title == runs[0].first.title; });
    const bool one_vehicle =
        std::ranges::all_of(runs, [&](const Named& r) { return r.first.vehicle == runs[0].first.vehicle; });
    for (const auto& [run, outcome] : runs) {
        labels.push_back(one_kind ? run.vehicle : one_vehicle ? run.title : run.title + ", " + run.vehicle);
    }
    const auto doubled = [&](const std::string& label) { return std::ranges::count(labels, label) > 1; };
    std::vector<std::string> out = labels;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (!doubled(labels[i])) continue;
        for (const auto& [setting, value] : runs[i].first.settings) {
            const bool same = std::ranges::all_of(runs, [&, &own = setting, number = value](const Named& other) {
                return std::ranges::any_of(other.first.settings, [&](const auto& theirs) {
                    return theirs.first.name == own.name && theirs.second == number;
                });
            });
            if (!same) out[i] += fmt::format(", {} {:g} {}", setting.name, value, setting.unit);
        }
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (std::ranges::count(out, out[i]) > 1) out[i] += fmt::format(" ({})", i + 1);
    }
    return out;
}

// Figures of all runs by name, in the order in which they first come.
io::Table side_by_side(const std::vector<Named>& runs, const std::vector<std::string>& labels) {
    io::Table table{"Characteristic values", {{"", ""}, {"unit", ""}}, {}};
    std::vector<const Figure*> known;
    for (const auto& [run, outcome] : runs) {
        for (const Figure& f : outcome.figures) {
            if (std::ranges::none_of(known, [&](const Figure* k) { return k->name == f.name; })) known.push_back(&f);
        }
    }
    for (const std::string& label : labels) table.columns.emplace_back(label, "");
    for (const Figure* figure : known) {
        std::vector<io::Cell> row{figure->name, figure->unit};
        for (const auto& [run, outcome] : runs) {
            const auto own = std::ranges::find(outcome.figures, figure->name, &Figure::name);
            row.push_back(own == outcome.figures.end() ? io::Cell() : cell(own->value));
        }
        table.rows.push_back(row);
    }
    return table;
}

// One diagram of each run that has it, with the run's label.
using Laid = std::vector<std::pair<const io::Chart*, std::string>>;

// What diagrams show beside their curves, under the run's label where they differ; once where all show the same.
template <class T, class Same, class Labeled>
std::vector<T> united(const Laid& charts, std::vector<T> io::Chart::*what, Same&& same, Labeled&& labeled) {
    const std::vector<T>& first = charts.front().first->*what;
    const auto as_first = [&](const auto& one) { return std::ranges::equal(one.first->*what, first, same); };
    if (std::ranges::all_of(charts, as_first)) return first;
    std::vector<T> out;
    for (const auto& [chart, label] : charts) {
        for (const T& one : chart->*what) {
            const bool common = std::ranges::all_of(charts, [&](const auto& other) {
                return std::ranges::any_of(other.first->*what, [&](const T& theirs) { return same(theirs, one); });
            });
            if (!common) {
                out.push_back(labeled(one, label));
            } else if (chart == charts.front().first) {
                out.push_back(one);
            }
        }
    }
    return out;
}

io::Chart laid_over(const Laid& charts) {
    io::Chart out = *charts.front().first;
    out.curves.clear();
    for (const auto& [chart, label] : charts) {
        for (io::Curve curve : chart->curves) {
            curve.label = curve.label.empty() || chart->curves.size() == 1 ? label : label + ", " + curve.label;
            out.curves.push_back(std::move(curve));
        }
    }
    const auto joined = [](const std::string& label, const std::string& own) {
        return own.empty() ? label : label + ", " + own;
    };
    using Mark = std::pair<double, std::string>;
    const auto mark_of = [&](const Mark& mark, const std::string& label) {
        return Mark(mark.first, joined(label, mark.second));
    };
    out.vertical_marks = united(charts, &io::Chart::vertical_marks, std::equal_to<Mark>(), mark_of);
    out.horizontal_marks = united(charts, &io::Chart::horizontal_marks, std::equal_to<Mark>(), mark_of);
    out.marks = united(
        charts, &io::Chart::marks, [](const io::Marks& a, const io::Marks& b) { return a.x == b.x && a.y == b.y; },
        [&](const io::Marks& marks, const std::string& label) {
            return io::Marks{joined(label, marks.label), marks.x, marks.y};
        });
    out.lines = united(
        charts, &io::Chart::lines,
        [](const io::Line& a, const io::Line& b) {
            return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1;
        },
        [](const io::Line& line, const std::string&) { return line; });
    return out;
}

// Diagrams of one title in one, in the order in which they first come.
std::vector<io::Chart> overlaid(const std::vector<Named>& runs, const std::vector<std::string>& labels) {
    std::vector<Laid> by_title;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        for (const io::Chart& chart : runs[i].second.charts) {
            auto same = std::ranges::find_if(
                by_title, [&](const Laid& laid) { return laid.front().first->title == chart.title; });
            if (same == by_title.end()) same = by_title.emplace(by_title.end());
            same->emplace_back(&chart, labels[i]);
        }
    }
    std::vector<io::Chart> out;
    for (const Laid& laid : by_title) out.push_back(laid_over(laid));
    return out;
}

void add_failure(const Outcome& outcome, const std::string& who, io::Page& page) {
    if (!outcome.failed) return;
    page.blocks.push_back(io::Paragraph{who + " could not be driven to its end: " + *outcome.failed});
}

// A table, and why cells of it are empty, if any.
void add_figures(io::Table table, const std::string& reason, io::Page& page) {
    const bool empty = std::ranges::any_of(table.rows, [](const std::vector<io::Cell>& row) {
        return std::ranges::any_of(row, [](const io::Cell& one) { return one.index() == 0; });
    });
    page.blocks.push_back(std::move(table));
    if (empty) page.blocks.push_back(io::Paragraph{reason});
}

// What belongs to one of several runs alone.
void add_run(const ManeuverRun& run, const Outcome& outcome, const std::string& label, io::Page& page) {
    page.blocks.push_back(io::Heading{label});
    if (!outcome.verdicts.empty()) page.blocks.push_back(io::Verdicts{outcome.verdicts});
    for (const std::string& note : outcome.notes)
        page.blocks.push_back(io::Paragraph{fmt::format("{}: {}", label, note)});
    page.blocks.push_back(inputs_table(run));
}

}  // namespace

io::Page outcome_page(const ManeuverRun& run, const Outcome& outcome) {
    io::Page page{
        .title = run.title, .subtitle = run.standard + " · " + run.vehicle, .blocks = {}, .runs = outcome.runs};
    add_failure(outcome, "It", page);
    if (!outcome.verdicts.empty()) page.blocks.push_back(io::Verdicts{outcome.verdicts});
    if (!outcome.figures.empty()) add_figures(figures_table(outcome), "No value: this drive did not show it.", page);
    for (const io::Chart& chart : outcome.charts) page.blocks.push_back(chart);
    for (const std::string& note : outcome.notes) page.blocks.push_back(io::Paragraph{note});
    if (!page.runs.empty()) {
        page.blocks.push_back(io::Heading{"The drive"});
        page.blocks.push_back(io::Replay{});
    }
    page.blocks.push_back(io::Heading{"Inputs"});
    page.blocks.push_back(inputs_table(run));
    page.blocks.push_back(energy_table(outcome.energy));
    return page;
}

io::Page comparison_page(std::vector<Named> runs) {
    const std::vector<std::string> labels = labels_of(runs);
    io::Page page;
    std::vector<io::Chart> charts = overlaid(runs, labels);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        auto& [run, outcome] = runs[i];
        if (page.title.find(run.title) == std::string::npos) page.title += (i == 0 ? "" : ", ") + run.title;
        page.subtitle += (i == 0 ? "" : " · ") + labels[i];
        add_failure(outcome, labels[i], page);
        for (io::PageRun& film : outcome.runs) {
            film.name = labels[i] + (outcome.runs.size() > 1 ? ", " + film.name : "");
            page.runs.push_back(std::move(film));
        }
    }
    add_figures(side_by_side(runs, labels), "No value: that drive did not show it, or its maneuver does not have it.",
                page);
    for (io::Chart& chart : charts) page.blocks.push_back(std::move(chart));
    if (!page.runs.empty()) {
        page.blocks.push_back(io::Heading{"The drives"});
        page.blocks.push_back(io::Replay{});
    }
    for (std::size_t i = 0; i < runs.size(); ++i) add_run(runs[i].first, runs[i].second, labels[i], page);
    return page;
}

}  // namespace hamilcar
