// Outcomes side by side.
#include "hamilcar/maneuver/comparison.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace hamilcar {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

NamedOutcome run_of(const std::string& vehicle, std::vector<Figure> figures, std::vector<Verdict> verdicts = {}) {
    NamedOutcome run;
    run.first.maneuver = run.first.title = "Slalom", run.first.vehicle = vehicle;
    run.second.figures = std::move(figures), run.second.verdicts = std::move(verdicts);
    return run;
}

const std::vector<NamedOutcome> three{
    run_of("Car", {{"roll", "deg", "largest", 4}, {"time", "s", "", 20}}, {{"no cone is hit", true, ""}}),
    run_of("Van", {{"time", "s", "", none}, {"roll", "deg", "largest", 5}}, {{"no cone is hit", false, "2 cones"}}),
    run_of("Truck, long", {{"roll", "deg", "largest", 3}, {"swept width", "m", "", 1.5}})};

TEST(Comparison, PutsFiguresOfOneNameInOneRow) {
    const Comparison c = compare(three);
    ASSERT_EQ(c.figures.size(), 3u);
    EXPECT_EQ(c.figures[0].name, "roll");
    EXPECT_EQ(c.figures[0].values, (std::vector<double>{4, 5, 3}));
    EXPECT_EQ(c.figures[0].difference(2), -1);
    EXPECT_TRUE(std::isnan(c.figures[1].values[1]) && std::isnan(c.figures[1].values[2]));
    EXPECT_EQ(c.figures[2].name, "swept width");
    EXPECT_TRUE(std::isnan(c.figures[2].difference(2)));
    ASSERT_EQ(c.verdicts.size(), 1u);
    EXPECT_EQ(c.verdicts[0].passed, (std::vector<std::optional<bool>>{true, false, std::nullopt}));
}

TEST(Comparison, WritesATableForSpreadsheets) {
    EXPECT_EQ(comparison_csv(compare(three)),
              "kind,name,unit,Car,Van,\"Truck, long\"\n"
              "figure,roll,deg,4,5,3\n"
              "figure,time,s,20,,\n"
              "figure,swept width,m,,,1.5\n"
              "verdict,no cone is hit,,passed,not passed,\n");
}

TEST(Comparison, IsAnObjectForPrograms) {
    const auto json = comparison_json(compare(three), three);
    EXPECT_EQ(json["runs"][1]["label"], "Van");
    EXPECT_EQ(json["runs"][1]["passed"], false);
    EXPECT_EQ(json["figures"][0]["differences_from_first"], nlohmann::ordered_json({0, 1, -1}));
    EXPECT_TRUE(json["figures"][1]["values"][2].is_null());
    EXPECT_EQ(json["verdicts"][0]["passed"], nlohmann::ordered_json({true, false, nullptr}));
}

TEST(Comparison, TellsDifferencesInPercentOfTheFirst) {
    const io::Table table = differences_table(compare(three));
    EXPECT_EQ(table.title, "Differences from Car");
    ASSERT_EQ(table.rows.size(), 1u);  // the one figure that the first shares with another
    EXPECT_EQ(table.rows[0][2], io::Cell(1.0));
    EXPECT_EQ(table.rows[0][3], io::Cell(25.0));
    EXPECT_EQ(table.rows[0][5], io::Cell(-25.0));
}

// The same vehicle with another number is told by that number.
TEST(Comparison, LabelsByWhatWasSet) {
    std::vector<NamedOutcome> runs{run_of("Car", {}), run_of("Car", {}), run_of("Car", {})};
    runs[1].first.vehicle_set = {"chassis.mass_kg=1500", "gravity_m_per_s2=9.81"};
    runs[2].first.vehicle_set = {"chassis.mass_kg=1600", "gravity_m_per_s2=9.81"};
    runs[0].first.vehicle_set = {"gravity_m_per_s2=9.81"};
    EXPECT_THAT(compare(runs).labels,
                testing::ElementsAre("Car", "Car, chassis.mass_kg=1500", "Car, chassis.mass_kg=1600"));
}

}  // namespace
}  // namespace hamilcar
