// How the program ends when the world around it is not as it should be: streams that take nothing, signals, names of any
// bytes, a simulation that went wrong.
#include <gmock/gmock.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/endings.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string car = test::source_path("vehicles/bmw_323i.toml");

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

#ifdef HAMILCAR_SANITIZED
constexpr int slowness = 20;  // of a program that is looked after, beside others
#else
constexpr int slowness = 1;
#endif

struct Signaled {
    std::vector<std::string> words;
    bool is_long;  // else it may be done before the signal comes, or just then
};

TEST_F(Endings, BySignalComeWithinASecondFromEveryCommand) {
    const std::string big = folder_ / "big.toml", rough = test::source_path("scenarios/rough_road.toml");
    std::ofstream(big) << "a = [" << [] {
        std::string numbers;
        while (numbers.size() < 3'900'000) numbers += "1,";
        return numbers;
    }() << "]\n";
    const std::vector<Signaled> commands{{{"bench", "--seconds", "60"}, true},
                                         {{"check", big}, false},
                                         {{"road", rough, "--length", "20000"}, false},
                                         {{"tire", test::source_path("vehicles/tires/pacejka_205_60_r15.tir")}, false},
                                         {{"modes", test::source_path("vehicles/truck_semitrailer.toml")}, false},
                                         {{"run", "--maneuver", "random_steer", "-o", "m"}, true},
                                         {{"paper", "-o", "p"}, true},
                                         {{"drive", "--no-browser"}, true}};
    for (const auto& [words, is_long] : commands) {
        for (const int signal : {SIGINT, SIGTERM}) {
            const pid_t child = start(words);
            wait_for_its_handler(child);
            usleep(150'000);
            int status = 0;
            if (waitpid(child, &status, WNOHANG) != 0) {
                EXPECT_FALSE(is_long) << words[0] << " ended by itself: " << status;
                continue;
            }
            kill(child, signal);
            const bool serves = words[0] == "drive";
            const int code = code_within(child, slowness * std::chrono::milliseconds(serves ? 3000 : 1000));
            const bool done = code == 0 && (serves || !is_long);    // a server is there to be ended
            const bool refused = code == 3 && words[0] == "check";  // its file is none
            EXPECT_TRUE(code == 130 || done || refused) << words[0] << ": " << code << "\n"
                                                        << contents(folder_ / "err.txt");
        }
    }
}

// docs/endings.md
TEST_F(Endings, HaveOneCodeForEachMeaning) {
    const std::string scenario = scenario_for(car);
    std::ofstream(folder_ / "wrong.toml") << "name = 1\n";
    std::ofstream(folder_ / "coarse.toml")
        << contents(scenario) << "[initial]\nvelocity_m_per_s = 20\n"
        << "[inputs.steering_wheel]\ntime_s = [0.0, 0.2]\nangle_deg = [0.0, 200.0]\n";
    struct Ending {
        std::string words;
        int code;
        const char* message;
    };
    for (const Ending& e :
         std::vector<Ending>{{"check " + car, 0, ""},
                             {"run --maneuver double_lane_change --vehicle " + car + " --set speed=140 -o m", 1, ""},
                             {"", 2, "expected a command"},
                             {"chekc", 2, ""},
                             {"run " + scenario + " --step", 2, ""},
                             {"run --maneuver nothing -o m", 2, "there is no maneuver 'nothing'"},
                             {"check wrong.toml", 3, "wrong.toml:1:"},
                             {"view " + scenario, 3, ""},
                             {"run " + scenario + " -o r --resume " + scenario, 3, "expected a checkpoint"},
                             {"run coarse.toml -o r --step 0.1", 4, ""},
                             {"check nothing.toml", 5, "cannot read: No such file or directory"},
                             {"check /dev/zero", 5, "is a device"},
                             {"run " + scenario + " -o /proc/hamilcar", 5, "/proc/hamilcar"},
                             {"run " + scenario + " -o wrong.toml", 5, "wrong.toml"},
                             {"run " + scenario + " -o r --checkpoint /proc/state", 5, "/proc/state"}}) {
        const Outcome r = run(e.words);
        EXPECT_EQ(r.code, e.code) << e.words << ": " << r.err;
        EXPECT_THAT(r.err, HasSubstr(e.message)) << e.words;
        EXPECT_TRUE(e.code < 2 || r.err.find("hamilcar: ") != std::string::npos) << e.words;
    }
    const std::string table = contents(test::source_path("docs/endings.md")), help = run("--help").out;
    for (const char* code : {"0", "1", "2", "3", "4", "5", "6", "130"}) {
        EXPECT_THAT(table, HasSubstr("\n| " + std::string(code) + " | "));
        EXPECT_THAT(help, HasSubstr(" " + std::string(code) + " "));
    }
}

TEST_F(Endings, OnAStandardErrorThatTakesNothingKeepTheirCode) {
    const std::string command = "'" + test::program_path() + "' check nothing.toml 2>/dev/full";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 5);
}

TEST_F(Endings, AreTheSameInFoldersOfAnyName) {
    const std::string odd = "caf\xe9";
    const Outcome r = run("run " + scenario_for(car) + " -o '" + odd + "' --json");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(nlohmann::json::accept(r.out));
    for (const char* name : {"results.nc", "results.csv", "summary.json", "report.html"}) {
        EXPECT_TRUE(fs::exists(folder_ / odd / name)) << name;
    }
    fs::copy(car, folder_ / odd / "car.toml");
    fs::copy(test::source_path("vehicles/tires"), folder_ / odd / "tires");
    const Outcome checked = run("check --json '" + odd + "/car.toml'");
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_TRUE(nlohmann::json::accept(checked.out));
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

TEST_F(Endings, OfAServerCloseItsSockets) {
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

TEST_F(Endings, OfADriveTellNoTokenInTheListOfProcesses) {
    std::ofstream(folder_ / "xdg-open")
        << "#!/bin/sh\nstat -c %a \"$1\" > seen.part\n"
           "cat \"$1\" >> seen.part\necho \"arguments: $*\" >> seen.part\nmv seen.part seen\n";
    fs::permissions(folder_ / "xdg-open", fs::perms::owner_all);
    const pid_t child = fork();
    if (child == 0) {
        const std::string path = folder_.string() + ":" + getenv("PATH");
        setenv("PATH", path.c_str(), 1), setenv("DISPLAY", ":0", 1);
        if (chdir(folder_.c_str()) != 0 || !freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr)) {
            _exit(99);
        }
        execl(test::program_path().c_str(), "hamilcar", "drive", "-o", "a ;b'", nullptr);
        _exit(99);
    }
    EXPECT_TRUE(appears("seen")) << contents(folder_ / "err.txt");
    kill(child, SIGTERM);
    EXPECT_NE(code_within(child, std::chrono::seconds(5)), -1);
    const std::string seen = contents(folder_ / "seen"),
                      arguments = seen.substr(std::min(seen.find("arguments: "), seen.size()));
    EXPECT_THAT(seen, testing::StartsWith("600\n"));
    EXPECT_THAT(seen, HasSubstr("url=http://127.0.0.1:"));
    EXPECT_THAT(arguments, HasSubstr("/a ;b'/open-"));
    EXPECT_THAT(arguments, testing::Not(HasSubstr("token")));
    EXPECT_TRUE(fs::is_empty(folder_ / "a ;b'"));
}

TEST_F(Endings, DoNotPassOnWhatATerminalObeys) {
    std::ofstream(folder_ / "odd.toml") << "\"x\\u001b]0;owned\\u0007\" = 1\n[chassis]\n\"y\\u001b[2J\" = 1\n";
    const Outcome r = run("check odd.toml");
    EXPECT_EQ(r.code, 3);
    EXPECT_EQ(r.err.find('\x1b'), std::string::npos) << r.err;
}

}  // namespace
}  // namespace hamilcar
