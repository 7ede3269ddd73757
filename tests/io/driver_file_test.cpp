// The driver of a scenario: what its keys mean, points from lists, tables and files, and mistakes with their place.
#include <numbers>

#include "hamilcar/io/driver_file.hpp"
#include "hamilcar/io/key_record.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;

DriverDescription driver(const TemporaryFolder& folder, const std::string& text) {
    Node document = read_toml(folder.write("s.toml", text));
    const TableReader file(document, "");
    const DriverDescription read = read_driver(file.table("driver"));
    file.finish();
    return read;
}

DriverDescription driver(const std::string& text) {
    const TemporaryFolder folder;
    return driver(folder, text);
}

std::string mistake(const std::string& text, const std::string& points = "") {
    const TemporaryFolder folder;
    folder.write("line.csv", points);
    try {
        driver(folder, text);
    } catch (const Error& error) {
        return error.what();
    }
    return "no mistake";
}

TEST(DriverFile, ReadsEverything) {
    const DriverDescription d = driver(R"([driver]
interval_s = 0.01
[driver.path]
closed = true
preview_s = 0.7
largest_angle_deg = 180.0
largest_rate_deg_per_s = 600.0
x_m = [0.0, 10.0, 5.0]
y_m = [0.0, 0.0, 8.0]
[driver.speed]
time_s = [0.0, 10.0]
speed_m_per_s = [10.0, 20.0]
interpolation = "linear"
may_brake = false
largest_acceleration_m_per_s2 = 2.0
[driver.gear]
choice = "automatic"
first = 2
[driver.ending]
speed_below_m_per_s = 1.0
speed_above_m_per_s = 40.0
distance_m = 500.0
station_m = 400.0
path_offset_m = 2.0
lateral_acceleration_m_per_s2 = 9.0
roll_deg = 30.0
earliest_s = 1.5
)");
    EXPECT_EQ(d.interval, 0.01);
    ASSERT_TRUE(d.steering && d.speed && d.shifting);
    EXPECT_TRUE(d.steering->path.closed);
    EXPECT_THAT(d.steering->path.points, ElementsAre(ElementsAre(0, 0), ElementsAre(10, 0), ElementsAre(5, 8)));
    EXPECT_EQ(d.steering->preview_time, 0.7);
    EXPECT_DOUBLE_EQ(d.steering->largest_angle, 180 * degree);
    EXPECT_DOUBLE_EQ(d.steering->largest_rate, 600 * degree);
    EXPECT_THAT(d.speed->speed.value, ElementsAre(10, 20));
    EXPECT_EQ(d.speed->speed.interpolation, Interpolation::linear);
    EXPECT_FALSE(d.speed->may_brake);
    EXPECT_EQ(d.speed->largest_acceleration, 2);
    EXPECT_EQ(d.shifting->gear, std::nullopt);
    EXPECT_EQ(d.shifting->first_gear, 2);
    EXPECT_EQ(d.ending.speed_below, 1);
    EXPECT_EQ(d.ending.speed_above, 40);
    EXPECT_EQ(d.ending.distance, 500);
    EXPECT_EQ(d.ending.station, 400);
    EXPECT_EQ(d.ending.path_offset, 2);
    EXPECT_EQ(d.ending.lateral_acceleration, 9);
    EXPECT_DOUBLE_EQ(*d.ending.roll, 30 * degree);
    EXPECT_EQ(d.ending.earliest, 1.5);
}

TEST(DriverFile, LeavesOutWhatIsNotThere) {
    const DriverDescription d = driver("[driver.speed]\nspeed_m_per_s = 20.0\n");
    EXPECT_FALSE(d.steering || d.shifting || d.ending.speed_below || d.ending.roll);
    EXPECT_THAT(d.speed->speed.value, ElementsAre(20));
    EXPECT_TRUE(d.speed->may_brake);
    EXPECT_EQ(d.interval, DriverDescription{}.interval);
    EXPECT_EQ(driver("[driver.gear]\n").shifting->first_gear, 1);
    EXPECT_EQ(driver("[driver.gear]\nnumber = -1\n").shifting->gear, -1);
}

TEST(DriverFile, ReadsPointsOneByOneAndFromAFile) {
    const auto points = testing::ElementsAre(ElementsAre(0, 0), ElementsAre(12.5, -1));
    EXPECT_THAT(driver("[[driver.path.point]]\nat_m = [0.0, 0.0]\n[[driver.path.point]]\nat_m = [12.5, -1.0]\n")
                    .steering->path.points,
                points);
    const TemporaryFolder folder;
    for (const std::string text :
         {"0,0\n12.5,-1", "x [m],y [m]\r\n0, 0\r\n\r\n12.5 ,-1.0\r\n", "# a line\n0,0\n12.5,-1\n",
          "\xEF\xBB\xBF"
          "0,0\n12.5,-1\n",
          "\xEF\xBB\xBFx,y\n0,0\n12.5,-1\n"}) {
        folder.write("line.csv", text);
        EXPECT_THAT(driver(folder, "[driver.path]\nfile = \"line.csv\"\n").steering->path.points, points) << text;
    }
}

TEST(DriverFile, TellsWhereAMistakeIs) {
    EXPECT_THAT(mistake("[driver.path]\nx_m = [0.0, 1.0]\ny_m = [0.0]\n"),
                HasSubstr("s.toml:3:7: key 'driver.path.y_m' = [0.0]: expected 2 numbers, one for each of 'x_m'"));
    EXPECT_THAT(
        mistake("[driver.path]\nx_m = [0.0, 1.0, 1.0]\ny_m = [0.0, 2.0, 2.0]\n"),
        HasSubstr("s.toml:2:7: key 'driver.path.x_m' = [0.0, 1.0, 1.0]: expected a path, but points 2 and 3 of the "
                  "path coincide"));
    EXPECT_THAT(mistake("[driver.path]\nclosed = true\nx_m = [0.0, 1.0]\ny_m = [0.0, 2.0]\n"),
                HasSubstr("a path needs at least 3 points to be closed, found 2"));
    EXPECT_THAT(mistake("[driver.path]\nx_m = [0.0, 1.0]\ny_m = [0.0, 1.0]\npreview_s = 0.01\n"),
                HasSubstr("key 'driver.path.preview_s' = 0.01: expected a number from 0.2 to 5 [s]"));
    EXPECT_THAT(
        mistake("[driver.path]\nx_m = [0.0, 1e12]\ny_m = [0.0, 0.0]\n"),
        HasSubstr("s.toml:2:7: key 'driver.path.x_m' = [0.0, 1e12]: expected a path, but point 2 of the path lies "
                  "at 1e+12 m; expected within 1e+06 m of the origin"));
    EXPECT_THAT(mistake("[driver.path]\nx_m = [0.0, 20.0, 0.0]\ny_m = [0.0, 0.0, 0.0]\n"),
                HasSubstr("the path turns back on itself at point 2"));
    EXPECT_THAT(mistake("[driver.path]\nclosed = false\n"), HasSubstr("driver.path.point"));
    EXPECT_THAT(mistake("[driver.speed]\nspeed_m_per_s = -3.0\n"), HasSubstr("expected a number not below zero"));
    EXPECT_THAT(mistake("[driver.gear]\nnumber = 2.5\n"), HasSubstr("expected a whole number from -1 to 20"));
    EXPECT_THAT(mistake("[driver.gear]\nchoice = \"manual\"\n"), HasSubstr("expected 'automatic'"));
    EXPECT_THAT(mistake("[driver.gear]\nchoice = \"automatic\"\nnumber = 2\n"), HasSubstr("driver.gear"));
    EXPECT_THAT(mistake("[driver.ending]\nstation_m = 50.0\n"),
                HasSubstr("key 'driver.ending.station_m' = 50.0: expected a [driver.path] beside it"));
    EXPECT_THAT(mistake("[driver.ending]\nroll_degrees = 50.0\n"), HasSubstr("roll_deg"));
}

TEST(DriverFile, TellsWhatIsWrongInAFileOfPoints) {
    const std::string scenario = "[driver.path]\nfile = \"line.csv\"\n";
    EXPECT_THAT(mistake(scenario, "0,0\n1,a\n"), HasSubstr("line.csv:2: expected a point as x,y [m]"));
    EXPECT_THAT(mistake(scenario, "x,y\nx,y\n0,0\n"), HasSubstr("line.csv:2: expected a point"));
    EXPECT_THAT(mistake(scenario, "0,0\n1,nan\n"), HasSubstr("line.csv:2"));
    EXPECT_THAT(mistake(scenario, "0,0\n1,2,3\n"), HasSubstr("line.csv:2"));
    EXPECT_THAT(mistake(scenario, ""), HasSubstr("a path needs at least 2 points, found 0"));
    EXPECT_THAT(mistake(scenario, "O,0\n1,0\n2,0\n"), HasSubstr("line.csv:1: expected a point")) << "no heading";
    EXPECT_THAT(mistake("[driver.path]\nfile = \"none.csv\"\n"),
                AllOf(HasSubstr("s.toml:2:8: key 'driver.path.file' = \"none.csv\": expected a file that can be read"),
                      HasSubstr("none.csv: cannot read: No such file or directory")));
    EXPECT_THAT(mistake("[driver.path]\nfile = \".\"\n"),
                AllOf(HasSubstr("s.toml:2:8: key 'driver.path.file' = \".\""), HasSubstr("Is a directory")));
}

// The schema is made by reading without a file.
TEST(DriverFile, CanBeRecorded) {
    const TableRecord keys = record_keys([](const TableReader& file) { read_driver(file.table("driver")); });
    const TableRecord& driver = keys.find("driver")->below.at(0);
    EXPECT_NE(driver.find("path")->below.at(0).find("preview_s"), nullptr);
    EXPECT_NE(driver.find("ending")->below.at(0).find("roll_deg"), nullptr);
}

}  // namespace
}  // namespace hamilcar::io
