// Pages of outcomes: nothing that a run has to tell is lost, neither alone nor beside another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "hamilcar/maneuver/outcome_file.hpp"
#include "hamilcar/run/validity_report.hpp"

namespace hamilcar {
namespace {

ManeuverRun run_of(const std::string& vehicle) {
    return {.maneuver = "slalom", .title = "Slalom", .standard = "none", .vehicle = vehicle, .vehicle_file = "v.toml"};
}

Outcome outcome_with(double value) {
    Outcome out;
    out.figures = {{"grip", "m/s^2", "most", value}};
    out.charts = {{.title = "Path", .x_label = "x [m]", .y_label = "y [m]", .curves = {{"", {0, 1}, {0, value}}}}};
    return out;
}

bool tells(const io::Page& page, const std::string& words) {
    return std::ranges::any_of(page.blocks, [&](const io::PageBlock& block) {
        const auto* paragraph = std::get_if<io::Paragraph>(&block);
        return paragraph && paragraph->text.find(words) != std::string::npos;
    });
}

const io::Chart& chart_of(const io::Page& page) {
    for (const io::PageBlock& block : page.blocks) {
        if (const auto* chart = std::get_if<io::Chart>(&block)) return *chart;
    }
    throw std::out_of_range("no chart");
}

TEST(ComparisonPage, NamesTheRunThatFailedAndEveryRunsNotes) {
    Outcome good = outcome_with(5), bad = outcome_with(3);
    good.notes = {"the tires were warm"};
    bad.failed = "it fell over", bad.notes = {"the road was wet"};
    const io::Page page = comparison_page({{run_of("Car"), good}, {run_of("Van"), bad}});
    EXPECT_TRUE(tells(page, "Van could not be driven to its end: it fell over"));
    EXPECT_FALSE(tells(page, "Car could not be driven"));
    EXPECT_TRUE(tells(page, "Car: the tires were warm"));
    EXPECT_TRUE(tells(page, "Van: the road was wet"));
}

TEST(OutcomePage, ShowsWhatLimitsItsValidityOrThatNothingDoes) {
    const auto has_table = [](const io::Page& page, const std::string& where) {
        return std::ranges::any_of(page.blocks, [&](const io::PageBlock& block) {
            const auto* table = std::get_if<io::Table>(&block);
            return table && std::ranges::any_of(table->rows, [&](const std::vector<io::Cell>& row) {
                       return std::holds_alternative<std::string>(row[0]) && std::get<std::string>(row[0]) == where;
                   });
        });
    };
    Outcome out = outcome_with(5);
    EXPECT_TRUE(tells(outcome_page(run_of("Car"), out), "no model left its range"));
    out.validity = {{.kind = "tire_load",
                     .where = "front_left.tire",
                     .quantity = "vertical force",
                     .unit = "N",
                     .worst = 9000,
                     .limit = 8000,
                     .time = 2,
                     .from = 1.5,
                     .to = 2.5,
                     .meaning = "the file ends",
                     .advice = "another file",
                     .drive = "to the left"}};
    EXPECT_TRUE(has_table(outcome_page(run_of("Car"), out), "front_left.tire, to the left"));
    EXPECT_TRUE(has_table(comparison_page({{run_of("Car"), out}, {run_of("Van"), outcome_with(3)}}),
                          "front_left.tire, to the left"));
    const std::vector<ValidityWarning> back = validity_of(outcome_json(run_of("Car"), out).at("validity"));
    ASSERT_EQ(back.size(), 1u);
    EXPECT_EQ(sentence(back[0]), sentence(out.validity[0]));
}

TEST(ComparisonPage, ExplainsMissingValuesWhereThereAreAny) {
    const double missing = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(
        tells(comparison_page({{run_of("Car"), outcome_with(5)}, {run_of("Van"), outcome_with(missing)}}), "No value"));
    EXPECT_FALSE(
        tells(comparison_page({{run_of("Car"), outcome_with(5)}, {run_of("Van"), outcome_with(3)}}), "No value"));
    EXPECT_TRUE(tells(outcome_page(run_of("Van"), outcome_with(missing)), "No value"));
    EXPECT_FALSE(tells(outcome_page(run_of("Van"), outcome_with(3)), "No value"));
}

TEST(ComparisonPage, ShowsConesAndMarksOfEveryRunOnceWhereTheyAreTheSame) {
    Outcome one = outcome_with(5);
    one.charts[0].marks = {{"cones", {10, 20}, {1, 1}}};
    one.charts[0].lines = {{0, 0, 10, 0}};
    one.charts[0].vertical_marks = {{10, "gate"}};
    one.charts[0].horizontal_marks = {{2, "limit"}};
    Outcome other = one;
    const io::Page same = comparison_page({{run_of("Car"), one}, {run_of("Van"), other}});
    EXPECT_EQ(chart_of(same).curves.size(), 2u);
    ASSERT_EQ(chart_of(same).marks.size(), 1u);
    EXPECT_EQ(chart_of(same).marks[0].label, "cones");
    EXPECT_EQ(chart_of(same).lines.size(), 1u);
    EXPECT_EQ(chart_of(same).vertical_marks.size(), 1u);

    other.charts[0].marks[0].y = {1.2, 1.2};  // a wider vehicle's course
    other.charts[0].lines[0].y1 = 0.2;
    other.charts[0].vertical_marks = {{10, "gate"}, {12, "second gate"}};
    const io::Page differing = comparison_page({{run_of("Car"), one}, {run_of("Van"), other}});
    const io::Chart& chart = chart_of(differing);
    ASSERT_EQ(chart.marks.size(), 2u);
    EXPECT_EQ(chart.marks[0].label, "Car, cones");
    EXPECT_EQ(chart.marks[1].label, "Van, cones");
    EXPECT_EQ(chart.marks[1].y[0], 1.2);
    EXPECT_EQ(chart.lines.size(), 2u);
    ASSERT_EQ(chart.vertical_marks.size(), 2u);
    EXPECT_EQ(chart.vertical_marks[0].second, "gate");
    EXPECT_EQ(chart.vertical_marks[1].second, "Van, second gate");
    ASSERT_EQ(chart.horizontal_marks.size(), 1u);
    EXPECT_EQ(chart.horizontal_marks[0].second, "limit");
}

TEST(OutcomeFile, GivesBackEveryDiagramAndVerdictThatWasWritten) {
    Outcome out = outcome_with(5);
    out.charts.push_back({.title = "Bare", .x_label = "x", .y_label = "y"});
    io::Chart& chart = out.charts[0];
    chart.curves = {{"driven", {0, 1, 2}, {0, std::numeric_limits<double>::quiet_NaN(), 3}, true}};
    chart.log_y = chart.equal_axes = true;
    chart.marks = {{"cones", {10, 20}, {1, 2}}};
    chart.lines = {{1, 2, 3, 4}};
    chart.vertical_marks = {{10, "gate"}};
    chart.horizontal_marks = {{2, "limit"}};
    out.verdicts = {{"no cone is hit", false, "2 cones"}};
    const std::string path = testing::TempDir() + "outcome.json";
    ManeuverRun car = run_of("Car");
    car.settings = {{{.name = "speed", .unit = "km/h", .default_value = 80}, 90},
                    {choice_setting("side", "that is slippery", {{"left", 1}, {"right", -1}}, "left"), -1}};
    std::ofstream(path) << outcome_json(car, out).dump();
    const auto [run, read] = read_outcome(path);
    ASSERT_EQ(run.settings.size(), 2u);
    EXPECT_EQ(setting_text(run.settings[0].first, run.settings[0].second), "90");
    EXPECT_EQ(setting_text(run.settings[1].first, run.settings[1].second), "right");
    ASSERT_EQ(read.charts.size(), 2u);
    const io::Chart& back = read.charts[0];
    ASSERT_EQ(back.curves.size(), 1u);
    EXPECT_EQ(back.curves[0].label, "driven");
    EXPECT_EQ(back.curves[0].x, chart.curves[0].x);
    EXPECT_TRUE(std::isnan(back.curves[0].y.at(1))) << "a gap stays one";
    EXPECT_EQ(back.curves[0].y.at(2), 3);
    EXPECT_TRUE(back.curves[0].points && back.log_y && back.equal_axes && !back.log_x);
    EXPECT_EQ(back.title + back.x_label + back.y_label, chart.title + chart.x_label + chart.y_label);
    ASSERT_EQ(back.marks.size(), 1u);
    EXPECT_EQ(back.marks[0].label, "cones");
    EXPECT_EQ(back.marks[0].y, chart.marks[0].y);
    ASSERT_EQ(back.lines.size(), 1u);
    EXPECT_EQ(back.lines[0].y1, 4);
    EXPECT_EQ(back.vertical_marks, chart.vertical_marks);
    EXPECT_EQ(back.horizontal_marks, chart.horizontal_marks);
    EXPECT_TRUE(read.charts[1].marks.empty() && read.charts[1].lines.empty() && !read.charts[1].equal_axes);
    ASSERT_EQ(read.verdicts.size(), 1u);
    EXPECT_EQ(read.verdicts[0].found, "2 cones");
    EXPECT_FALSE(read.verdicts[0].passed);
}

// A diagram that only the second run has keeps what is on it.
TEST(ComparisonPage, KeepsDiagramsThatOnlyOneRunHas) {
    Outcome none = outcome_with(5), one = outcome_with(3);
    none.charts.clear();
    one.charts[0].marks = {{"cones", {10}, {1}}};
    const io::Page page = comparison_page({{run_of("Car"), none}, {run_of("Van"), one}});
    EXPECT_EQ(chart_of(page).marks.size(), 1u);
    EXPECT_EQ(chart_of(page).curves.at(0).label, "Van");
}

}  // namespace
}  // namespace hamilcar
