// Roads of scenario files: what each element's keys mean, files beside the scenario, and mistakes with their place.
#include <fstream>

#include "hamilcar/io/scenario_file.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

using testing::HasSubstr;

constexpr const char* head = "name = \"r\"\nvehicle = \"car.toml\"\nduration_s = 1.0\n";

RoadDescription road(const TemporaryFolder& folder, const std::string& text) {
    return read_scenario(folder.write("s.toml", head + text)).road;
}

std::string mistake(const std::string& text) {
    const TemporaryFolder folder;
    try {
        road(folder, text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_file) << error.what();
        return error.what();
    }
    return "no mistake";
}

TEST(RoadFile, ReadsEveryElement) {
    const TemporaryFolder folder;
    const RoadDescription r = road(folder, R"([road]
grade_percent = 4.0
[[road.obstacle]]
shape = "hump"
start_m = 3.0
length_m = 0.4
height_m = 0.05
right_m = -2.0
left_m = 0.0
count = 3
repeat_every_m = 5.0
[[road.wave]]
amplitude_m = 0.02
wavelength_m = 4.0
last_wavelength_m = 1.0
length_m = 100.0
right_phase_deg = 180.0
[[road.random]]
class = "D"
seed = 12
[[road.random]]
class = "A"
[[road.friction_patch]]
start_m = 10.0
friction = 0.3
[[road.posts.wheel]]
time_s = [0.0, 1.0]
height_m = [0.0, 0.1]
)");
    EXPECT_DOUBLE_EQ(r.grade, 0.04);
    ASSERT_EQ(r.obstacles.size(), 1u);
    EXPECT_EQ(r.obstacles[0].shape, ObstacleShape::hump);
    EXPECT_EQ(r.obstacles[0].count, 3);
    EXPECT_EQ(r.obstacles[0].right, -2);
    EXPECT_DOUBLE_EQ(r.waves.at(0).right_phase, std::acos(-1.0));
    EXPECT_EQ(r.waves.at(0).last_wavelength, 1);
    EXPECT_EQ(r.random.at(0).road_class, 'D');
    EXPECT_EQ(r.random.at(0).seed, 12u);
    EXPECT_NE(r.random.at(0).stream, r.random.at(1).stream) << "two roads of one scenario are not the same";
    EXPECT_EQ(r.patches.at(0).friction, 0.3);
    EXPECT_EQ(r.patches.at(0).end, everywhere);
    EXPECT_EQ(r.posts.height.at(0).value.at(1), 0.1);
    EXPECT_FALSE(r.is_plane());
    EXPECT_TRUE(road(folder, "[road]\nfriction = 0.5\n").is_plane());
}

// Rows of the file go from north to south, the table's from y upward.
TEST(RoadFile, ReadsAHeightGridBesideTheScenario) {
    const TemporaryFolder folder;
    folder.write("hill.asc",
                 "ncols 3\nnrows 2\nxllcorner 10\nyllcenter -4\ncellsize 2\nNODATA_value -9999\n1 2 3\n4 5 6.5\n");
    const RoadDescription r = road(folder, "[road]\ngrid_file = \"hill.asc\"\n");
    ASSERT_TRUE(r.grid);
    EXPECT_EQ(r.grid->x, 11) << "a corner lies half a cell before the first node";
    EXPECT_EQ(r.grid->y, -4);
    EXPECT_EQ(r.grid->spacing_x, 2);
    EXPECT_THAT(r.grid->heights, testing::ElementsAre(4, 5, 6.5, 1, 2, 3));
}

TEST(RoadFile, TellsWhereAMistakeIs) {
    EXPECT_THAT(mistake("[[road.random]]\nclass = \"Z\"\n"),
                HasSubstr("s.toml:5:9: key 'road.random[0].class' = \"Z\""));
    EXPECT_THAT(mistake("[[road.obstacle]]\nstart_m = 1.0\nlength_m = -1.0\nheight_m = 0.1\n"),
                HasSubstr(":6:12: key 'road.obstacle[0].length_m' = -1.0: expected a positive number [m]"));
    EXPECT_THAT(
        mistake("[[road.obstacle]]\nstart_m = 1.0\nlength_m = 2.0\nheight_m = 0.1\ncount = 3\nrepeat_every_m = 1.0\n"),
        HasSubstr("repeat_every_m' = 1.0: expected at least length_m [m]"));
    EXPECT_THAT(mistake("[[road.wave]]\namplitude_m = 0.1\nwavelength_m = 2.0\nlast_wavelength_m = 1.0\n"),
                HasSubstr("an endless wave has one wavelength"));
    EXPECT_THAT(mistake("[[road.friction_patch]]\nfriction = 0.5\nright_m = 1.0\nleft_m = -1.0\n"),
                HasSubstr("left_m' = -1.0: expected a number above right_m"));
    EXPECT_THAT(mistake("[[road.bump]]\nstart_m = 1.0\n"), HasSubstr("'road.bump'"));
}

// Each of them costs time at every height that is asked for, or memory before the run.
TEST(RoadFile, HasAtMostSoManyElements) {
    const auto times = [](int count, const std::string& entry) {
        std::string text;
        for (int i = 0; i < count; ++i) text += entry;
        return text;
    };
    const std::string wave = "[[road.wave]]\namplitude_m = 0.1\nwavelength_m = 2.0\n",
                      patch = "[[road.friction_patch]]\nfriction = 0.5\n",
                      random = "[[road.random]]\nclass = \"C\"\nlength_m = 200000.0\n";
    EXPECT_EQ(mistake(times(1000, wave)), "no mistake");
    EXPECT_THAT(mistake(times(1001, wave)), HasSubstr("key 'road.wave'"));
    EXPECT_THAT(mistake(times(1001, wave)), HasSubstr("expected at most 1000 of them"));
    EXPECT_THAT(mistake(times(1001, patch)), HasSubstr("expected at most 1000 of them"));
    EXPECT_EQ(mistake(times(2, random)), "no mistake");
    EXPECT_THAT(mistake(times(3, random)),
                HasSubstr("expected all of them together at most 8 million times their spacing_m"));
}

std::string grid_mistake(const std::string& text) {
    const TemporaryFolder folder;
    folder.write("g.asc", text);
    try {
        road(folder, "[road]\ngrid_file = \"g.asc\"\n");
    } catch (const Error& error) {
        return error.what();
    }
    return "no mistake";
}

TEST(RoadFile, TellsWhatIsWrongInAGrid) {
    const std::string start = "ncols 2\nnrows 2\ncellsize 1\n";
    EXPECT_THAT(grid_mistake(start + "1 2\n3 x\n"), HasSubstr("g.asc:5: expected a height, found 'x'"));
    EXPECT_THAT(grid_mistake(start + "1 2\n3"), HasSubstr("found the end of the file"));
    EXPECT_THAT(grid_mistake(start + "1 2\n3 4 5\n"), HasSubstr("more heights than columns times rows"));
    EXPECT_THAT(grid_mistake("ncols 2\nnrows 2\n1 2\n3 4\n"), HasSubstr("cellsize"));
    EXPECT_THAT(grid_mistake("ncols 99999999\nnrows 99999999\ncellsize 1\n1 2\n"), HasSubstr("do not fit"));
    EXPECT_THAT(grid_mistake("ncols 2.5\nnrows 2\ncellsize 1\n1 2\n3 4\n"), HasSubstr("expected a whole number"));
    EXPECT_THAT(grid_mistake(start + "nodata_value -1\n1 2\n3 -1\n"), HasSubstr("a height is missing"));
}

}  // namespace
}  // namespace hamilcar::io
