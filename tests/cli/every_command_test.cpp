// Every command on every shipped vehicle, scenario and tire: nothing that comes with the program may fail in it.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

namespace fs = std::filesystem;

struct Use {
    std::string name, words;
    std::vector<int> codes{0};  // that are fine
    bool is_json = false;
};

void PrintTo(const Use& use, std::ostream* out) {
    *out << use.name;
}

std::vector<std::string> files_in(const std::string& folder, const std::string& extension) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(test::source_path(folder))) {
        if (entry.path().extension() == extension) found.push_back(entry.path().string());
    }
    std::ranges::sort(found);
    return found;
}

class UseList {
public:
    void add(const std::string& command, const std::string& file, const std::string& more = "",
             std::vector<int> codes = {0}) {
        std::string name = command + "_" + fs::path(file).parent_path().filename().string() + "_" +
                           fs::path(file).stem().string() + more;
        std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)) && c != '_'; });
        list_.push_back({name, command + " '" + file + "' " + more, std::move(codes), more.starts_with("--json")});
    }
    std::vector<Use> take() { return std::move(list_); }

private:
    std::vector<Use> list_;
};

std::vector<Use> every_use() {
    UseList uses;
    for (const std::string& vehicle : files_in("vehicles", ".toml")) {
        for (const char* command : {"check", "channels", "equilibrium", "kinematics", "modes"}) {
            uses.add(command, vehicle), uses.add(command, vehicle, "--json");
        }
        for (const char* command : {"equilibrium", "modes"}) uses.add(command, vehicle, "--speed 20");
        for (const char* command : {"kinematics", "modes"}) uses.add(command, vehicle, "-o folder");
        uses.add("maneuvers", vehicle, "--json");
        uses.add("bench", vehicle, "--seconds 0.1");
    }
    for (const char* folder : {"scenarios", "scenarios/maneuvers"}) {
        const bool is_maneuver = std::string(folder) != "scenarios";
        for (const std::string& scenario : files_in(folder, ".toml")) {
            uses.add("check", scenario), uses.add("check", scenario, "--json");
            uses.add("road", scenario), uses.add("road", scenario, "--json");
            uses.add("road", scenario, "--length 10 -o road.crg");
            uses.add("run", scenario, "-o folder", is_maneuver ? std::vector{0, 1} : std::vector{0});
        }
    }
    for (const std::string& tire : files_in("vehicles/tires", ".tir")) {
        uses.add("tire", tire), uses.add("tire", tire, "--json"), uses.add("tire", tire, "-o folder");
    }
    return uses.take();
}

class EveryCommand : public Program, public testing::WithParamInterface<Use> {};

TEST_P(EveryCommand, TakesWhatIsShipped) {
    const Outcome r = run(GetParam().words);
    EXPECT_THAT(GetParam().codes, testing::Contains(r.code)) << r.err;
    EXPECT_THAT(r.err, testing::Not(testing::HasSubstr("error")));
    EXPECT_THAT(r.out, testing::Not(testing::ContainsRegex("[^a-z](nan|inf)[^a-z]")));
    if (GetParam().is_json) {
        EXPECT_NO_THROW(nlohmann::json::parse(r.out));
    }
    if (GetParam().words.starts_with("run")) {  // and what it wrote is taken again
        const bool maneuver = fs::exists(folder_ / "folder/outcome.json");
        const Outcome seen = run(maneuver ? "compare folder folder -o page.html --rows 100"
                                          : "view folder/results.nc -o page.html --rows 100");
        EXPECT_EQ(seen.code, 0) << seen.err;
        EXPECT_TRUE(fs::exists(folder_ / "page.html"));
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryCommand, testing::ValuesIn(every_use()),
                         [](const auto& use) { return use.param.name; });

TEST_F(Program, DrivesEveryShippedVehicle) {
    for (const std::string& vehicle : files_in("vehicles", ".toml")) {
        const pid_t child = fork();
        if (child == 0) {
            if (chdir(folder_.c_str()) != 0 || !freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr)) {
                _exit(99);
            }
            execl(test::program_path().c_str(), "hamilcar", "drive", vehicle.c_str(), "--no-browser", nullptr);
            _exit(99);
        }
        for (int i = 0; i < 1000 && !contents(folder_ / "out.txt").starts_with("http://127.0.0.1:"); ++i)
            usleep(10'000);
        EXPECT_THAT(contents(folder_ / "out.txt"), testing::StartsWith("http://127.0.0.1:")) << vehicle;
        kill(child, SIGTERM);
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_THAT(WEXITSTATUS(status), testing::AnyOf(0, 130)) << vehicle << contents(folder_ / "err.txt");
        fs::remove(folder_ / "out.txt");
    }
}

}  // namespace
}  // namespace hamilcar
