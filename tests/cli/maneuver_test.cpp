// Maneuvers, comparisons, power and interrupted runs as a person meets them at the command line.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <map>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string car = test::source_path("vehicles/bmw_323i.toml");
const std::string driven =
    "[initial]\nvelocity_m_per_s = 10.0\n[driver.speed]\nspeed_m_per_s = 14.0\n[driver.gear]\nnumber = 2\n"
    "[driver.path]\nx_m = [0.0, 10.0, 40.0]\ny_m = [0.0, 0.0, 2.0]\n";

TEST_F(Program, DrivesAManeuverAndWritesItsReport) {
    const Outcome r = run("run --maneuver step_steer --vehicle " + car + " -o out");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("ISO 7401"));
    EXPECT_THAT(r.out, HasSubstr("yaw rate response time"));
    const auto facts = nlohmann::json::parse(contents(folder_ / "out/outcome.json"));
    EXPECT_TRUE(facts["passed"]);
    EXPECT_GT(facts["charts"].size(), 0u);
    EXPECT_THAT(contents(folder_ / "out/report.html"), HasSubstr("verdicts"));
    EXPECT_EQ(run("view out/drive.nc").code, 0);
}

// To the last bit what a file with that number gives, and the outcome says so.
TEST_F(Program, DrivesAVehicleWithAnotherNumber) {
    const std::string words = "run --maneuver step_steer --json --vehicle ";
    const std::string other = changed("vehicles/bmw_323i.toml", "rate_N_per_m = 26200.0", "rate_N_per_m = 30e3");
    const Outcome set = run(words + car + " --vehicle-set axle[front].spring.rate_N_per_m=30e3 -o set");
    const Outcome by_file = run(words + other + " -o by_file"), before = run(words + car + " -o before");
    ASSERT_EQ(set.code, 0) << set.err;
    const auto facts = nlohmann::json::parse(set.out);
    EXPECT_EQ(facts["figures"], nlohmann::json::parse(by_file.out)["figures"]);
    EXPECT_NE(facts["figures"], nlohmann::json::parse(before.out)["figures"]);
    EXPECT_EQ(facts["vehicle"]["set"], nlohmann::json({"axle[front].spring.rate_N_per_m=30e3"}));
    ASSERT_EQ(run("compare before set -o both.html").code, 0);
    EXPECT_THAT(contents(folder_ / "both.html"), HasSubstr("axle[front].spring.rate_N_per_m=30e3"));
}

// Every command that reads a vehicle takes other numbers for it, before and after the file, and says which of them is wrong.
TEST_F(Program, TakesOtherNumbersWhereverAVehicleIsRead) {
    const std::string scenario = scenario_for(car);
    for (const std::string& words :
         {"check " + car, "check " + scenario, "kinematics " + car, "equilibrium " + car, "modes " + car,
          "program " + car, "channels " + car, "maneuvers " + car, "bench --seconds 0.1 " + car,
          "drive --no-browser " + car, "run " + scenario, "run --maneuver step_steer --vehicle " + car}) {
        const Outcome r = run(words + " --vehicle-set chassis.mass_kg=-1");
        EXPECT_EQ(r.code, 3) << words;
        EXPECT_THAT(r.err, HasSubstr("--vehicle-set: key 'chassis.mass_kg' = -1: expected a positive number [kg]"))
            << words;
    }
    EXPECT_EQ(run("kinematics --vehicle-set axle[frnt].spring.rate_N_per_m=3 " + car).code, 2);
    const Outcome r = run("check --vehicle-set chassis.mass_kg=1500 --vehicle-set 'name=The heavy one' " + car);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("The heavy one"));
}

TEST_F(Program, RecordsWhatIsAskedForOfAManeuver) {
    const std::string words = "run --maneuver step_steer -o out --vehicle " + car;
    ASSERT_EQ(run(words + " --csv --channel chassis.velocity.* --channel energy.kinetic --set speed=70").code, 0);
    const std::string heading = contents(folder_ / "out/drive.csv").substr(0, 400);
    EXPECT_THAT(heading, HasSubstr("chassis.velocity.x [m/s]"));
    EXPECT_THAT(heading, HasSubstr("energy.kinetic [J]"));
    EXPECT_THAT(contents(folder_ / "out/drive.nc"),
                AllOf(HasSubstr("setting_speed_km_per_h"), HasSubstr(car), HasSubstr("energy.kinetic")));

    ASSERT_EQ(run(words + " --csv --channel chassis.velocity.* --interval 0.5").code, 0);
    const std::string rows = contents(folder_ / "out/drive.csv");
    EXPECT_THAT(rows, AllOf(HasSubstr("\n0.5,"), HasSubstr("\n1,"), testing::Not(HasSubstr("\n0.25,"))));

    ASSERT_EQ(run(words + " --no-recording").code, 0);
    EXPECT_FALSE(fs::exists(folder_ / "out/drive.csv"));  // of the drive before
    EXPECT_FALSE(fs::exists(folder_ / "out/drive.nc"));
    EXPECT_LT(fs::file_size(folder_ / "out/report.html"), 4'000'000u);

    const Outcome typo = run(words + " --channel energy.kinetik");
    EXPECT_EQ(typo.code, 2);
    EXPECT_THAT(typo.err, HasSubstr("unknown channel \"energy.kinetik\"; did you mean \"energy.kinetic\"?"));
    EXPECT_EQ(run(words + " --csv --no-recording").code, 2);
    EXPECT_EQ(run(words + " --interval 0.1 --no-recording").code, 2);
    EXPECT_EQ(run("run " + scenario_for(car) + " --csv").code, 2);
}

TEST_F(Program, TellsAFailedVerdictByItsExitCode) {
    const Outcome r = run("run --maneuver double_lane_change --vehicle " + car + " --set speed=140 --json -o out");
    EXPECT_EQ(r.code, 1) << r.err;
    const auto facts = nlohmann::json::parse(r.out);
    EXPECT_FALSE(facts["passed"]);
    EXPECT_FALSE(facts.contains("charts"));
}

TEST_F(Program, DrivesAManeuverOfAScenarioFile) {
    const auto maneuver_for = [&](const std::string& text) {
        const fs::path path = folder_ / "scenario.toml";
        std::ofstream(path) << "name = \"t\"\nvehicle = \"" << car << "\"\n" << text;
        return path.string();
    };
    const std::string scenario =
        maneuver_for("[maneuver]\nname = \"weave\"\n[maneuver.settings]\nspeed_km_per_h = 90.0\n");
    ASSERT_EQ(run("check " + scenario).code, 0);
    for (const auto& [typed, speed] :
         std::map<std::string, double>{{"", 90}, {" --set speed=85", 85}, {" --set speed_km_per_h=85", 85}}) {
        const Outcome r = run(std::string("run ").append(scenario).append(" --json").append(typed));
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(nlohmann::json::parse(r.out)["settings"][0]["value"], speed) << typed;
    }
    for (const auto& [more, what] : std::vector<std::pair<std::string, std::string>>{
             {"[maneuver]\nname = \"weeve\"\n", "did you mean 'weave'"},
             {"[maneuver]\nname = \"weave\"\n[maneuver.settings]\nspeed_km_per_h = 900.0\n", "[km/h]"},
             {"[maneuver]\nname = \"weave\"\n[maneuver.settings]\nspeed = 90.0\nspeed_km_per_h = 80.0\n",
              "each setting once"},
             {"[maneuver]\nname = \"weave\"\n[maneuver.settings]\nsped = 90.0\n", "did you mean 'speed'"}}) {
        for (const char* command : {"run ", "check "}) {
            const Outcome mistaken = run(command + maneuver_for(more));
            EXPECT_EQ(mistaken.code, 3) << more;
            EXPECT_THAT(mistaken.err, HasSubstr(what));
            EXPECT_THAT(mistaken.err, HasSubstr("scenario.toml:"));
        }
    }
}

TEST_F(Program, TakesWordsForChoicesAndFlagsOfAManeuver) {
    std::ofstream(folder_ / "rough.toml") << "name = \"t\"\nvehicle = \"" << car
                                          << "\"\n[maneuver]\nname = \"rough_road\"\n[maneuver.settings]\n"
                                             "road_class = \"D\"\nlength = 50.0\n";
    for (const auto& [typed, number] : std::map<std::string, double>{
             {"rough.toml", 4}, {"rough.toml --set road_class=a", 1}, {"rough.toml --set road_class=2", 2}}) {
        const Outcome r = run("run " + typed + " --json");
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(nlohmann::json::parse(r.out)["settings"][1]["value"], number) << typed;
    }
    std::ofstream(folder_ / "dodge.toml")
        << "name = \"t\"\nvehicle = \"" << car
        << "\"\n[maneuver]\nname = \"obstacle_avoidance\"\n[maneuver.settings]\nsearch = \"maybe\"\n";
    const Outcome mistaken = run("check dodge.toml");
    EXPECT_EQ(mistaken.code, 3);
    EXPECT_THAT(mistaken.err, HasSubstr("dodge.toml:6:"));
    EXPECT_THAT(mistaken.err, HasSubstr("'maybe': expected 'yes' or 'no'"));
}

TEST_F(Program, SaysWhatAVehicleCannotDo) {
    const std::string paper = test::source_path("vehicles/bmw_323i_paper.toml");
    const Outcome r = run("run --maneuver acceleration --vehicle " + paper);
    EXPECT_EQ(r.code, 3);
    EXPECT_THAT(r.err, HasSubstr("power_unit"));
    EXPECT_EQ(run("run --maneuver weave --set speed=fast").code, 2);
    EXPECT_EQ(run("run --maneuver weave --set speed=nan").code, 2);
    EXPECT_THAT(run("run --maneuver weave --set speed=80 --set speed=60").err, HasSubstr("each setting once"));
    EXPECT_EQ(run("run --maneuver weave --checkpoint state").code, 2);
    EXPECT_EQ(run("run --maneuver weave --checkpoint state --checkpoint-interval 1").code, 2);
    EXPECT_EQ(run("run").code, 2);
    EXPECT_EQ(run("run " + scenario_for(car) + " --set speed=3").code, 2);
}

TEST_F(Program, TakesMistypedManeuversAndSettingsForMistakesOfUsage) {
    for (const auto& [typed, what] : std::vector<std::pair<std::string, std::string>>{
             {"weeve", "did you mean 'weave'"},
             {"weave --set sped=80", "did you mean 'speed'"},
             {"weave --set speed=800", "expected 20 to 250 [km/h]"},
             {"weave --set speed", "NAME=VALUE"},
             {"weave --set speed=0x50", "expected a decimal number"},
             {"weave --set speed=inf", "expected a decimal number"},
             {"weave --set speed=80km/h", "the unit is km/h, without it"},
             {"weave --set speed=80 --set speed_km_per_h=60", "each setting once"},
             {"fishhook --set feedback=0.3", "= 0.3: expected 'yes' or 'no'"},
             {"split_braking --set low_side=lefft", "'lefft': expected 'left' or 'right'; did you mean 'left'?"}}) {
        const Outcome mistaken = run("run --maneuver " + typed);
        EXPECT_EQ(mistaken.code, 2) << typed;
        EXPECT_THAT(mistaken.err, HasSubstr(what)) << typed;
    }
}

TEST_F(Program, TellsAConstraintViolationInAManeuverByItsExitCode) {
    const Outcome r = run("run --maneuver double_lane_change --vehicle " + car + " --step 0.02 -o out");
    EXPECT_EQ(r.code, 4);
    EXPECT_THAT(r.err, HasSubstr("double_lane_change: at t = "));
    EXPECT_THAT(r.out, testing::Not(HasSubstr("PASSED")));
    EXPECT_THAT(r.out, testing::Not(HasSubstr("roll angle")));
    EXPECT_TRUE(nlohmann::json::parse(contents(folder_ / "out/outcome.json"))["verdicts"].empty());
}

TEST_F(Program, ListsManeuversForAVehicle) {
    const Outcome r = run("maneuvers " + car + " --json");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto list = nlohmann::json::parse(r.out);
    EXPECT_EQ(list.size(), 20u);
    for (const auto& maneuver : list) {
        EXPECT_FALSE(maneuver["summary"].get<std::string>().empty());
        EXPECT_EQ(maneuver["unsupported_reason"], "");
        if (maneuver["name"] != "split_braking") continue;
        const auto speed = maneuver["settings"][0], side = maneuver["settings"][5];
        EXPECT_EQ(speed["kind"], "number");
        EXPECT_TRUE(speed["min"] < speed["default"] && speed["default"] < speed["max"]) << speed;
        EXPECT_EQ(side["kind"], "choice");
        EXPECT_EQ(side["default"], "left");
        EXPECT_EQ(side["choices"], nlohmann::json({"left", "right"}));
        EXPECT_TRUE(side["min"].is_null());
    }
    const std::string told = run("maneuvers").out;
    EXPECT_THAT(told, HasSubstr("speed=80 km/h"));
    EXPECT_THAT(told, HasSubstr("search=no  also seek the highest entry speed without a cone hit ('yes' or 'no')"));
    EXPECT_THAT(told, HasSubstr("(a whole number, 1 to 20)"));
}

TEST_F(Program, ComparesOutcomes) {
    ASSERT_EQ(run("run --maneuver weave --vehicle " + car + " -o a").code, 0);
    ASSERT_EQ(run("run --maneuver weave --vehicle " + car + " --set speed=80 -o b").code, 0);
    const Outcome r = run("compare a b/outcome.json -o both.html");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(contents(folder_ / "both.html"), HasSubstr("speed 80 km/h"));
    EXPECT_EQ(r.err, "");
    EXPECT_THAT(r.out, AllOf(HasSubstr("2 - 1"), HasSubstr("wrote both.html\n")));
    std::ofstream(folder_ / "keep.json") << "{}";
    EXPECT_EQ(run("compare a b -o keep.json").code, 2);
    EXPECT_EQ(run("compare a b --csv keep.json").code, 2);
    EXPECT_EQ(contents(folder_ / "keep.json"), "{}");
    ASSERT_EQ(run("run --maneuver step_steer --vehicle " + car + " -o c").code, 0);
    EXPECT_THAT(run("compare a b c -o both.html").err, HasSubstr("different maneuvers: a has weave, c has step_steer"));
    const Outcome facts = run("compare a b --json --csv table.csv -o both.html");
    ASSERT_EQ(facts.code, 0) << facts.err;
    const auto figure = nlohmann::json::parse(facts.out)["figures"][0];
    const auto own = nlohmann::json::parse(contents(folder_ / "b/outcome.json"))["figures"][0];
    EXPECT_EQ(figure["values"][1], own["value"]);
    EXPECT_THAT(contents(folder_ / "table.csv"), HasSubstr("figure," + own["name"].get<std::string>() + ","));
    EXPECT_EQ(run("compare a").code, 2);
    EXPECT_EQ(run("compare a nowhere").code, 5);
    std::ofstream(folder_ / "no.json") << "{}";
    const Outcome mistaken = run("compare a no.json");
    EXPECT_EQ(mistaken.code, 3);
    EXPECT_THAT(mistaken.err, HasSubstr("no.json"));
}

TEST_F(Program, ResumesToTheSameBytes) {
    const std::string scenario = scenario_for(car, driven);
    ASSERT_EQ(run("run " + scenario + " -o whole").code, 0);
    // The first part ends with its process, not at the end of the scenario: a checkpoint every 0.3 s, the last one at 0.9 s.
    ASSERT_EQ(run("run " + scenario + " -o parts --checkpoint state --checkpoint-interval 0.3").code, 0);
    std::string text = contents(folder_ / "scenario.toml");
    text.replace(text.find("duration_s = 1.0"), 16, "duration_s = 0.64");
    std::ofstream(folder_ / "short.toml") << text;
    ASSERT_EQ(run("run short.toml -o parts --checkpoint state").code, 0);
    ASSERT_NE(contents(folder_ / "parts/results.csv"), contents(folder_ / "whole/results.csv"));
    const Outcome r = run("run " + scenario + " -o parts --resume state");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(contents(folder_ / "parts/results.csv"), contents(folder_ / "whole/results.csv"));
    EXPECT_EQ(contents(folder_ / "parts/results.nc"), contents(folder_ / "whole/results.nc"));
    EXPECT_EQ(run("run " + scenario + " -o elsewhere --resume state").code, 3);
    EXPECT_EQ(run("run " + scenario + " -o parts --resume nowhere").code, 5);
    const Outcome other = run("run " + scenario + " -o parts --resume state --step 5e-4");
    EXPECT_EQ(other.code, 3);
    EXPECT_THAT(other.err, HasSubstr("of another step (0.001 s)"));
}

TEST_F(Program, RecordsWhatTheEngineDoesAndRefusesGearsThatAreNotThere) {
    const std::string throttle = "[inputs.throttle]\npedal = 0.5\n";
    const Outcome r = run("run " + scenario_for(car, throttle + "[inputs.gear]\nnumber = 1\n") + " -o out");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(contents(folder_ / "out/results.csv"), HasSubstr("engine.speed [rpm]"));
    const Outcome sixth = run("run " + scenario_for(car, throttle + "[inputs.gear]\nnumber = 6\n"));
    EXPECT_EQ(sixth.code, 3);
    EXPECT_THAT(sixth.err, HasSubstr("expected one of -1 (reverse) to 5"));
    const Outcome none = run("run " + scenario_for(car, throttle));
    EXPECT_EQ(none.code, 3);
    EXPECT_THAT(none.err, HasSubstr("no gear is in"));
    const std::string paper = test::source_path("vehicles/bmw_323i_paper.toml");
    EXPECT_THAT(run("run " + scenario_for(paper, throttle)).err, HasSubstr("has no power unit"));
    const Outcome unpowered = run("run " + scenario_for(car) + " -o plain");
    ASSERT_EQ(unpowered.code, 0);
    EXPECT_THAT(contents(folder_ / "plain/results.csv"), testing::Not(HasSubstr("engine.speed")));
}

}  // namespace
}  // namespace hamilcar
