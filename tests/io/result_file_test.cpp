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
    expect_error(folder_ / "nowhere.nc", ExitCode::input_output, "nowhere.nc: cannot read: No such file");
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

// By Unidata's library, in every format and type of numbers, over records and not: odd sizes are padded, or not where they are alone.
TEST_F(ResultFiles, OfOthersAreReadWhateverTheirNumbersAre) {
    struct Kind {
        nc_type type;
        double lowest, highest;
    };
    const std::vector<Kind> classic{{NC_BYTE, -128, 127},
                                    {NC_SHORT, -32768, 32767},
                                    {NC_INT, -2147483648.0, 2147483647},
                                    {NC_FLOAT, -1.5e30f, 0.125},
                                    {NC_DOUBLE, -1.1e300, 1.0 / 3}};
    const std::vector<Kind> newer{{NC_UBYTE, 0, 255},
                                  {NC_USHORT, 0, 65535},
                                  {NC_UINT, 0, 4294967295.0},
                                  {NC_INT64, -9007199254740992.0, 9007199254740992.0},
                                  {NC_UINT64, 0, 9007199254740992.0}};
    for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA}) {
        for (const bool over_records : {true, false}) {
            std::vector<Kind> kinds = classic;
            if (format == NC_64BIT_DATA) kinds.insert(kinds.end(), newer.begin(), newer.end());
            for (std::size_t count = 0; count <= kinds.size(); count += kinds.size()) {  // the time alone, or with all
                const std::string path = folder_ / "kinds.nc";
                int id = 0, dimension = 0, time = 0;
                ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER | format, &id), NC_NOERR);
                nc_def_dim(id, "time", over_records ? NC_UNLIMITED : 3, &dimension);
                nc_def_var(id, "time", count == 0 ? NC_SHORT : NC_DOUBLE, 1, &dimension, &time);
                std::vector<int> variables(count);
                for (std::size_t i = 0; i < count; ++i) {
                    const std::string name = "v" + std::to_string(i);
                    ASSERT_EQ(nc_def_var(id, name.c_str(), kinds[i].type, 1, &dimension, &variables[i]), NC_NOERR);
                }
                nc_enddef(id);
                const std::size_t start = 0, rows = 3;
                const std::array<double, 3> times{0, 1, 2};
                nc_put_vara_double(id, time, &start, &rows, times.data());
                for (std::size_t i = 0; i < count; ++i) {
                    const std::array<double, 3> values{kinds[i].lowest, kinds[i].highest, 1};
                    ASSERT_EQ(nc_put_vara_double(id, variables[i], &start, &rows, values.data()), NC_NOERR);
                }
                nc_close(id);
                const ResultFile read = read_result(path);
                ASSERT_EQ(read.columns.size(), count + 1) << format;
                EXPECT_THAT(read.values[0], testing::ElementsAre(0, 1, 2)) << format << over_records;
                for (std::size_t i = 0; i < count; ++i) {
                    EXPECT_THAT(read.values[i + 1], testing::ElementsAre(kinds[i].lowest, kinds[i].highest, 1))
                        << format << over_records << " type " << kinds[i].type;
                }
            }
        }
    }
}

// What a file may ask of a reader that believes it. All of these crashed, hung or took gigabytes.
class ForeignResults : public ResultFiles {
protected:
    // A file of the library's own with one dimension, `time`, and a variable of that name.
    std::string with_time(nc_type type, int rank) {
        const std::string path = folder_ / "foreign.nc";
        int id = 0, dimension = 0, variable = 0;
        nc_create(path.c_str(), NC_CLOBBER, &id);
        nc_def_dim(id, "time", 2, &dimension);
        const std::array<int, 2> shape{dimension, dimension};
        nc_def_var(id, "time", type, rank, shape.data(), &variable);
        nc_close(id);
        return path;
    }
    // A result whose big-endian number at `offset` is another.
    std::string with_number(std::size_t offset, std::uint32_t number) {
        std::string bytes = read_file(write(3));
        for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<char>(number >> (24 - 8 * i));
        return folder_.write("forged.nc", bytes);
    }
};

TEST_F(ForeignResults, NeedATimeOfNumbersOverItsOwnDimension) {
    for (const auto& [type, rank] : {std::pair(NC_CHAR, 1), std::pair(NC_DOUBLE, 0), std::pair(NC_DOUBLE, 2)}) {
        expect_error(with_time(type, rank), ExitCode::bad_file, "with a variable time [s] of numbers");
    }
    EXPECT_EQ(read_result(with_time(NC_FLOAT, 1)).columns.size(), 1u);
}

TEST_F(ForeignResults, OfAnotherFormatAreRefusedByTheirFirstBytes) {
    int id = 0;
    const std::string path = folder_ / "hdf5.nc";
    ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER | NC_NETCDF4, &id), NC_NOERR);
    nc_close(id);
    expect_error(path, ExitCode::bad_file, "this is no netCDF classic file");
    for (const char* bytes : {"", "CD", "CDF\3", "CDF\6 and so on", "\x89HDF\r\n\x1a\n"}) {
        expect_error(folder_.write("bytes.nc", bytes), ExitCode::bad_file, "this is no netCDF classic file");
    }
}

TEST_F(ForeignResults, HoldWhatTheirHeaderTells) {
    constexpr std::size_t records = 4, dimension_count = 12;  // where they stand
    for (const std::uint32_t count : {4u, 1000u, 300'000'000u, 0x7fffffffu, 0xffffffffu}) {
        expect_error(with_number(records, count), ExitCode::bad_file, "more than the file of");
    }
    const std::string path = write(3), whole = read_file(path);
    // A column that begins far behind the end; offsets are of 64 bits, the last in the header of 'turn'.
    const std::size_t begin = whole.rfind("turn") + 4 + 4 + 4;
    expect_error(with_number(begin, 0x07000000u), ExitCode::bad_file, "more than the file of");
    for (const std::uint32_t count : {0x7fffffffu, 0xffffffffu}) {
        expect_error(with_number(dimension_count, count), ExitCode::bad_file, "header is damaged");
    }
    EXPECT_EQ(read_result(with_number(records, 3)).values[0].size(), 3u);
    EXPECT_EQ(read_result(with_number(records, 2)).values[0].size(), 2u);
}

TEST_F(ForeignResults, MayBeCutOrDamagedAnywhere) {
    const std::string whole = read_file(write(3, {{scene_attribute, scene("false")}}));
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const int damage : {-1, 0x01, 0x80, 0xff}) {
            std::string bytes = damage < 0 ? whole.substr(0, i) : whole;
            if (damage >= 0) bytes[i] = static_cast<char>(bytes[i] ^ damage);
            const std::string path = folder_.write("damaged.nc", bytes);
            try {
                EXPECT_LE(read_result(path).values[0].size(), 3u) << i;
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), testing::HasSubstr("damaged.nc")) << i;
            }
        }
    }
}

TEST_F(ForeignResults, OfARoadHoldItsTiles) {
    const std::string path = write(2, {{scene_attribute, scene("true")}});
    write_tiles(tiles_beside(path), {{0, 0, std::vector<float>(65 * 65)}});
    std::string bytes = read_file(tiles_beside(path));
    bytes[bytes.find("tile") + 4] = 0x7f;  // the dimension's length stands behind its name
    folder_.write("results.road", bytes);
    expect_error(path, ExitCode::bad_file, "header asks for more than the file holds");
}

// Records in the place of two dimensions: the shape told of 65 times what was read.
TEST_F(ForeignResults, OfARoadHaveRecordsOnlyOnce) {
    const std::string path = write(2, {{scene_attribute, scene("true")}});
    int id = 0, tile = 0, two = 0, index = 0, height = 0;
    ASSERT_EQ(nc_create(tiles_beside(path).c_str(), NC_CLOBBER, &id), NC_NOERR);
    nc_def_dim(id, "tile", NC_UNLIMITED, &tile), nc_def_dim(id, "two", 2, &two);
    const std::array<int, 2> pair{tile, two};
    nc_def_var(id, "index", NC_INT, 2, pair.data(), &index);
    nc_def_var(id, "height", NC_FLOAT, 2, pair.data(), &height);
    nc_close(id);
    std::string bytes = read_file(tiles_beside(path));
    const std::size_t dimensions = bytes.find("height") + 6 + 2 + 4;
    for (std::size_t i = 0; i < 4; ++i) bytes[dimensions + 4 + i] = 0;  // the first dimension again
    folder_.write("results.road", bytes);
    expect_error(path, ExitCode::bad_file, "records are a variable's first dimension");
}

TEST_F(ForeignResults, LackNoByteOfTheirLastNumber) {
    const std::string whole = read_file(write(3));
    for (std::size_t cut = 1; cut <= 3; ++cut) {
        expect_error(folder_.write("cut.nc", whole.substr(0, whole.size() - cut)), ExitCode::bad_file,
                     "more than the file of");
    }
}

TEST_F(ForeignResults, HaveAShallowSceneWithARoadThatIsOneOrNot) {
    std::string text = scene("false");
    text.insert(1, "\"x\": " + std::string(100'000, '[') + std::string(100'000, ']') + ", ");
    expect_error(write(2, {{scene_attribute, text}}), ExitCode::bad_file, "nested 64 deep at most");
    for (const char* uneven : {"\"x\"", "1", "null", "[]"}) {
        expect_error(write(2, {{scene_attribute, scene(uneven)}}), ExitCode::bad_file, "'uneven'");
    }
}

TEST(ResultFile, ReadsBackWhatChannelsAreAndWhoseTheyAre) {
    const TemporaryFolder folder;
    const std::vector<Column> described{{"a.pose.x", "m", "", ChannelRole::pose_x, "a"}, {"b", "1", ""}};
    const auto file = open_netcdf(folder / "r.nc", described, "t");
    file->write(0, std::vector<double>{1, 2});
    file->close();
    const ResultFile read = read_result(folder / "r.nc");
    ASSERT_EQ(read.columns.size(), 3u);
    EXPECT_EQ(read.columns[1].role, ChannelRole::pose_x);
    EXPECT_EQ(read.columns[1].of, "a");
    EXPECT_EQ(read.columns[2].role, ChannelRole::none);
}

}  // namespace
}  // namespace hamilcar::io
