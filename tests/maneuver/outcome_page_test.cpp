// Pages of outcomes: nothing that a run has to tell is lost, neither alone nor beside another.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "hamilcar/maneuver/outcome_file.hpp"

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
