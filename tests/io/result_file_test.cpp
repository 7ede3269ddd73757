// Results read back are what was written, and what is no result is told so.
#include "hamilcar/io/result_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include "hamilcar/io/error.hpp"
#include "io/files.hpp"

namespace hamilcar::io {
namespace {

const std::vector<Column> columns{{"chassis.position.x", "m", "ahead"}, {"front_left.carrier.pose.qw", "1", "turn"}};

// Just enough for a picture of nothing.
std::string scene(const std::string& uneven) {
    return R"({"vehicle": "Ü", "frames": [], "links": [], "wheels": [], "tires": [], "bodies": [], "road": {"uneven": )" +
           uneven + "}}";
}

class ResultFiles : public testing::Test {
protected:
    std::string write(int rows, const std::vector<std::pair<std::string, std::string>>& attributes = {}) {
        const std::string path = folder_ / "results.nc";
        const auto writer = open_netcdf(path, columns, "a run", attributes);
        for (int i = 0; i < rows; ++i) writer->write(0.1 * i, std::vector<double>{1. / (i + 1), double(i)});
        writer->close();
        return path;
    }
    static void expect_error(const std::string& path, ExitCode code, const std::string& words) {
        try {
            read_result(path);
            ADD_FAILURE() << "read " << path;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code);
            EXPECT_THAT(error.what(), testing::HasSubstr(words));
        }
    }
    TemporaryFolder folder_;
};

TEST_F(ResultFiles, ComeBackToTheLastBit) {
    const ResultFile file = read_result(write(700, {{scene_attribute, scene("false")}}));
    EXPECT_EQ(file.title, "a run");
    EXPECT_EQ(file.scene, scene("false"));
    ASSERT_EQ(file.columns.size(), 3u);
    EXPECT_EQ(file.columns[0].name, "time");
    EXPECT_EQ(file.columns[1].name, columns[0].name);
    EXPECT_EQ(file.columns[1].unit, "m");
    EXPECT_EQ(file.columns[1].description, "ahead");
    ASSERT_EQ(file.values[1].size(), 700u);
    for (int i = 0; i < 700; ++i) {
        EXPECT_EQ(file.values[0][static_cast<std::size_t>(i)], 0.1 * i);
        EXPECT_EQ(file.values[1][static_cast<std::size_t>(i)], 1. / (i + 1));
    }
    EXPECT_TRUE(file.tiles.empty());
}

TEST_F(ResultFiles, HaveTheirRoadBesideThem) {
    const std::string path = write(2, {{scene_attribute, scene("true")}});
    std::vector<RoadTile> tiles{{-3, 7, std::vector<float>(65 * 65)}, {0, 1, std::vector<float>(65 * 65, 0.25f)}};
    tiles[0].heights[65 * 2 + 5] = -0.125f;
    write_tiles(tiles_beside(path), tiles);
    const ResultFile file = read_result(path);
    ASSERT_EQ(file.tiles.size(), 2u);
    EXPECT_EQ(file.tiles[0].ix, -3);
    EXPECT_EQ(file.tiles[0].iy, 7);
    EXPECT_EQ(file.tiles[0].heights, tiles[0].heights);
    EXPECT_EQ(file.tiles[1].heights, tiles[1].heights);
    write(2, {{scene_attribute, scene("false")}});  // a later run on a plane: those are not its tiles
    EXPECT_TRUE(read_result(path).tiles.empty());
}

TEST_F(ResultFiles, WithAForeignSceneOrRoadAreRefused) {
    for (const char* text : {"{}", "[1]", "no", R"({"frames": []})"}) {
        expect_error(write(2, {{scene_attribute, text}}), ExitCode::bad_file, "attribute 'scene'");
    }
    const std::string path = write(2, {{scene_attribute, scene("true")}});
    int id = 0, dimension = 0, variable = 0;
    nc_create(tiles_beside(path).c_str(), NC_CLOBBER, &id);
    nc_def_dim(id, "tile", 2, &dimension);
    const std::array<int, 4> many{dimension, dimension, dimension, dimension};
    nc_def_var(id, "index", NC_INT, 4, many.data(), &variable);
    nc_def_var(id, "height", NC_FLOAT, 4, many.data(), &variable);
    nc_close(id);
    expect_error(path, ExitCode::bad_file, "expected the tiles of a road");
}

TEST_F(ResultFiles, LeaveOutColumnsOfText) {
    const std::string path = folder_ / "text.nc";
    int id = 0, dimension = 0, time = 0, word = 0;
    nc_create(path.c_str(), NC_CLOBBER, &id);
    nc_def_dim(id, "time", 2, &dimension);
    nc_def_var(id, "time", NC_DOUBLE, 1, &dimension, &time);
    nc_def_var(id, "word", NC_CHAR, 1, &dimension, &word);
    nc_enddef(id);
    nc_close(id);
    EXPECT_EQ(read_result(path).columns.size(), 1u);
}

TEST_F(ResultFiles, ThatAreNoneAreToldSo) {
    expect_error(folder_ / "nowhere.nc", ExitCode::input_output, "nowhere.nc: no such file");
    const std::string text = folder_ / "results.csv";
    std::ofstream(text) << "time [s],a [m]\n0,1\n";
    expect_error(text, ExitCode::bad_file, "expected a netCDF file of results (results.nc): a table of text");
    folder_.write("noise.nc", "CDF? no");
    expect_error(folder_ / "noise.nc", ExitCode::bad_file, "expected a netCDF file of results");
    expect_error(write(0), ExitCode::bad_file, "expected at least one row of results");
    int id = 0;
    nc_create((folder_ / "other.nc").c_str(), NC_CLOBBER, &id);
    nc_close(id);
    expect_error(folder_ / "other.nc", ExitCode::bad_file, "expected a result of hamilcar");
}

}  // namespace
}  // namespace hamilcar::io
