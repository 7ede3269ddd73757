// `hamilcar study` as a person meets it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string car = test::source_path("vehicles/hatchback.toml");
const std::string bar = "axle.front.anti_roll_bar.rate_N_per_m";

class StudyCommand : public Program {
protected:
    std::string study(const std::string& more = "") const {
        const fs::path path = folder_ / "study.toml";
        std::ofstream(path) << "name = \"bars\"\nvehicle = \"" << car
                            << "\"\n[[parameter]]\nname = \"bar\"\nkey = \"vehicle." << bar
                            << "\"\nvalues = [0, 12e3]\n[[parameter]]\nname = \"speed\"\n"
                            << "key = \"step.maneuver.settings.speed_km_per_h\"\nvalues = [70, 90]\n"
                            << "[[run]]\nname = \"step\"\nmaneuver = \"step_steer\"\n[[run]]\nname = "
                               "\"at_rest\"\nanalysis = \"vehicle\"\n"
                            << more;
        return path.string();
    }
    Json figure(const Json& all, std::size_t point, const std::string& name) const {
        for (std::size_t i = 0; i < all["figures"].size(); ++i) {
            if (all["figures"][i]["name"] == name) return all["points"][point]["figures"][i];
        }
        return nullptr;
    }
};

// Every figure of every point, to the last bit, whatever the number of threads.
TEST_F(StudyCommand, GivesWhatSingleRunsGive) {
    const Outcome r = run("study " + study() + " --json -o out --jobs 3");
    ASSERT_EQ(r.code, 0) << r.err;
    const Json all = Json::parse(r.out);
    ASSERT_EQ(all["points"].size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        const Outcome single =
            run(fmt::format("run --maneuver step_steer --json --no-recording -o single --vehicle {} "
                            "--vehicle-set {}={} --set speed={}",
                            car, bar, i < 2 ? 0 : 12000, i % 2 == 0 ? 70 : 90));
        ASSERT_EQ(single.code, 0) << single.err;
        const Json told = Json::parse(single.out);
        for (const Json& f : told["figures"]) {
            EXPECT_EQ(figure(all, i, "step: " + f["name"].get<std::string>()), f["value"]) << i << " " << f["name"];
        }
    }
    EXPECT_GT(figure(all, 2, "at_rest: axle 1 (front) roll stiffness"),
              figure(all, 0, "at_rest: axle 1 (front) roll stiffness"));
    EXPECT_THAT(contents(folder_ / "out/study.html"), HasSubstr("Main effects"));
    EXPECT_THAT(contents(folder_ / "out/study.csv"), HasSubstr("point,bar,speed,step: "));
    EXPECT_TRUE(fs::exists(folder_ / "out/study.nc"));
}

// The runs of a point with their reports, which are theirs alone: the same figures.
TEST_F(StudyCommand, OpensTheRunsOfAPoint) {
    std::ofstream(folder_ / "drive.toml") << "name = \"drive\"\nvehicle = \"none.toml\"\nduration_s = 0.1\n";
    const std::string file = study(
        "[[run]]\nname = \"drive\"\nscenario = \"drive.toml\"\n"
        "[[goal]]\nfigure = \"step: steady roll angle\"\nwant = \"min\"\n");
    const Outcome r = run("study " + file + " --json -o out --report 2 --report best");
    ASSERT_EQ(r.code, 0) << r.err;
    const Json all = Json::parse(r.out);
    const std::string best = "out/point_" + all["best"].dump();
    ASSERT_NE(best, "out/point_2");
    const Json outcome = Json::parse(contents(folder_ / best / "step/outcome.json"));
    for (const Json& f : outcome["figures"]) {
        EXPECT_EQ(figure(all, all["best"].get<std::size_t>() - 1, "step: " + f["name"].get<std::string>()), f["value"]);
    }
    EXPECT_EQ(outcome["vehicle"]["set"], Json::array({bar + "=12000"}));
    const std::string page = contents(folder_ / "out/study.html");
    for (const std::string run : {"/step", "/drive"}) {
        EXPECT_TRUE(fs::exists(folder_ / ("out/point_2" + run) / "report.html"));
        EXPECT_THAT(page, HasSubstr("\"file\":\"point_2" + run + "/report.html\""));
        EXPECT_FALSE(fs::exists(folder_ / ("out/point_1" + run)));
    }
    EXPECT_FALSE(fs::exists(folder_ / "out/point_2/at_rest"));
    EXPECT_EQ(run("study " + file + " -o out --again").code, 0);
    EXPECT_THAT(contents(folder_ / "out/study.html"), Not(HasSubstr("report.html\"")));
    for (const std::string word : {"0", "5", "1.5", "worst"}) {
        const Outcome wrong = run(fmt::format("study {} -o out --report {}", file, word));
        EXPECT_EQ(wrong.code, 2);
        EXPECT_THAT(wrong.err, HasSubstr("--report '" + word + "': expected a point, 1 to 4, 'best' or 'all'"));
    }
}

// Killed between two runs or within a line: what is there is not done again, and the table comes out the same.
TEST_F(StudyCommand, GoesOnWhereItWas) {
    ASSERT_EQ(run("study " + study() + " -o out").code, 0);
    const std::string table = contents(folder_ / "out/study.csv");
    const fs::path record = folder_ / "out/results.jsonl";
    fs::resize_file(record, fs::file_size(record) - 100);
    fs::remove(folder_ / "out/study.csv");
    const Outcome again = run("study " + study() + " -o out");
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_THAT(again.err, HasSubstr("7 of 8 runs were there already"));
    EXPECT_EQ(contents(folder_ / "out/study.csv"), table);

    const Outcome best =
        run("study " + study("[[goal]]\nfigure = \"step: steady roll angle\"\nwant = \"min\"\n") + " -o out");
    EXPECT_EQ(best.code, 0) << best.err;
    EXPECT_THAT(best.err, HasSubstr("8 of 8 runs were there already"));
    EXPECT_THAT(best.out, AllOf(HasSubstr("best: point "), HasSubstr("--vehicle-set '" + bar + "=12000'")));

    const std::string other = study("[[run]]\nname = \"axles\"\nanalysis = \"kinematics\"\n");
    const Outcome changed = run("study " + other + " -o out");
    EXPECT_EQ(changed.code, 2);
    EXPECT_THAT(changed.err, AllOf(HasSubstr("results of another study"), HasSubstr("--again")));
    EXPECT_EQ(run("study " + other + " -o out --again").code, 0);
}

// A variant that cannot be driven is one row that says why.
TEST_F(StudyCommand, TellsOfEachVariantThatFails) {
    const fs::path path = folder_ / "study.toml";
    std::ofstream(path) << "name = \"s\"\nvehicle = \"" << car
                        << "\"\n[[parameter]]\nname = \"mass\"\nkey = \"vehicle.chassis.mass_kg\"\n"
                        << "values = [1000, -5]\n[[run]]\nname = \"at_rest\"\nanalysis = \"vehicle\"\n";
    const Outcome r = run("study study.toml -o out");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("1 run failed"));
    EXPECT_THAT(contents(folder_ / "out/study.csv"),
                HasSubstr("key 'chassis.mass_kg' = -5: expected a positive number [kg]"));
}

TEST_F(StudyCommand, RefusesWhatItsFilesDoNotHave) {
    const Outcome r = run("study " + study("[[run]]\nname = \"x\"\nmaneuver = \"pirouette\"\n") + " -o out");
    EXPECT_EQ(r.code, 3);
    EXPECT_THAT(r.err, HasSubstr("no maneuver 'pirouette'"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    EXPECT_EQ(run("study nowhere.toml").code, 5);
}

}  // namespace
}  // namespace hamilcar
