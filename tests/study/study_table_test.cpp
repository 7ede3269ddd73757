// What is made of a study's results.
#include "hamilcar/study/study_table.hpp"

#include <gmock/gmock.h>
#include <netcdf.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "hamilcar/io/error.hpp"
#include "hamilcar/study/study_record.hpp"

namespace hamilcar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

StudyDescription two_parameters() {
    StudyDescription study;
    study.name = "s", study.vehicle = "v.toml";
    study.parameters = {{.name = "a", .keys = {"vehicle.a"}, .values = {"1", "2"}},
                        {.name = "b", .keys = {"vehicle.b"}, .values = {"10", "20", "30"}}};
    study.runs = {{.name = "turn", .scenario = "", .maneuver = "constant_radius", .analysis = ""}};
    return study;
}

// figure = 100 a + b; the last point failed.
StudyResults results_of(const std::vector<StudyPoint>& points) {
    StudyResults results(points.size(), std::vector<std::optional<RunResult>>(1));
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double value = 100 * points[i].numbers[0] + points[i].numbers[1];
        results[i][0] = RunResult{{{"roll", "deg", "meant", value}, {"pitch", "deg", "", -value}}, value < 115, ""};
    }
    results.back()[0] = RunResult{{}, {}, "it fell over"};
    return results;
}

TEST(StudyTable, HasAColumnForEveryFigureAndANumberForEveryPoint) {
    const StudyDescription study = two_parameters();
    const auto points = points_of(study);
    const StudyTable table = study_table(study, points, results_of(points));
    ASSERT_EQ(table.figures.size(), 2u);
    EXPECT_EQ(table.figures[0].name, "turn: roll");
    EXPECT_EQ(table.figures[0].values[4], 220);
    EXPECT_TRUE(std::isnan(table.figures[0].values[5]));
    EXPECT_THAT(study_csv(table),
                testing::StartsWith("point,a,b,turn: roll [deg],turn: pitch [deg],turn: passed,turn: failed,score\n"
                                    "1,1,10,110,-110,yes,,\n2,1,20,120,-120,no,,\n3,1,"));
    EXPECT_THAT(study_csv(table), HasSubstr("6,2,30,,,,it fell over,\n"));
}

TEST(StudyTable, FindsTheBestByWeightedGoals) {
    StudyDescription study = two_parameters();
    study.goals = {{.figure = "turn: roll", .want = Want::target, .target = 125, .weight = 1}};
    const auto points = points_of(study);
    EXPECT_EQ(study_table(study, points, results_of(points)).best(), 1u);  // 120, before 130 as near: the first
    study.goals.push_back({.figure = "turn: pitch", .want = Want::max, .weight = 100});
    EXPECT_EQ(study_table(study, points, results_of(points)).best(), 0u);
    study.goals = {{.figure = "turn: roll", .want = Want::max}};
    const StudyTable table = study_table(study, points, results_of(points));
    EXPECT_EQ(table.best(), 4u);
    EXPECT_EQ(table.scores[4], 0);
    EXPECT_EQ(table.scores[0], 1);
    study.goals = {{.figure = "turn: yaw"}};
    EXPECT_EQ(study_table(study, points, results_of(points)).best(), std::nullopt);
}

TEST(StudyTable, TellsMainEffectsAndCorrelations) {
    const StudyDescription study = two_parameters();
    const auto points = points_of(study);
    const StudyTable table = study_table(study, points, results_of(points));
    const MainEffect a = main_effect(table, 0, table.figures[0]);
    EXPECT_THAT(a.values, ElementsAre(1, 2));
    EXPECT_THAT(a.means, ElementsAre(120, 215));
    EXPECT_NEAR(correlation(table.figures[0].values, table.figures[1].values), -1, 1e-15);
    EXPECT_NEAR(correlation({1, 2, 3, 4}, {1, 3, 2, 4}), 0.8, 1e-15);  // by hand: 4 / 5
    EXPECT_TRUE(std::isnan(correlation({1, 1}, {1, 2})));
}

// A parameter with a value of its own at every point: means of ten parts of its range.
TEST(StudyTable, AveragesPartsOfARangeThatWasSampled) {
    StudyTable table;
    StudyColumn figure{"f", "1", "", {}};
    for (int i = 0; i < 100; ++i) {
        table.points.push_back({{""}, {double(i)}});
        figure.values.push_back(2.0 * i);
    }
    const MainEffect effect = main_effect(table, 0, figure);
    ASSERT_EQ(effect.values.size(), 10u);
    EXPECT_NEAR(effect.values[0], 4.95, 1e-12);
    EXPECT_NEAR(effect.means[0], 9, 1e-12);
}

TEST(StudyTable, IsReadByNetcdf) {
    const StudyDescription study = two_parameters();
    const auto points = points_of(study);
    const fs::path path = fs::temp_directory_path() / ("hamilcar_study_" + std::to_string(getpid()) + ".nc");
    write_study_netcdf(path.string(), study_table(study, points, results_of(points)));
    int file = 0, variable = 0;
    ASSERT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file), NC_NOERR);
    std::array<double, 6> values{};
    ASSERT_EQ(nc_inq_varid(file, "turn: roll", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_double(file, variable, values.data()), NC_NOERR);
    EXPECT_EQ(values[4], 220);
    std::array<char, 4> unit{};
    ASSERT_EQ(nc_get_att_text(file, variable, "units", unit.data()), NC_NOERR);
    EXPECT_STREQ(unit.data(), "deg");
    nc_close(file);
    fs::remove(path);
}

class StudyRecords : public testing::Test {
protected:
    StudyRecords() : path_(fs::temp_directory_path() / ("hamilcar_study_" + std::to_string(getpid()) + ".jsonl")) {}
    ~StudyRecords() override { fs::remove(path_); }
    static StudyResults none() { return StudyResults(2, std::vector<std::optional<RunResult>>(1)); }
    fs::path path_;
};

TEST_F(StudyRecords, GoOnWhereTheyWere) {
    StudyResults results = none();
    {
        StudyRecord record(path_.string(), 7, results);
        record.add(0, 0, {{{"f", "1", "m", 1.0 / 3}, {"g", "1", "", NAN}}, true, ""});
        record.add(1, 0, {{}, {}, "why"});
    }
    StudyResults again = none();
    EXPECT_EQ(StudyRecord(path_.string(), 7, again).found(), 2u);
    EXPECT_EQ(again[0][0]->figures[0].value, 1.0 / 3);
    EXPECT_TRUE(std::isnan(again[0][0]->figures[1].value));
    EXPECT_EQ(again[0][0]->passed, true);
    EXPECT_EQ(again[1][0]->failed, "why");

    // Killed within a line: that one is evaluated again.
    fs::resize_file(path_, fs::file_size(path_) - 5);
    again = none();
    {
        StudyRecord record(path_.string(), 7, again);
        EXPECT_EQ(record.found(), 1u);
        EXPECT_FALSE(again[1][0]);
        record.add(1, 0, {{}, {}, "why not"});
    }
    again = none();
    EXPECT_EQ(StudyRecord(path_.string(), 7, again).found(), 2u);
    EXPECT_EQ(again[1][0]->failed, "why not");
}

TEST_F(StudyRecords, OfAnotherStudyOrDamagedAreRefused) {
    StudyResults results = none();
    { StudyRecord(path_.string(), 7, results).add(0, 0, {{}, {}, "x"}); }
    EXPECT_THROW(StudyRecord(path_.string(), 8, results), io::Error);
    std::ofstream(path_, std::ios::app)
        << "{\"point\": 99, \"run\": 0, \"figures\": [], \"passed\": null, \"failed\": \"\"}\n";
    EXPECT_THROW(StudyRecord(path_.string(), 7, results), io::Error);
}

}  // namespace
}  // namespace hamilcar
