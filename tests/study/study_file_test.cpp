// Study files, and the points that they ask for.
#include "hamilcar/study/study_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "hamilcar/io/error.hpp"
#include "support/paths.hpp"

namespace hamilcar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

class StudyFile : public testing::Test {
protected:
    StudyFile() : path_(fs::temp_directory_path() / ("hamilcar_study_" + std::to_string(getpid()) + ".toml")) {}
    ~StudyFile() override { fs::remove(path_); }
    StudyDescription read(const std::string& text) const {
        std::ofstream(path_) << "name = \"s\"\nvehicle = \"" << test::source_path("vehicles/hatchback.toml") << "\"\n"
                             << text;
        return read_study(path_.string());
    }
    std::string complaint(const std::string& text) const {
        try {
            read(text);
        } catch (const io::Error& error) {
            return error.what();
        }
        return "";
    }
    fs::path path_;
};

const std::string runs = "[[run]]\nname = \"turn\"\nmaneuver = \"constant_radius\"\n";
const std::string bar =
    "[[parameter]]\nname = \"bar\"\nkey = \"vehicle.axle.front.anti_roll_bar.rate_N_per_m\"\nvalues = [0, 5e3, 1e4]\n";

TEST_F(StudyFile, AsksForEveryCombination) {
    const StudyDescription study = read(
        runs + bar + "[[parameter]]\nname = \"road\"\nkey = \"turn.road.friction\"\nmin = 0.5\nmax = 1\ncount = 3\n");
    const std::vector<StudyPoint> points = points_of(study);
    ASSERT_EQ(points.size(), 9u);
    EXPECT_THAT(points[0].values, ElementsAre("0", "0.5"));
    EXPECT_THAT(points[1].values, ElementsAre("0", "0.75"));
    EXPECT_THAT(points[8].numbers, ElementsAre(1e4, 1.0));
}

TEST_F(StudyFile, SpreadsPointsOverRanges) {
    const std::string range =
        "[[parameter]]\nname = \"a\"\nkey = \"vehicle.chassis.mass_kg\"\nmin = 1000\nmax = 2000\n";
    const std::string words = "[[parameter]]\nname = \"b\"\nkey = \"vehicle.name\"\nwords = [\"x\", \"y\"]\n";
    for (const std::string& sampling :
         {std::string("sampling = \"sobol\"\n"), std::string("sampling = \"latin_hypercube\"\nseed = 3\n")}) {
        const std::vector<StudyPoint> points =
            points_of(read(fmt::format("{}points = 32\n{}{}{}", sampling, runs, range, words)));
        ASSERT_EQ(points.size(), 32u);
        double mean = 0;
        int first = 0;
        for (const StudyPoint& point : points) {
            EXPECT_GE(point.numbers[0], 1000);
            EXPECT_LE(point.numbers[0], 2000);
            mean += point.numbers[0] / 32, first += point.values[1] == "x";
            EXPECT_TRUE(std::isnan(point.numbers[1]));
        }
        EXPECT_NEAR(mean, 1500, 20);
        EXPECT_NEAR(first, 16, 1);
    }
}

TEST_F(StudyFile, SaysWhatIsWrong) {
    EXPECT_THAT(complaint(runs + "[[parameter]]\nname = \"a\"\nkey = \"axle.front.x\"\nvalues = [1]\n"),
                HasSubstr("expected 'vehicle.' or the name of a run with a dot"));
    EXPECT_THAT(complaint(runs + "[[parameter]]\nname = \"a\"\nkey = \"vehicle.x\"\nvalues = [1]\nmin = 3\n"),
                HasSubstr("not both"));
    EXPECT_THAT(complaint(runs + "[[parameter]]\nname = \"a\"\nkey = \"vehicle.x\"\nmin = 3\nmax = 2\n"),
                HasSubstr("expected a number above min"));
    EXPECT_THAT(complaint(bar), HasSubstr("'run'"));
    EXPECT_THAT(complaint(runs + bar + "sampels = 3\n"), HasSubstr("sampels"));
    EXPECT_THAT(complaint(runs + runs + bar), HasSubstr("a name that no other run has"));
    EXPECT_THAT(complaint("sampling = \"sobol\"\n" + runs + bar), HasSubstr("points"));
}

// Keys, settings and channels that are none are told before an hour of driving.
TEST_F(StudyFile, ChecksItsFirstPoint) {
    const auto first = [&](const std::string& text) {
        try {
            const StudyDescription study = read(text);
            check_point(study, points_of(study).front());
        } catch (const io::Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(first(runs + bar), "");
    EXPECT_THAT(first(runs + "[[parameter]]\nname = \"a\"\nkey = \"vehicle.chassis.mas_kg\"\nvalues = [1]\n"),
                HasSubstr("did you mean 'mass_kg'?"));
    EXPECT_THAT(first(runs + "[[parameter]]\nname = \"a\"\nkey = \"turn.maneuver.settings.radios_m\"\nvalues = [1]\n"),
                HasSubstr("did you mean 'radius"));
    EXPECT_THAT(first("[[run]]\nname = \"turn\"\nmaneuver = \"pirouette\"\n" + bar),
                HasSubstr("no maneuver 'pirouette'"));
}

}  // namespace
}  // namespace hamilcar
