// Pages of outcomes: one maneuver, or several beside each other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/merged_chart.hpp"
#include "hamilcar/maneuver/comparison.hpp"
#include "hamilcar/run/validity_report.hpp"

namespace hamilcar {

namespace {

using Named = NamedOutcome;

io::Cell cell(double value) {
    return std::isfinite(value) ? io::Cell(value) : io::Cell();
}

io::Table figures_table(const Outcome& outcome) {
    io::Table table{"Characteristic values", {{"", ""}, {"value", ""}, {"unit", ""}, {"meaning", ""}}, {}};
    for (const Figure& f : outcome.figures) {
        const std::optional<Figure> other = per_g(f);
        const bool has_both = other && std::isfinite(f.value);
        table.rows.push_back(
            {f.name, cell(f.value), f.unit,
             has_both ? fmt::format("{}: {:.3g} {}", f.meaning, other->value, other->unit) : f.meaning});
    }
    return table;
}

io::Table inputs_table(const ManeuverRun& run) {
    io::Table table{"What was driven", {{"", ""}, {"value", ""}, {"unit", ""}, {"meaning", ""}}, {}};
    const auto add = [&](std::string name, io::Cell value, std::string unit, std::string meaning) {
        table.rows.push_back({std::move(name), std::move(value), std::move(unit), std::move(meaning)});
    };
    add("vehicle", run.vehicle, "", run.vehicle_file);
    for (const std::string& assignment : run.vehicle_set) add("vehicle with", assignment, "", "instead of its file");
    for (const auto& [setting, value] : run.settings) {
        const bool has_words = !setting.choices.empty();
        add(setting.name, has_words ? io::Cell(setting_text(setting, value)) : io::Cell(value), setting.unit,
            setting.meaning);
    }
    add("integration step", run.step, "s", "by " + run.integrator);
    add("program", run.program, "", "");
    return table;
}

io::Table energy_table(const EnergyBalance& energy) {
    const auto row = [](std::string name, double joule) {
        return std::vector<io::Cell>{std::move(name), 1e-3 * joule, std::string("kJ")};
    };
    return {"Energy",
            {{"", ""}, {"value", ""}, {"unit", ""}},
            {row("supplied by engine or wheel torque", energy.supplied), row("gained by the vehicle", energy.stored),
             row("dissipated, less what the steering put in", energy.dissipated),
             row("energy balance residual", energy.residual())}};
}

// Diagrams of one title in one, in the order in which they first come.
std::vector<io::Chart> overlaid(const std::vector<Named>& runs, const std::vector<std::string>& labels) {
    std::vector<io::LabeledCharts> by_title;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        for (const io::Chart& chart : runs[i].second.charts) {
            auto same = std::ranges::find_if(
                by_title, [&](const io::LabeledCharts& laid) { return laid.front().first->title == chart.title; });
            if (same == by_title.end()) same = by_title.emplace(by_title.end());
            same->emplace_back(&chart, labels[i]);
        }
    }
    std::vector<io::Chart> out;
    for (const io::LabeledCharts& laid : by_title) out.push_back(io::merged(laid));
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
    add_validity(outcome.validity, page);
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
    add_validity(outcome.validity, page);
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
    const Comparison comparison = compare(runs);
    const std::vector<std::string>& labels = comparison.labels;
    io::Page page;
    std::vector<io::Chart> charts = overlaid(runs, labels);
    for (std::size_t i = 0; i < runs.size(); ++i) {
        auto& [run, outcome] = runs[i];
        if (page.title.find(run.title) == std::string::npos) page.title += (i == 0 ? "" : ", ") + run.title;
        page.subtitle += (i == 0 ? "" : " · ") + labels[i];
        add_failure(outcome, labels[i], page);
        for (io::PageRun& replay : outcome.runs) {
            replay.name = labels[i] + (outcome.runs.size() > 1 ? ", " + replay.name : "");
            page.runs.push_back(std::move(replay));
        }
    }
    add_figures(values_table(comparison), "No value: that drive did not show it, or its maneuver does not have it.",
                page);
    page.blocks.push_back(differences_table(comparison));
    for (io::Chart& chart : charts) page.blocks.push_back(std::move(chart));
    if (!page.runs.empty()) {
        page.blocks.push_back(io::Heading{"The drives"});
        page.blocks.push_back(io::Replay{});
    }
    for (std::size_t i = 0; i < runs.size(); ++i) add_run(runs[i].first, runs[i].second, labels[i], page);
    return page;
}

}  // namespace hamilcar
