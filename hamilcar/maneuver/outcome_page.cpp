// Pages of outcomes: one maneuver, or several beside each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    table.rows.push_back({std::string("step"), run.step, std::string("s"), run.integrator});
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
    for (const auto& [run, outcome] : runs) labels.push_back(run.vehicle);
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

void lay_over(const io::Chart& chart, const std::string& label, std::vector<io::Chart>& charts) {
    auto same = std::ranges::find(charts, chart.title, &io::Chart::title);
    const bool fresh = same == charts.end();
    if (fresh) {
        charts.push_back(chart);
        same = charts.end() - 1;
        same->curves.clear();
    }
    for (io::Curve curve : chart.curves) {
        curve.label = curve.label.empty() || chart.curves.size() == 1 ? label : label + ", " + curve.label;
        same->curves.push_back(std::move(curve));
    }
}

}  // namespace

io::Page outcome_page(const ManeuverRun& run, const Outcome& outcome) {
    io::Page page{
        .title = run.title, .subtitle = run.standard + " · " + run.vehicle, .blocks = {}, .runs = outcome.runs};
    if (outcome.failed) page.blocks.push_back(io::Paragraph{"It could not be driven to its end: " + *outcome.failed});
    if (!outcome.verdicts.empty()) page.blocks.push_back(io::Verdicts{outcome.verdicts});
    if (!outcome.figures.empty()) page.blocks.push_back(figures_table(outcome));
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
    std::vector<io::Chart> charts;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        auto& [run, outcome] = runs[i];
        if (page.title.find(run.title) == std::string::npos) page.title += (i == 0 ? "" : ", ") + run.title;
        page.subtitle += (i == 0 ? "" : " · ") + labels[i];
        for (const io::Chart& chart : outcome.charts) lay_over(chart, labels[i], charts);
        for (io::PageRun& film : outcome.runs) {
            film.name = labels[i] + (outcome.runs.size() > 1 ? ", " + film.name : "");
            page.runs.push_back(std::move(film));
        }
    }
    page.blocks.push_back(side_by_side(runs, labels));
    for (io::Chart& chart : charts) page.blocks.push_back(std::move(chart));
    if (!page.runs.empty()) {
        page.blocks.push_back(io::Heading{"The drives"});
        page.blocks.push_back(io::Replay{});
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
        page.blocks.push_back(io::Heading{labels[i]});
        if (!runs[i].second.verdicts.empty()) page.blocks.push_back(io::Verdicts{runs[i].second.verdicts});
        page.blocks.push_back(inputs_table(runs[i].first));
    }
    return page;
}

}  // namespace hamilcar
