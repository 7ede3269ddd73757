// Columns of measured tables: their headings and units, and mistakes with their line; and that a scenario may have its inputs there.
#include "hamilcar/io/column_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "hamilcar/io/scenario_file.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180;
const ColumnRequest steer{"time", "steer", "time_s", "angle_deg", {"number from -90 to 90", -90, 90}};

std::string mistake(const std::string& text, const ColumnRequest& request = steer) {
    try {
        parse_columns(text, "run.csv", request);
    } catch (const Error& error) {
        return error.what();
    }
    return "no mistake";
}

TEST(ColumnFile, TakesColumnsByTheirHeadings) {
    const Samples plain = parse_columns("speed,steer,time\n9,0,0.5\n8,-30,1\n", "run.csv", steer);
    EXPECT_THAT(plain.argument, ElementsAre(0.5, 1));
    EXPECT_THAT(plain.value, ElementsAre(0, -30 * degree));
    EXPECT_THAT(parse_columns("# of Monday\r\n\r\ntime [s],\"a, b\",steer [rad]\r\n0,7,0.25\r\n", "", steer).value,
                ElementsAre(0.25));
    EXPECT_THAT(parse_columns("\xEF\xBB\xBFtime [ms];steer [deg]\n500;90", "", steer).argument, ElementsAre(0.5));
    EXPECT_THAT(parse_columns("steer\ttime\n1\t0\n# pause\n2\t3\n", "", steer).argument, ElementsAre(0, 3));
}

TEST(ColumnFile, ConvertsUnitsOfTheSameKind) {
    const auto value = [](const std::string& unit, std::string_view key) {
        return parse_columns("time,x [" + unit + "]\n0,18\n", "", {"time", "x", "time_s", key, any_number}).value.at(0);
    };
    EXPECT_DOUBLE_EQ(value("km/h", "speed_m_per_s"), 5);
    EXPECT_DOUBLE_EQ(value("mm", "displacement_m"), 0.018);
    EXPECT_DOUBLE_EQ(value("%", "command"), 0.18);
    EXPECT_DOUBLE_EQ(value("1", "command"), 18);
    EXPECT_DOUBLE_EQ(value("Nm", "torque_N_m"), 18);
    EXPECT_DOUBLE_EQ(value("deg", "angle_deg"), 18 * degree);
}

TEST(ColumnFile, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(mistake(""), "run.csv:1: no line with headings: expected one with 'steer' in it");
    EXPECT_EQ(mistake("time,steer\n"), "run.csv:1: no line of numbers below the headings");
    EXPECT_EQ(mistake("time,load\n0,1\n"), "run.csv:1: no heading 'steer': expected 'time' or 'load'");
    EXPECT_EQ(mistake("time,ster\n0,1\n"), "run.csv:1: no heading 'steer': did you mean 'ster'?");
    EXPECT_EQ(mistake("time,steer,steer [deg]\n0,1,2\n"),
              "run.csv:1: heading 'steer' stands here 2 times: expected once");
    EXPECT_EQ(mistake("time,steer [km/h]\n0,1\n"),
              "run.csv:1: 'steer' is in [km/h]: expected [deg] or a unit that stands for the same");
    EXPECT_EQ(mistake("time,steer\n0,1\n1,2,3\n"), "run.csv:3: 3 fields: expected 2, one for each heading");
    EXPECT_EQ(mistake("time,steer\n0,1\n0,2\n"), "run.csv:3: 'time' = 0: expected a number above the one before");
    EXPECT_EQ(mistake("time,steer\n0,much\n"), "run.csv:2: 'steer' = 'much': expected a finite number");
    EXPECT_EQ(mistake("time,steer\nnan,1\n"), "run.csv:2: 'time' = 'nan': expected a finite number");
    EXPECT_EQ(mistake("time,steer\n0,1,5\n"), "run.csv:2: 3 fields: expected 2, one for each heading");
    EXPECT_EQ(mistake("time,steer\n# so far\n0,91\n"),
              "run.csv:3: 'steer' = 91: expected a number from -90 to 90 [deg]");
    EXPECT_EQ(mistake("time,steer [rad]\n0,1.5\n0.1,1.6\n"),
              "run.csv:3: 'steer' = 1.6: expected a number from -90 to 90 [deg]");
}

class ScenarioWithFiles : public testing::Test {
protected:
    ScenarioDescription read(const std::string& inputs) const {
        return read_scenario(
            folder_.write("s.toml", "name = \"s\"\nvehicle = \"car.toml\"\nduration_s = 1.0\n" + inputs));
    }
    std::string mistake(const std::string& inputs) const {
        try {
            read(inputs);
        } catch (const Error& error) {
            return error.what();
        }
        return "no mistake";
    }
    TemporaryFolder folder_;
};

TEST_F(ScenarioWithFiles, HasItsInputsThere) {
    folder_.write("run.csv", "t,time [s],steer [deg],foot [%],gear [1],wind [km/h]\n5,0,10,0,1,36\n6,2,20,50,2,72\n");
    const ScenarioDescription s = read(
        "[inputs.steering_wheel]\nfile = \"run.csv\"\ncolumn = \"steer\"\ninterpolation = \"linear\"\n"
        "[inputs.brake]\nfile = \"run.csv\"\ncolumn = \"foot\"\ntime_column = \"t\"\n"
        "[inputs.gear]\nfile = \"run.csv\"\ncolumn = \"gear\"\n[wind]\nfile = \"run.csv\"\ncolumn = \"wind\"\n");
    EXPECT_THAT(s.steering.time, ElementsAre(0, 2));
    EXPECT_THAT(s.steering.value, ElementsAre(10 * degree, 20 * degree));
    EXPECT_EQ(s.steering.interpolation, Interpolation::linear);
    EXPECT_THAT(s.brake.time, ElementsAre(5, 6));
    EXPECT_THAT(s.brake.value, ElementsAre(0, 0.5));
    EXPECT_EQ(s.gear.interpolation, Interpolation::steps);
    EXPECT_THAT(s.wind_x.value, ElementsAre(testing::DoubleEq(10), testing::DoubleEq(20)));
}

TEST_F(ScenarioWithFiles, SaysWhatIsWrong) {
    EXPECT_THAT(mistake("[inputs.brake]\nfile = \"none.csv\"\ncolumn = \"foot\"\n"),
                testing::AllOf(HasSubstr("s.toml:5:8: key 'inputs.brake.file' = \"none.csv\""),
                               HasSubstr("none.csv: cannot read: No such file or directory")));
    EXPECT_THAT(mistake("[inputs.brake]\nfile = \".\"\ncolumn = \"foot\"\n"), HasSubstr("Is a directory"));
    try {
        read("[inputs.brake]\nfile = \"none.csv\"\ncolumn = \"foot\"\n");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::input_output);
    }
    folder_.write("run.csv", "time,foot\n0,1.5\n");
    EXPECT_THAT(mistake("[inputs.brake]\nfile = \"run.csv\"\ncolumn = \"foot\"\n"),
                HasSubstr("run.csv:2: 'foot' = 1.5: expected a number from 0 to 1"));
    EXPECT_THAT(mistake("[inputs.brake]\nfile = \"run.csv\"\n"), HasSubstr("key 'inputs.brake.column' is missing"));
    EXPECT_THAT(mistake("[inputs.brake]\nfile = \"run.csv\"\ncommand = 0.5\n"),
                HasSubstr("either this or 'command', not both"));
    folder_.write("run.csv", "time,foot\n0,1\n");
    EXPECT_THAT(mistake("[inputs.brake]\nfile = \"run.csv\"\ncolumn = \"foot\"\ntime_s = [0.0]\n"),
                HasSubstr("'inputs.brake.time_s' = [0.0] is unknown"));
}

}  // namespace
}  // namespace hamilcar::io
