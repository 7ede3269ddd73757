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
    const ResultFile file = read_result(write(700, {{scene_attribute, R"({"vehicle": "Ü"})"}}));
    EXPECT_EQ(file.title, "a run");
    EXPECT_EQ(file.scene, R"({"vehicle": "Ü"})");
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
    const std::string path = write(2, {{scene_attribute, "{}"}});
    std::vector<RoadTile> tiles{{-3, 7, std::vector<float>(65 * 65)}, {0, 1, std::vector<float>(65 * 65, 0.25f)}};
    tiles[0].heights[65 * 2 + 5] = -0.125f;
    write_tiles(tiles_beside(path), tiles);
    const ResultFile file = read_result(path);
    ASSERT_EQ(file.tiles.size(), 2u);
    EXPECT_EQ(file.tiles[0].ix, -3);
    EXPECT_EQ(file.tiles[0].iy, 7);
    EXPECT_EQ(file.tiles[0].heights, tiles[0].heights);
    EXPECT_EQ(file.tiles[1].heights, tiles[1].heights);
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
