// What the program leaves on the disk, and what it leaves alone: a full disk, a kill, folders that somebody else writes into, links.
#include <gmock/gmock.h>

#include "cli/endings.hpp"
#include "hamilcar/io/folder_lock.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string car = test::source_path("vehicles/bmw_323i.toml");

// A file that may not grow is like a full disk.
TEST_F(Endings, OnAFullDiskLeaveWholeRows) {
    const std::string scenario = scenario_for(car, "[output]\ninterval_s = 0.001\n");
    const std::string command = "cd '" + folder_.string() + "' && ulimit -f 600 && '" + test::program_path() +
                                "' run " + scenario + " -o results >out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 5);
    EXPECT_THAT(contents(folder_ / "err.txt"), HasSubstr("cannot write row at t = "));
    EXPECT_THAT(contents(folder_ / "err.txt"), HasSubstr("File too large"));
    EXPECT_EQ(run("view results/results.nc -o page.html").code, 0);
    const std::string rows = contents(folder_ / "results/results.csv");
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.back(), '\n');
    EXPECT_EQ(std::ranges::count(rows.substr(0, rows.find('\n')), ','),
              std::ranges::count(rows.substr(rows.rfind('\n', rows.size() - 2) + 1), ','));
    EXPECT_FALSE(fs::exists(folder_ / "results/summary.json"));  // that of a whole run
}

// A kill within a write, one in a hundred, leaves a last row without its line end in the CSV (docs/endings.md).
TEST_F(Endings, ByAKillLeaveWholeRows) {
    const std::string scenario = scenario_for(car);
    std::string text = contents(scenario);
    text.replace(text.find("duration_s = 1.0"), 16, "duration_s = 1e5");
    std::ofstream(scenario) << text;
    const pid_t child =
        start({"run", scenario, "-o", "results", "--checkpoint", "state", "--checkpoint-interval", "2"});
    const fs::path csv = folder_ / "results/results.csv";
    for (int i = 0; i < 6000 && (!fs::exists(csv) || fs::file_size(csv) < 400'000); ++i) usleep(5000);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const std::string rows = contents(csv);
    ASSERT_GT(rows.size(), 300'000u);
    const auto commas = [&](std::size_t from, std::size_t to) {
        return std::ranges::count(std::string_view(rows).substr(from, to - from), ',');
    };
    const std::size_t first = rows.find('\n');
    std::size_t end = first;
    for (std::size_t next; (next = rows.find('\n', end + 1)) != std::string::npos; end = next) {
        ASSERT_EQ(commas(end, next), commas(0, first)) << rows.substr(end + 1, next - end - 1);
    }
    EXPECT_LE(commas(end, rows.size()), commas(0, first));
    EXPECT_EQ(run("view results/results.nc -o page.html").code, 0);
    for (const auto& entry : fs::directory_iterator(folder_ / "results")) {
        EXPECT_THAT(entry.path().filename().string(), testing::AnyOf("results.csv", "results.nc"));
    }
}

TEST_F(Endings, LeaveNothingOfAnEarlierRun) {
    const std::string scenario = scenario_for(car);
    ASSERT_EQ(run("run " + scenario + " -o results").code, 0);
    std::string text = contents(scenario);
    text.replace(text.find("duration_s = 1.0"), 16, "duration_s = 1e5");
    std::ofstream(scenario) << text;
    fs::remove(folder_ / "results/results.nc");
    const pid_t child = start({"run", scenario, "-o", "results"});
    EXPECT_TRUE(appears("results/results.nc"));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(fs::exists(folder_ / "results/summary.json"));
    EXPECT_FALSE(fs::exists(folder_ / "results/report.html"));
}

TEST_F(Endings, OfARunInAFolderThatAnotherOneHolds) {
    fs::create_directories(folder_ / "results");
    const std::string scenario = scenario_for(car);
    {
        const io::FolderLock another((folder_ / "results").string());
        for (const std::string& words :
             {"run " + scenario + " -o results", std::string("run --maneuver cleat -o results"),
              std::string("paper -o results")}) {
            const Outcome r = run(words);
            EXPECT_EQ(r.code, 5) << words;
            EXPECT_THAT(r.err, HasSubstr("results: another run is writing into this folder")) << words;
        }
        EXPECT_TRUE(fs::is_empty(folder_ / "results"));
    }
    EXPECT_EQ(run("run " + scenario + " -o results").code, 0);
}

TEST_F(Endings, DoNotWriteThroughLinks) {
    std::ofstream(folder_ / "victim") << "precious";
    const std::string scenario = scenario_for(car);
    for (const char* name : {"results.csv", "results.nc", "summary.json", "report.html"}) {
        fs::remove_all(folder_ / "results");
        fs::create_directories(folder_ / "results");
        fs::create_symlink("../victim", folder_ / "results" / name);
        run("run " + scenario + " -o results");
        EXPECT_EQ(contents(folder_ / "victim"), "precious") << name;
    }
    fs::create_symlink("victim", folder_ / "page.html");
    EXPECT_EQ(run("view results/results.nc -o page.html").code, 5);
    fs::create_symlink("victim", folder_ / "state");
    EXPECT_EQ(run("run " + scenario + " -o results --checkpoint state").code, 5);
    EXPECT_EQ(contents(folder_ / "victim"), "precious");
}

}  // namespace
}  // namespace hamilcar
