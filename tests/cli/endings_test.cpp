// How the program ends when the world around it is not as it should be: streams that take nothing, signals, folders that
// somebody else writes into, links, names of any bytes, a simulation that went wrong.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "hamilcar/io/folder_lock.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string car = test::source_path("vehicles/bmw_323i.toml");
const std::string level_road = test::source_path("scenarios/slalom.toml");

class Endings : public Program {
protected:
    // With standard output as a shell says it, ">&-" or ">/dev/full".
    Outcome run_into(const std::string& output, const std::string& words) const {
        const std::string command =
            "cd '" + folder_.string() + "' && '" + test::program_path() + "' " + words + " 2>err.txt " + output;
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), "", contents(folder_ / "err.txt")};
    }
    pid_t start(std::vector<std::string> words) const {
        const pid_t child = fork();
        if (child != 0) return child;
        std::vector<char*> arguments;
        words.insert(words.begin(), "hamilcar");
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        if (chdir(folder_.c_str()) != 0 || !freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr)) {
            _exit(99);
        }
        execv(test::program_path().c_str(), arguments.data());
        _exit(99);
    }
    // The exit code, or -1 if it has not ended within the time.
    static int code_within(pid_t child, std::chrono::milliseconds time) {
        const auto until = std::chrono::steady_clock::now() + time;
        int status = 0;
        while (waitpid(child, &status, WNOHANG) == 0) {
            if (std::chrono::steady_clock::now() > until) {
                kill(child, SIGKILL);
                waitpid(child, &status, 0);
                return -1;
            }
            usleep(1000);
        }
        return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
    }
    // Until the program catches signals, which takes it long where sanitizers look on.
    static void wait_for_its_handler(pid_t child) {
        const fs::path status = "/proc/" + std::to_string(child) + "/status";
        for (int i = 0; i < 2000; ++i) {
            const std::string text = contents(status), caught = "SigCgt:\t";
            const std::size_t at = text.find(caught);
            if (at == text.npos) return;
            if (std::stoull(text.substr(at + caught.size(), 16), nullptr, 16) >> (SIGINT - 1) & 1) return;
            usleep(5000);
        }
    }
    bool appears(const std::string& name) const {
        for (int i = 0; i < 2000 && !fs::exists(folder_ / name); ++i) usleep(5000);
        return fs::exists(folder_ / name);
    }
};

TEST_F(Endings, OnAStandardOutputThatTakesNothingAreErrors) {
    for (const std::string& words :
         {"check " + car, "check --json " + car, std::string("schema vehicle"), std::string("maneuvers"),
          std::string("--version"), std::string("--help"), "run " + scenario_for(car) + " -o full"}) {
        const Outcome full = run_into(">/dev/full", words), closed = run_into(">&-", words);
        EXPECT_EQ(full.code, 5) << words;
        EXPECT_THAT(full.err, HasSubstr("No space left on device")) << words;
        EXPECT_EQ(closed.code, 5) << words;
        EXPECT_THAT(closed.err, HasSubstr("standard output is closed")) << words;
    }
    EXPECT_TRUE(fs::exists(folder_ / "full/results.nc"));  // what is written is not lost for it
    EXPECT_TRUE(fs::exists(folder_ / "full/summary.json"));
}

TEST_F(Endings, BySignalComeWithinASecondFromEveryCommand) {
    const std::string big = folder_ / "big.toml", rough = test::source_path("scenarios/rough_road.toml");
    std::ofstream(big) << "a = [" << [] {
        std::string numbers;
        while (numbers.size() < 3'900'000) numbers += "1,";
        return numbers;
    }() << "]\n";
    const std::vector<std::vector<std::string>> commands{
        {"bench", "--seconds", "60"},
        {"check", big},
        {"road", rough, "--length", "20000"},
        {"tire", test::source_path("vehicles/tires/pacejka_205_60_r15.tir")},
        {"schema", "vehicle"},
        {"modes", test::source_path("vehicles/truck_semitrailer.toml")},
        {"run", "--maneuver", "random_steer", "-o", "m"},
        {"paper", "-o", "p"},
        {"drive", "--no-browser"}};
    int heard = 0;
    for (const auto& words : commands) {
        for (const int signal : {SIGINT, SIGTERM}) {
            const pid_t child = start(words);
            wait_for_its_handler(child);
            usleep(150'000);
            const bool over = waitpid(child, nullptr, WNOHANG) != 0;  // done before: nothing to see
            if (over) continue;
            ++heard;
            kill(child, signal);
            const int code = code_within(child, std::chrono::milliseconds(words[0] == "drive" ? 3000 : 1000));
            EXPECT_TRUE(code == 130 || (code == 0 && words[0] == "drive")) << words[0] << ": " << code;
        }
    }
    EXPECT_GE(heard, 8);  // the long ones: the short may be over before
}

TEST_F(Endings, OnAStandardErrorThatTakesNothingKeepTheirCode) {
    const std::string command = "'" + test::program_path() + "' check nothing.toml 2>/dev/full";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 5);
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

TEST_F(Endings, AreTheSameInFoldersOfAnyName) {
    const std::string odd = "caf\xe9";
    const Outcome r = run("run " + scenario_for(car) + " -o '" + odd + "' --json");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_NO_THROW(nlohmann::json::parse(r.out));
    for (const char* name : {"results.nc", "results.csv", "summary.json", "report.html"}) {
        EXPECT_TRUE(fs::exists(folder_ / odd / name)) << name;
    }
    fs::copy(car, folder_ / odd / "car.toml");
    fs::copy(test::source_path("vehicles/tires"), folder_ / odd / "tires");
    const Outcome checked = run("check --json '" + odd + "/car.toml'");
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_NO_THROW(nlohmann::json::parse(checked.out));
    const Outcome driven = run("run --maneuver cleat --vehicle '" + odd + "/car.toml' -o '" + odd + "'");
    EXPECT_EQ(driven.code, 0) << driven.err;
    EXPECT_TRUE(fs::exists(folder_ / odd / "outcome.json"));
    EXPECT_EQ(run("compare '" + odd + "' '" + odd + "' -o both.html").code, 0);
}

TEST_F(Endings, OfARunWhoseEnergyIsWrongAreNumericalFailures) {
    const std::string light =
        changed("vehicles/bmw_323i.toml", "spin_inertia_kg_m2 = ", "spin_inertia_kg_m2 = 1e-6 # ");
    const Outcome r =
        run("run " + scenario_for(light, "[initial]\nvelocity_m_per_s = 20\n[inputs.drive]\ntorque_N_m = 600\n") +
            " -o results");
    EXPECT_EQ(r.code, 4) << r.out << r.err;
    EXPECT_THAT(r.err, HasSubstr("the energy balance is off by"));
    EXPECT_THAT(r.err, HasSubstr("no motion of the vehicle"));
    EXPECT_TRUE(fs::exists(folder_ / "results/results.csv"));
    const auto told = nlohmann::json::parse(contents(folder_ / "results/summary.json"));
    EXPECT_EQ(told["energy"]["balance"], "wrong");
}

TEST_F(Endings, OfAServerLeaveItsSocketsToNobody) {
    std::ofstream(folder_ / "xdg-open") << "#!/bin/sh\nls -l /proc/$$/fd > seen.part\nmv seen.part seen\n";
    fs::permissions(folder_ / "xdg-open", fs::perms::owner_all);
    const pid_t child = fork();
    if (child == 0) {
        const std::string path = folder_.string() + ":" + getenv("PATH");
        setenv("PATH", path.c_str(), 1), setenv("DISPLAY", ":0", 1);
        if (chdir(folder_.c_str()) != 0 || !freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr)) {
            _exit(99);
        }
        execl(test::program_path().c_str(), "hamilcar", "drive", nullptr);
        _exit(99);
    }
    EXPECT_TRUE(appears("seen")) << contents(folder_ / "err.txt");
    kill(child, SIGTERM);
    EXPECT_NE(code_within(child, std::chrono::seconds(5)), -1);
    const std::string seen = contents(folder_ / "seen");
    EXPECT_THAT(seen, testing::Not(HasSubstr("socket:")));
    EXPECT_THAT(seen, testing::Not(HasSubstr("eventfd")));
}

TEST_F(Endings, DoNotPassOnWhatATerminalObeys) {
    std::ofstream(folder_ / "odd.toml") << "\"x\\u001b]0;owned\\u0007\" = 1\n[chassis]\n\"y\\u001b[2J\" = 1\n";
    const Outcome r = run("check odd.toml");
    EXPECT_EQ(r.code, 3);
    EXPECT_EQ(r.err.find('\x1b'), std::string::npos) << r.err;
}

}  // namespace
}  // namespace hamilcar
