// Result files hold exactly what was written, say when the disk is full, and stay readable when the program dies.
#include "hamilcar/io/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <csignal>
#include <cstring>
#include <limits>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<Column> columns{{"chassis.position.x", "m", "position of the chassis along ground x"},
                                  {"front_left.slip", "1", "longitudinal slip"}};

enum class Format { csv, netcdf };

std::unique_ptr<ResultWriter> open_results(Format format, const std::string& path) {
    return format == Format::csv ? open_csv(path, columns) : open_netcdf(path, columns, "a test");
}

void write_rows(ResultWriter& file, int from, int to) {
    for (int i = from; i < to; ++i) file.write(0.01 * i, std::vector<double>{1.0 / (i + 1), -2.0 * i});
}

struct Table {
    std::vector<double> time, x, slip;
};

Table read_csv(const std::string& path) {
    Table table;
    std::istringstream lines(read_file(path));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "time [s],chassis.position.x [m],front_left.slip [1]");
    while (std::getline(lines, line)) {
        double time = 0, x = 0, slip = 0;
        int used = 0;
        EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf%n", &time, &x, &slip, &used), 3) << line;
        EXPECT_EQ(static_cast<std::size_t>(used), line.size()) << line;
        table.time.push_back(time), table.x.push_back(x), table.slip.push_back(slip);
    }
    return table;
}

class NetcdfFile {
public:
    explicit NetcdfFile(const std::string& path) { EXPECT_EQ(nc_open(path.c_str(), NC_NOWRITE, &file_), NC_NOERR); }
    ~NetcdfFile() { nc_close(file_); }
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    std::vector<double> values(const char* name) const {
        int dimension = 0, unlimited = 0, variable = 0;
        std::size_t length = 0;
        EXPECT_EQ(nc_inq_dimid(file_, "time", &dimension), NC_NOERR);
        EXPECT_EQ(nc_inq_unlimdim(file_, &unlimited), NC_NOERR);
        EXPECT_EQ(dimension, unlimited);
        EXPECT_EQ(nc_inq_dimlen(file_, dimension, &length), NC_NOERR);
        EXPECT_EQ(nc_inq_varid(file_, name, &variable), NC_NOERR) << name;
        std::vector<double> result(length);
        EXPECT_EQ(nc_get_var_double(file_, variable, result.data()), NC_NOERR);
        return result;
    }
    // Of a variable, or of the file if the name is empty.
    std::string text(const char* name, const char* attribute) const {
        int variable = NC_GLOBAL;
        std::size_t length = 0;
        EXPECT_TRUE(*name == '\0' || nc_inq_varid(file_, name, &variable) == NC_NOERR) << name;
        EXPECT_EQ(nc_inq_attlen(file_, variable, attribute, &length), NC_NOERR);
        std::string result(length, ' ');
        EXPECT_EQ(nc_get_att_text(file_, variable, attribute, result.data()), NC_NOERR);
        return result;
    }
    int format() const {
        int format = 0;
        EXPECT_EQ(nc_inq_format(file_, &format), NC_NOERR);
        return format;
    }

private:
    int file_ = 0;
};

Table read_results(Format format, const std::string& path) {
    if (format == Format::csv) return read_csv(path);
    const NetcdfFile file(path);
    return {file.values("time"), file.values("chassis.position.x"), file.values("front_left.slip")};
}

void expect_rows(const Table& table, std::size_t count) {
    ASSERT_EQ(table.time.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto n = static_cast<double>(i);
        EXPECT_EQ(table.time[i], 0.01 * n);
        EXPECT_EQ(table.x[i], 1.0 / (n + 1));
        EXPECT_EQ(table.slip[i], -2.0 * n);
    }
}

class Results : public testing::TestWithParam<Format> {
protected:
    TemporaryFolder folder;
    std::string path = folder / "results";
};

TEST_P(Results, HoldEveryRowToTheLastBit) {
    const auto file = open_results(GetParam(), path);
    write_rows(*file, 0, 1000);
    file->close();
    expect_rows(read_results(GetParam(), path), 1000);
}

TEST_P(Results, CanBeReadAfterEveryFlush) {
    const auto file = open_results(GetParam(), path);
    for (int rows = 0; rows < 900; rows += 300) {
        write_rows(*file, rows, rows + 300);
        file->flush();
        expect_rows(read_results(GetParam(), path), static_cast<std::size_t>(rows) + 300);
    }
}

TEST_P(Results, WithoutRowsAreAnEmptyTable) {
    open_results(GetParam(), path)->close();
    expect_rows(read_results(GetParam(), path), 0);
}

TEST_P(Results, AreCompletedWhenTheWriterGoesAway) {
    {
        const auto file = open_results(GetParam(), path);
        write_rows(*file, 0, 10);
    }
    expect_rows(read_results(GetParam(), path), 10);
}

TEST_P(Results, SurviveTheDeathOfTheProgramUpToTheLastFlush) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const auto file = open_results(GetParam(), path);
        write_rows(*file, 0, 700);
        file->flush();
        write_rows(*file, 700, 900);
        kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    expect_rows(read_results(GetParam(), path), 700);
}

TEST_P(Results, NeedAFolderThatExists) {
    expect_error([&] { open_results(GetParam(), folder / "nonesuch/results"); }, ExitCode::input_output,
                 {folder / "nonesuch/results: cannot open for writing: No such file or directory"});
    expect_error([&] { open_results(GetParam(), folder / "."); }, ExitCode::input_output,
                 {folder / ".: cannot write: Is a directory"});
}

// A file that may not grow beyond some size is a disk that fills up during the run.
TEST_P(Results, KeepTheRowsFromBeforeTheDiskFilledUp) {
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto file = open_results(GetParam(), path);
    write_rows(*file, 0, 500);
    file->flush();
    const rlimit small{20000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    expect_error(
        [&] {
            write_rows(*file, 500, 5000);
            file->close();
        },
        ExitCode::input_output, {path + ": cannot write row at t = ", " s: File too large"});
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, previous);
    const Table table = read_results(GetParam(), path);
    EXPECT_GE(table.time.size(), 500u);
    expect_rows(table, table.time.size());
}

INSTANTIATE_TEST_SUITE_P(BothFormats, Results, testing::Values(Format::csv, Format::netcdf),
                         [](const auto& test) { return test.param == Format::csv ? "Csv" : "Netcdf"; });

TEST(Csv, WritesTheShortestNumbersThatReadBack) {
    const TemporaryFolder folder;
    const auto file = open_csv(folder / "r.csv", columns);
    file->write(0.1, std::vector<double>{1e-300, -0.0});
    file->write(1.0 / 3, std::vector<double>{std::numeric_limits<double>::quiet_NaN(), 123456789});
    file->close();
    EXPECT_EQ(read_file(folder / "r.csv"),
              "time [s],chassis.position.x [m],front_left.slip [1]\n0.1,1e-300,-0\n0.3333333333333333,nan,123456789\n");
}

TEST(Csv, QuotesHeadingsThatNeedIt) {
    const TemporaryFolder folder;
    open_csv(folder / "r.csv", {{"a,b", "m", ""}, {"say \"c\"", "1", ""}})->close();
    EXPECT_EQ(read_file(folder / "r.csv"), "time [s],\"a,b [m]\",\"say \"\"c\"\" [1]\"\n");
}

TEST(Csv, SaysWhenTheDiskIsFull) {
    const TemporaryFolder folder;
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{10, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    expect_error([&] { open_csv(folder / "r.csv", columns); }, ExitCode::input_output,
                 {folder / "r.csv: cannot write the headings: File too large"});
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, previous);
}

TEST(Csv, NamesTheFirstRowThatWasLost) {
    const TemporaryFolder folder;
    const auto previous = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto file = open_csv(folder / "r.csv", columns);
    file->write(1.23, std::vector<double>{1, 2});
    file->write(1.25, std::vector<double>{3, 4});
    const rlimit small{63, before.rlim_max};  // the headings take 52 bytes, a row 9: the second does not fit
    setrlimit(RLIMIT_FSIZE, &small);
    expect_error([&] { file->flush(); }, ExitCode::input_output,
                 {folder / "r.csv: cannot write row at t = 1.25 s: File too large"});
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, previous);
    EXPECT_EQ(read_file(folder / "r.csv"), "time [s],chassis.position.x [m],front_left.slip [1]\n1.23,1,2\n");
}

TEST(Netcdf, DescribesItself) {
    const TemporaryFolder folder;
    open_netcdf(folder / "r.nc", columns, "step steer")->close();
    const NetcdfFile file(folder / "r.nc");
    EXPECT_EQ(file.format(), NC_FORMAT_64BIT_OFFSET);
    EXPECT_EQ(file.text("", "title"), "step steer");
    EXPECT_THAT(file.text("", "source"), HasSubstr("Hamilcar"));
    EXPECT_EQ(file.text("time", "units"), "s");
    EXPECT_EQ(file.text("chassis.position.x", "units"), "m");
    EXPECT_EQ(file.text("chassis.position.x", "long_name"), "position of the chassis along ground x");
    EXPECT_EQ(file.text("front_left.slip", "units"), "1");
}

// The library would delete a device that it cannot write to.
TEST(Netcdf, LeavesAloneWhatIsNoRegularFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    expect_error([&] { open_netcdf(folder / "pipe", columns, ""); }, ExitCode::input_output,
                 {folder / "pipe: cannot write: is a pipe, expected a regular file"});
    EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

TEST_P(Results, AreNotWrittenThroughALink) {
    folder.write("victim", "precious");
    std::filesystem::create_symlink("victim", folder / "link");
    expect_error([&] { open_results(GetParam(), folder / "link"); }, ExitCode::input_output,
                 {folder / "link: cannot write: is a link, expected a regular file"});
    EXPECT_EQ(read_file(folder / "victim"), "precious");
}

TEST(Netcdf, RefusesANameTheFormatCannotHold) {
    const TemporaryFolder folder;
    expect_error(
        [&] {
            open_netcdf(folder / "r.nc", {{"a/b", "m", ""}}, "");
        },
        ExitCode::input_output, {"cannot define a/b"});
    expect_error(
        [&] {
            open_netcdf(folder / "r.nc", {{"a", "m", ""}, {"a", "m", ""}}, "");
        },
        ExitCode::input_output, {"cannot define a: another has this name"});
    EXPECT_FALSE(std::filesystem::exists(folder / "r.nc"));
}

}  // namespace
}  // namespace hamilcar::io
