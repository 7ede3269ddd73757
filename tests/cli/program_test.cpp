// The program as a person meets it: what it prints, which code it exits with, what it leaves on the disk.
#include <gmock/gmock.h>
#include <netcdf.h>
#include <sys/wait.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const char* const car_file = "vehicles/bmw_323i.toml";
const char* const hill_file = "scenarios/hill_hold.toml";
const char* const paper_file = "scenarios/paper.toml";
const std::string shipped = test::source_path("vehicles/bmw_323i.toml");

TEST_F(Program, RunsAScenarioAndWritesBothFormats) {
    const Outcome r = run("run " + scenario_for(shipped) + " -o results");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("times real time"));
    const std::string csv = contents(folder_ / "results/results.csv");
    EXPECT_THAT(csv, testing::StartsWith("time [s],chassis.position.x [m],"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 101);
    int file = 0, dimension = 0;
    std::size_t rows = 0;
    ASSERT_EQ(nc_open((folder_ / "results/results.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    EXPECT_EQ(nc_inq_dimid(file, "time", &dimension), NC_NOERR);
    EXPECT_EQ(nc_inq_dimlen(file, dimension, &rows), NC_NOERR);
    nc_close(file);
    EXPECT_EQ(rows, 101u);
}

TEST_F(Program, GivesTheSameFactsAsJson) {
    const Outcome r = run("run " + scenario_for(shipped) + " -o results --json");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto facts = nlohmann::json::parse(r.out);
    EXPECT_EQ(facts["steps"], 1000);
    EXPECT_LT(facts["max_constraint_violation_m"].get<double>(), 1e-12);
    EXPECT_EQ(facts, nlohmann::json::parse(contents(folder_ / "results/summary.json")));
}

TEST_F(Program, WritesTheSameBytesTwice) {
    const std::string scenario =
        scenario_for(shipped, "[inputs.drive]\ntime_s = [0.0, 0.5]\ntorque_N_m = [0.0, 400.0]\n");
    ASSERT_EQ(run("run " + scenario + " -o a").code, 0);
    ASSERT_EQ(run("run " + scenario + " -o b").code, 0);
    EXPECT_EQ(contents(folder_ / "a/results.csv"), contents(folder_ / "b/results.csv"));
    EXPECT_EQ(contents(folder_ / "a/results.nc"), contents(folder_ / "b/results.nc"));
    EXPECT_EQ(contents(folder_ / "a/report.html"), contents(folder_ / "b/report.html"));
}

TEST_F(Program, RunsThePapersCase) {
    const Outcome r = run("paper --json -o paper " + test::source_path("scenarios/paper.toml"));
    ASSERT_EQ(r.code, 0) << r.err;
    const auto facts = nlohmann::json::parse(r.out);
    EXPECT_EQ(facts["table_2"]["as_printed"], 9);
    EXPECT_EQ(facts["run"]["stabilization_gain_per_s"], 400);  // (36): 0.4 / 1 ms
    EXPECT_EQ(facts["table_2"]["degrees_of_freedom"], 10);
    const auto& fig9 = facts["figure_9"];
    EXPECT_NEAR(fig9["stability_limit_per_s"].get<double>(), 6000. / 11, 1e-9);
    ASSERT_EQ(fig9["sweeps"].size(), 2u);
    const auto &smoother = fig9["sweeps"][0], &smooth = fig9["sweeps"][1];
    for (const auto& sweep : {smoother, smooth})  // the first gain of the sweep beyond 6/11 of 1/h
        EXPECT_NEAR(sweep["first_unstable_gain_per_s"].get<double>(), 550, 1e-9);
    // As the paper says, where the rack's acceleration has no jumps; with jumps the least is at half of that.
    EXPECT_GE(smoother["min_rms_at_gain_per_s"].get<double>(), 400);
    EXPECT_LT(smoother["rms_norm_at_paper_gain"].get<double>(), 1.1 * smoother["min_rms_norm"].get<double>());
    EXPECT_GE(smooth["min_rms_at_gain_per_s"].get<double>(), 150);
    EXPECT_LE(smooth["min_rms_at_gain_per_s"].get<double>(), 250);
    EXPECT_GT(smooth["rms_norm_at_paper_gain"].get<double>(), 5 * smooth["min_rms_norm"].get<double>());
    EXPECT_TRUE(facts["run"]["validity"].empty()) << facts["run"]["validity"];
    for (const char* name : {"table2_degrees_of_freedom.csv", "table3_stability_limits.csv", "fig09_sweep.csv",
                             "fig11_lateral_position.csv", "fig12_lateral_velocity.csv", "fig13_vertical_position.csv",
                             "fig14_vertical_velocity.csv", "paper.html"}) {
        EXPECT_TRUE(fs::exists(folder_ / "paper" / name)) << name;
        EXPECT_GT(fs::file_size(folder_ / "paper" / name), 100u) << name;
    }
    // What the paper does not print is said to be ours, and of the gain what the paper says.
    EXPECT_THAT(contents(folder_ / "paper/paper.html"),
                HasSubstr("the drive torque goes up to 600 N m, the steering wheel"));
    EXPECT_THAT(run("paper -o paper").out, HasSubstr("comparatively small at alpha = 400"));
}

TEST_F(Program, KeepsWhatWasWrittenWhenItIsInterrupted) {
    const std::string scenario = scenario_for(shipped, "[output]\ninterval_s = 0.001\n");
    std::string text = contents(scenario);
    text.replace(text.find("duration_s = 1.0"), 16, "duration_s = 1e5");
    std::ofstream(scenario) << text;
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        if (chdir(folder_.c_str()) != 0 || !freopen("/dev/null", "w", stdout) || !freopen("err.txt", "w", stderr))
            _exit(99);
        execl(test::program_path().c_str(), "hamilcar", "run", scenario.c_str(), "-o", "results", nullptr);
        _exit(99);
    }
    const fs::path csv = folder_ / "results/results.csv";
    for (int i = 0; i < 1000 && (!fs::exists(csv) || fs::file_size(csv) < 100000); ++i) usleep(10000);
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 130);
    EXPECT_THAT(contents(folder_ / "err.txt"), HasSubstr("the results so far are kept"));
    EXPECT_EQ(contents(csv).back(), '\n');
    int file = 0;
    ASSERT_EQ(nc_open((folder_ / "results/results.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    nc_close(file);
}

struct Mistake {
    const char *name, *file, *from, *to;
    int code;
    std::vector<std::string> message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.name;
}

class Mistakes : public Program, public testing::WithParamInterface<Mistake> {};

TEST_P(Mistakes, EndWithOneMessageAndItsCode) {
    const Mistake& m = GetParam();
    const std::string file = changed(m.file, m.from, m.to);
    const Outcome r = std::string(m.file).starts_with("vehicles") ? run("check " + file) : run("run " + file + " -o o");
    EXPECT_EQ(r.code, m.code) << r.err;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    for (const std::string& piece : m.message) EXPECT_THAT(r.err, HasSubstr(piece));
}

INSTANTIATE_TEST_SUITE_P(
    Everyday, Mistakes,
    testing::Values(
        Mistake{"NegativeMass",
                car_file,
                "mass_kg = 1002.0",
                "mass_kg = -3",
                3,
                {"chassis.mass_kg", "-3", "[kg]", ":14:11:"}},
        Mistake{"UnknownKey", car_file, "mass_kg = 1002.0", "mas_kg = 1002.0", 3, {"mas_kg", "mass_kg"}},
        Mistake{
            "WrongType", car_file, "mass_kg = 1002.0", "mass_kg = \"heavy\"", 3, {"chassis.mass_kg", "heavy", "[kg]"}},
        Mistake{"ImpossibleInertia",
                car_file,
                "[215.1, 1624.6, 1573.9]",
                "[215.1, 4624.6, 1573.9]",
                3,
                {"chassis.inertia_kg_m2"}},
        Mistake{"DoesNotAssemble",
                car_file,
                "ball_joint_m = [-0.0060, 0.6525, 0.1650]",
                "arm_length_m = 0.10\nball_joint_m = [-0.0060, 0.6525, 0.1650]",
                4,
                {"front_left", "'control arm'", "mm"}},
        Mistake{"LockedLinkage",
                car_file,
                "tie_rod_outer_m = [0.1115, 0.6969, 0.1900]",
                "tie_rod_outer_m = [-0.0060, 0.6525, 0.1650]",
                4,
                {"front_left", "locked"}},
        Mistake{"GainBeyondTheLimit",
                paper_file,
                "stabilization = \"paper\"",
                "stabilization_gain_per_s = 600",
                3,
                {"stabilization_gain_per_s", "600", "545.5", "[1/s]"}},
        Mistake{"StepTooLargeForTheGain",
                paper_file,
                "step_s = 0.001\nintegrator = \"ab3\"\nconstraints = \"stabilized\"\nstabilization = \"paper\"",
                "step_s = 0.0015\nconstraints = \"stabilized\"\nstabilization_gain_per_s = 400",
                3,
                {":12:28:", "stabilization_gain_per_s", "400", "363.6", "a step below 0.00136 s"}},
        Mistake{"NanInATable", paper_file, "35.0, 0.0, -35.0", "nan, 0.0, -35.0", 3, {"nan"}},
        Mistake{"TimesThatDoNotIncrease", paper_file, "8.0, 9.0, 10.0", "8.0, 8.0, 10.0", 3, {"time_s"}},
        Mistake{"UnknownIntegrator", paper_file, "\"ab3\"", "\"ab33\"", 3, {"ab33", "ab3"}},
        Mistake{"UnknownChannel",
                hill_file,
                "[output]",
                "[output]\nchannels = [\"chassis.positon.x\"]",
                3,
                {"hill_hold.toml:18:12: ", "chassis.positon.x", "chassis.position.x"}},
        Mistake{"RackBeyondItsTravel",
                paper_file,
                "0.0, 0.0, 35.0",
                "0.0, 0.0, 945.0",
                3,
                {"paper.toml:20:", "steering_wheel", "[m]"}}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_F(Program, SaysWhichFileItCannotRead) {
    const Outcome r = run("run nonesuch.toml");
    EXPECT_EQ(r.code, 5);
    EXPECT_THAT(r.err, HasSubstr("nonesuch.toml"));
    EXPECT_THAT(r.err, HasSubstr("No such file"));
}

TEST_F(Program, SaysWhereItCannotWrite) {
    std::ofstream(folder_ / "taken") << "a file";
    const Outcome r = run("run " + scenario_for(shipped) + " -o taken/results");
    EXPECT_EQ(r.code, 5);
    EXPECT_THAT(r.err, HasSubstr("taken/results"));
}

TEST_F(Program, SaysThatTheDiskIsFullAndKeepsWhatIsThere) {
    const std::string scenario = scenario_for(shipped, "[output]\ninterval_s = 0.001\nnetcdf = false\n");
    const Outcome r = run("run " + scenario + " -o results");  // measure, then run again with too little room
    ASSERT_EQ(r.code, 0);
    const std::string limited =
        "sh -c \"trap '' XFSZ; ulimit -f 100; '" + test::program_path() + "' run " + scenario + " -o full\"";
    const int status = std::system(("cd '" + folder_.string() + "' && " + limited + " >out.txt 2>err.txt").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 5) << contents(folder_ / "err.txt");
    EXPECT_THAT(contents(folder_ / "err.txt"), HasSubstr("full/results.csv: cannot write row at t ="));
    const std::string kept = contents(folder_ / "full/results.csv");
    EXPECT_GT(kept.size(), 1000u);
    EXPECT_EQ(kept.back(), '\n');
    EXPECT_EQ(contents(folder_ / "results/results.csv").substr(0, kept.size()), kept);
}

TEST_F(Program, TellsItsVersionAndItsEngines) {
    const Outcome r = run("--version");
    EXPECT_EQ(r.code, 0);
    EXPECT_THAT(r.out, testing::MatchesRegex("hamilcar [0-9.]+\nengines: ((avx512|avx2|sse2), )*portable\n"));
}

TEST_F(Program, MeasuresTheMachine) {
    const Outcome table = run("bench --seconds 0.1");
    EXPECT_EQ(table.code, 0) << table.err;
    EXPECT_EQ(table.err, "");
    for (const char* part : {"One car", "Many cars", "Snapshot", "Step jitter", "lane change"}) {
        EXPECT_THAT(table.out, HasSubstr(part));
    }
    const Outcome json = run("bench --seconds 0.1 --json");
    EXPECT_EQ(json.code, 0) << json.err;
    const auto facts = nlohmann::json::parse(json.out);
    EXPECT_GT(facts["one_car"][0]["step_ns"], 0);
    EXPECT_GT(facts["batch"][0]["share_of_peak"], 0);
    for (const auto& trial : facts["work_precision"]) EXPECT_LT(trial["path_error_m"], 1e-3) << trial;
    EXPECT_EQ(run("bench --seconds 0").code, 2);
    EXPECT_EQ(run("bench missing.toml").code, 5);
}

TEST_F(Program, KeepsNoEnergyBalanceThatIsNotWanted) {
    const Outcome r = run("run " + scenario_for(shipped, "[solver]\nenergy_balance = false\n") + " -o results");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_THAT(r.out, HasSubstr("no balance kept"));
    EXPECT_THAT(contents(folder_ / "results/summary.json"), HasSubstr("\"max_balance_error_J\": null"));
}

TEST_F(Program, StopsAtTheStepThatGoesBad) {
    const std::string vehicle = changed(car_file, "carcass_damping_s = 0.004", "vertical_stiffness_N_per_m = 180e9");
    const Outcome r =
        run("run " + scenario_for(vehicle, "[initial]\nsettle = false\nheight_m = 0.01\n") + " -o results");
    EXPECT_EQ(r.code, 4) << r.err;
    EXPECT_THAT(r.err, HasSubstr("the results end at t ="));
    EXPECT_GT(fs::file_size(folder_ / "results/results.csv"), 100u);
}

TEST_F(Program, WarnsWhenTheStepIsTooLargeForTheEnergyBalance) {
    const auto with_step = [&](const std::string& step) {
        return run("run " +
                   scenario_for(shipped, "[solver]\nstep_s = " + step +
                                             "\nintegrator = \"rk4\"\n[initial]\n"
                                             "velocity_m_per_s = 20\n") +
                   " -o results");
    };
    const Outcome doubtful = with_step("0.0165"), wrong = with_step("0.02");  // off by 4 and by 10.3 percent
    EXPECT_EQ(doubtful.code, 0);
    EXPECT_THAT(doubtful.err, HasSubstr("warning: energy account: balance error"));
    EXPECT_THAT(doubtful.err, HasSubstr("warning: solver: step 0.0165 s"));
    EXPECT_THAT(doubtful.out, HasSubstr("validity         solver: step 0.0165 s"));
    const auto facts = nlohmann::json::parse(contents(folder_ / "results/summary.json"));
    ASSERT_EQ(facts["validity"].size(), 2u) << facts["validity"];
    EXPECT_EQ(facts["validity"][0]["kind"], "energy_balance");
    EXPECT_EQ(facts["validity"][1]["kind"], "step");
    EXPECT_LT(facts["validity"][1]["limit"].get<double>(), 0.0165);
    EXPECT_THAT(contents(folder_ / "results/report.html"), HasSubstr("Limits of validity"));
    EXPECT_EQ(wrong.code, 4);
    EXPECT_THAT(wrong.err, HasSubstr("more than 10 %"));
}

TEST_F(Program, RefusesInputsThatNothingListensTo) {
    const std::string car = changed(car_file, "drive_share = 1.0", "drive_share = 0.0");
    const Outcome r = run("run " + scenario_for(car, "[inputs.drive]\ntorque_N_m = 300.0\n") + " -o results");
    EXPECT_EQ(r.code, 3);
    EXPECT_THAT(r.err, HasSubstr("no axle of BMW 323i (E30) is driven"));
}

TEST_F(Program, HelpsWithTheCommandLine) {
    EXPECT_EQ(run("--help").code, 0);
    const Outcome nothing = run("");
    EXPECT_EQ(nothing.code, 2);
    EXPECT_THAT(nothing.err, HasSubstr("expected a command: 'new', 'run', "));
    const Outcome mistyped = run("rum x.toml");
    EXPECT_EQ(mistyped.code, 2);
    EXPECT_THAT(mistyped.err, HasSubstr("did you mean 'run'?"));
    EXPECT_EQ(run("run").code, 2);
    const Outcome word = run("schema vehicles");
    EXPECT_EQ(word.code, 2);
    EXPECT_THAT(word.err,
                HasSubstr("kind: 'vehicles': expected 'vehicle', 'scenario' or 'study'; did you mean 'vehicle'?"));
    for (const char* number : {"0.5", "nan", "fast"}) {
        const Outcome outside = run("kinematics car.toml --travel " + std::string(number));
        EXPECT_EQ(outside.code, 2);
        EXPECT_THAT(outside.err,
                    HasSubstr("--travel: '" + std::string(number) + "': expected a number from 1 to 1000 mm"));
    }
    EXPECT_THAT(run("kinematics --help").out, HasSubstr("of the wheels, each way [80 mm]"));
    for (const std::string kind : {"scenario", "study"}) {
        EXPECT_EQ(run("schema " + kind).out, contents(test::source_path("schemas/" + kind + ".schema.json")));
    }
    EXPECT_THAT(run("--version").out, HasSubstr("hamilcar 0."));
}

}  // namespace
}  // namespace hamilcar
