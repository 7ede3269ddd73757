// Runs that end by force and are gone on with: what is on the disk stays, and the results are those of one run.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <tuple>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string car = test::source_path("vehicles/bmw_323i.toml");

class Resume : public Program {
protected:
    // A driver on a bent path; `duration` in whole seconds.
    std::string driven(const std::string& name, int duration, const std::string& more = "report = false\n",
                       const std::string& speed = "14.0") const {
        const fs::path path = folder_ / name;
        std::ofstream(path) << "name = \"t\"\nvehicle = \"" << car << "\"\nduration_s = " << duration
                            << ".0\n[initial]\nvelocity_m_per_s = 10.0\n[driver.speed]\nspeed_m_per_s = " << speed
                            << "\n[driver.gear]\nchoice = \"automatic\"\n[driver.path]\nx_m = [0.0, 10.0, 40.0]\n"
                            << "y_m = [0.0, 0.0, 2.0]\n[output]\n"
                            << more;
        return path.string();
    }
    // Files that were begun and took no place.
    long halves_in(const std::string& folder) const {
        const fs::directory_iterator all(folder_ / folder);
        return std::count_if(fs::begin(all), fs::end(all),
                             [](const auto& entry) { return entry.path().extension() == ".part"; });
    }
    // Ends the program by `signal` as soon as `when` comes true; its status, as waitpid gives it.
    template <class When>
    int run_until(const std::vector<std::string>& words, int signal, When&& when) const {
        std::vector<char*> list{const_cast<char*>("hamilcar")};
        for (const std::string& word : words) list.push_back(const_cast<char*>(word.c_str()));
        list.push_back(nullptr);
        const pid_t child = fork();
        if (child == 0) {
            if (chdir(folder_.c_str()) != 0 || !freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr)) {
                _exit(99);
            }
            execv(test::program_path().c_str(), list.data());
            _exit(99);
        }
        int status = 0;
        for (int i = 0; i < 100000 && !when(); ++i) {
            if (waitpid(child, &status, WNOHANG) == child) return status;
            usleep(200);
        }
        kill(child, signal);
        waitpid(child, &status, 0);
        return status;
    }
    // With files of at most `blocks` of 512 bytes.
    Outcome run_limited(int blocks, const std::string& words) const {
        const std::string command = "cd '" + folder_.string() + "' && (ulimit -f " + std::to_string(blocks) + "; '" +
                                    test::program_path() + "' " + words + " >/dev/null 2>err.txt)";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", contents(folder_ / "err.txt")};
    }
    std::string in(const char* name) const { return contents(folder_ / name); }
};

TEST_F(Resume, AfterAKillGivesTheSameBytes) {
    const std::string scenario = driven("scenario.toml", 100);
    ASSERT_EQ(run("run " + scenario + " -o whole").code, 0);
    // The fifth checkpoint, at t = 1.48 s: rows are on their way to the disk by then, and not all are due there.
    std::string last;
    int written = 0;
    const auto fifth = [&] {
        const std::string now = in("state");
        if (!now.empty() && now != last) last = now, ++written;
        return written >= 5;
    };
    const int status = run_until(
        {"run", scenario, "-o", "parts", "--checkpoint", "state", "--checkpoint-interval", "0.37"}, SIGKILL, fifth);
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_NE(in("parts/results.nc"), in("whole/results.nc"));
    const Outcome r = run("run " + scenario + " -o parts --resume state");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(in("parts/results.csv"), in("whole/results.csv"));
    EXPECT_EQ(in("parts/results.nc"), in("whole/results.nc"));
    EXPECT_EQ(halves_in("parts"), 0);
}

TEST_F(Resume, KeepsTheFirstPartWhereTheDiskIsFull) {
    ASSERT_EQ(run("run " + driven("first.toml", 2) + " -o parts --checkpoint state").code, 0);
    const std::string table = in("parts/results.csv"), binary = in("parts/results.nc"), state = in("state");
    const Outcome r = run_limited(200, "run " + driven("scenario.toml", 3) + " -o parts --resume state");
    EXPECT_EQ(r.code, 5) << r.err;
    EXPECT_THAT(r.err, HasSubstr("cannot write row at t ="));
    EXPECT_EQ(in("parts/results.csv"), table);
    EXPECT_EQ(in("parts/results.nc"), binary);
    EXPECT_EQ(halves_in("parts"), 0);
    EXPECT_EQ(run("run " + driven("scenario.toml", 3) + " -o parts --resume state").code, 0);
}

TEST_F(Resume, RefusesWhatDoesNotFit) {
    ASSERT_EQ(run("run " + driven("scenario.toml", 2) + " -o parts --checkpoint state").code, 0);
    const std::string results = in("parts/results.nc");
    const std::string few = "report = false\nchannels = [\"chassis.velocity.*\"]\nmotion = false\n";
    const std::string words = " -o parts --resume state";
    for (const auto& [scenario, more, what] : std::vector<std::array<std::string, 3>>{
             {driven("speed.toml", 2, "report = false\n", "15.0"), "", "of another scenario"},
             {driven("channels.toml", 2, few), "", "has the channel 'chassis.position.x' where this run records"},
             {driven("rows.toml", 2, "report = false\ninterval_s = 0.02\n"), "",
              "has a row at t = 0.01 s where this run"},
             {driven("short.toml", 1), "", "after the end"},
             {driven("none.toml", 2, "netcdf = false\n"), "", "expects 'output.netcdf = true'"},
             {driven("step.toml", 2), " --step 5e-4", "of another step (0.001 s)"},
             {driven("heavy.toml", 2),
              " --vehicle " +
                  changed("vehicles/bmw_323i.toml", "carcass_damping_s = 0.004", "carcass_damping_s = 0.005"),
              "of another vehicle"}}) {
        const Outcome r = run("run " + scenario + words + more);
        EXPECT_THAT(r.err, HasSubstr(what));
        EXPECT_TRUE(r.code == 3 || r.code == 2) << r.code;
        EXPECT_EQ(in("parts/results.nc"), results);
    }
    // Longer, and with other files: the same run.
    EXPECT_EQ(run("run " + driven("longer.toml", 3, "csv = false\n") + words).code, 0);
}

TEST_F(Resume, RefusesAFileThatTheRunDependsOnOnceItHasChanged) {
    std::ofstream(folder_ / "path.csv") << "x [m],y [m]\n0,0\n10,0\n40,2\n";
    const std::string text =
        "name = \"t\"\nvehicle = \"" + car +
        "\"\nduration_s = 1.0\n[initial]\nvelocity_m_per_s = 10.0\n[driver.path]\nfile = \"path.csv\"\n";
    std::ofstream(folder_ / "scenario.toml") << text;
    const Outcome first = run("run scenario.toml -o parts --checkpoint state");
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(run("run scenario.toml -o parts --resume state").code, 0);
    std::ofstream(folder_ / "path.csv") << "x [m],y [m]\n0,0\n10,0\n40,3\n";
    EXPECT_THAT(run("run scenario.toml -o parts --resume state").err, HasSubstr("of another scenario"));
}

TEST_F(Resume, TellsOfACheckpointThatCannotBeWrittenBeforeTheRun) {
    const std::string scenario = driven("scenario.toml", 1);
    const std::string text = in("scenario.toml");
    for (const auto& [place, code, what] : std::vector<std::tuple<std::string, int, std::string>>{
             {"nowhere/state", 5, "No such file"},
             {".", 5, "cannot write: Is a directory"},
             {"scenario.toml", 2, "is there and is no checkpoint"}}) {
        const Outcome r = run("run " + scenario + " -o results --checkpoint " + place);
        EXPECT_EQ(r.code, code) << r.err;
        EXPECT_THAT(r.err, HasSubstr(what));
        EXPECT_FALSE(fs::exists(folder_ / "results/results.nc")) << place;
    }
    EXPECT_EQ(in("scenario.toml"), text);
    EXPECT_FALSE(fs::exists(folder_ / "..part"));
    const std::string without = driven("none.toml", 1, "netcdf = false\n");
    const Outcome r = run("run " + without + " -o results --checkpoint state");
    EXPECT_EQ(r.code, 2);
    EXPECT_THAT(r.err, HasSubstr("none.toml:"));
    EXPECT_FALSE(fs::exists(folder_ / "state"));
}

TEST_F(Resume, RefusesNumbersThatAreNone) {
    const std::string scenario = driven("scenario.toml", 1);
    for (const char* words : {" --step nan", " --checkpoint state --checkpoint-interval nan",
                              " --checkpoint-interval 1", " --checkpoint state --checkpoint-interval 0"}) {
        EXPECT_EQ(run("run " + scenario + words).code, 2) << words;
    }
    EXPECT_EQ(run("modes " + car + " --speed nan").code, 2);
}

TEST_F(Resume, TellsWhatEndedTheRun) {
    std::ofstream(driven("scenario.toml", 20), std::ios::app) << "[driver.ending]\ndistance_m = 30.0\n";
    const Outcome r = run("run " + (folder_ / "scenario.toml").string() + " -o results");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("ended by         distance reached 30"));
    const auto facts = nlohmann::json::parse(in("results/summary.json"));
    EXPECT_THAT(facts["ended_by"].get<std::string>(), HasSubstr("distance reached 30"));
    EXPECT_TRUE(facts["warnings"].empty());
    std::ofstream(folder_ / "bend.toml") << "name = \"t\"\nvehicle = \"" << car
                                         << "\"\nduration_s = 2.0\n[initial]\nvelocity_m_per_s = 20.0\n"
                                         << "[driver.path]\nx_m = [0.0, 10.0, 20.0]\ny_m = [0.0, 0.0, 9.0]\n";
    ASSERT_EQ(run("run bend.toml -o page --json").code, 0);
    const auto far = nlohmann::json::parse(in("page/summary.json"));
    EXPECT_TRUE(far["ended_by"].is_null());
    ASSERT_FALSE(far["warnings"].empty());
    EXPECT_THAT(far["warnings"][0].get<std::string>(), HasSubstr("off the path"));
    EXPECT_THAT(in("page/report.html"), HasSubstr("driver warning"));
}

TEST_F(Resume, AManeuverThatIsInterruptedDoesNotReplaceAWholeOne) {
    const std::string words = "run --maneuver weave --vehicle " + car + " -o drive";
    const std::vector<std::string> list{"run", "--maneuver", "constant_radius", "--vehicle", car, "-o", "drive"};
    const auto began = std::chrono::steady_clock::now();
    const auto soon = [&] { return std::chrono::steady_clock::now() - began > std::chrono::milliseconds(300); };
    const int status = run_until(list, SIGTERM, soon);
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_EQ(WEXITSTATUS(status), 130) << in("err.txt");
    EXPECT_THAT(in("err.txt"), HasSubstr("interrupted"));
    const auto part = nlohmann::json::parse(in("drive/outcome.json"));
    EXPECT_TRUE(part["interrupted"]);
    EXPECT_FALSE(part["passed"]);
    ASSERT_EQ(run(words).code, 0);
    const std::string whole = in("drive/outcome.json"), replay = in("drive/drive.nc");
    EXPECT_FALSE(nlohmann::json::parse(whole)["interrupted"]);
    const auto again = std::chrono::steady_clock::now();
    const int second = run_until(
        list, SIGTERM, [&] { return std::chrono::steady_clock::now() - again > std::chrono::milliseconds(300); });
    EXPECT_EQ(WEXITSTATUS(second), 130);
    EXPECT_THAT(in("err.txt"), HasSubstr("stays that of the whole drive before"));
    EXPECT_EQ(in("drive/outcome.json"), whole);
    EXPECT_EQ(in("drive/drive.nc"), replay);
}

// The row of the checkpoint's instant is due in both parts.
TEST_F(Resume, GoesOnTwiceWithARowEveryStep) {
    const std::string rows = "report = false\ninterval_s = 0.001\n";
    ASSERT_EQ(run("run " + driven("s.toml", 1, rows) + " -o parts --checkpoint state").code, 0);
    ASSERT_EQ(run("run " + driven("s.toml", 2, rows) + " -o parts --resume state --checkpoint state").code, 0);
    const Outcome third = run("run " + driven("s.toml", 3, rows) + " -o parts --resume state");
    ASSERT_EQ(third.code, 0) << third.err;
    ASSERT_EQ(run("run " + driven("s.toml", 3, rows) + " -o whole").code, 0);
    EXPECT_EQ(in("parts/results.csv"), in("whole/results.csv"));
}

TEST_F(Resume, KeepsTheCheckpointFromBeforeTheMathematicsGaveUp) {
    const Outcome failed =
        run("run " + driven("s.toml", 2) + " -o parts --step 0.02 --checkpoint state --checkpoint-interval 0.02");
    ASSERT_EQ(failed.code, 4) << failed.err;
    const Outcome again = run("run " + driven("s.toml", 2) + " -o parts --step 0.02 --resume state");
    EXPECT_EQ(again.code, 4) << again.err;
    EXPECT_THAT(again.err, testing::Not(HasSubstr("damaged")));
}

TEST_F(Resume, LeavesNoHalvesWhereItIsRefusedOrWasKilled) {
    ASSERT_EQ(run("run " + driven("s.toml", 1) + " -o parts --checkpoint state").code, 0);
    std::ofstream(folder_ / "parts/results.nc.0123456789abcdef.part") << "of a run that was killed";
    ASSERT_EQ(run("run " + driven("s.toml", 2) + " -o parts --resume state").code, 0);
    EXPECT_EQ(halves_in("parts"), 0);
    fs::remove(folder_ / "parts/results.csv");
    fs::create_symlink("s.toml", folder_ / "parts/results.csv");
    EXPECT_EQ(run("run " + driven("s.toml", 2) + " -o parts --resume state").code, 5);
    EXPECT_EQ(halves_in("parts"), 0);
}

TEST_F(Resume, AManeuversFiguresComeBeforeItsReplay) {
    ASSERT_EQ(run("run --maneuver weave --vehicle " + car + " -o drive").code, 0);
    const auto size = [&](const char* name) { return static_cast<int>(fs::file_size(folder_ / name)); };
    ASSERT_GT(size("drive/drive.nc"), size("drive/outcome.json") + 2048);
    const int blocks = size("drive/outcome.json") / 512 + 2;
    const Outcome r = run_limited(blocks, "run --maneuver weave --vehicle " + car + " --set speed=90 -o drive");
    EXPECT_EQ(r.code, 5) << r.err;
    const auto facts = nlohmann::json::parse(in("drive/outcome.json"));
    EXPECT_EQ(facts["settings"][0]["value"], 90);
    EXPECT_FALSE(fs::exists(folder_ / "drive/report.html")) << "of the drive before";
    const std::string kept = in("drive/outcome.json");
    const Outcome fuller = run_limited(4, "run --maneuver weave --vehicle " + car + " --set speed=95 -o drive");
    EXPECT_EQ(fuller.code, 5);
    EXPECT_EQ(in("drive/outcome.json"), kept);
}

}  // namespace
}  // namespace hamilcar
