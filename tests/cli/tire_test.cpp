// `hamilcar tire` and `hamilcar road` as a person meets them: figures, tables, remarks, files.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string shipped_car_file = test::source_path("vehicles/bmw_323i.toml");
const char* const tire_file = "vehicles/tires/pacejka_205_60_r15.tir";

TEST_F(Program, ShowsATiresFigures) {
    const Outcome r = run("tire " + test::source_path(tire_file) + " -o tire");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("MF-Tyre 6.0 (FITTYP 60)"));
    EXPECT_THAT(r.out, testing::Not(HasSubstr("note:"))) << "the shipped file leaves nothing open";
    for (const char* name : {"tire/longitudinal.csv", "tire/lateral.csv", "tire/tire.html"}) {
        EXPECT_TRUE(fs::exists(folder_ / name)) << name;
    }
    const std::string lateral = contents(folder_ / "tire/lateral.csv");
    EXPECT_THAT(lateral, testing::StartsWith("load [N],slip angle [deg],Fx [N],Fy [N],"));
    EXPECT_EQ(std::count(lateral.begin(), lateral.end(), '\n'), 1 + 5 * 121);

    const Outcome json = run("tire --json " + test::source_path(tire_file));
    const auto facts = nlohmann::json::parse(json.out);
    // PKY1 FNOMIN sin(2 atan(1 / PKY2)) at the nominal load, per degree.
    const double stiffness = 14.95 * 4000 * std::sin(2 * std::atan(1 / 2.13)) * std::acos(-1.0) / 180;
    EXPECT_NEAR(facts["loads"][2]["cornering_stiffness_N_per_deg"].get<double>(), stiffness, 0.01 * stiffness);
    EXPECT_NEAR(facts["loads"][2]["peak_friction_longitudinal"].get<double>(), 1.21, 0.001);
}

TEST_F(Program, SaysWhatATireFileLeavesOpen) {
    const std::string tire = changed(tire_file, "PKX2 = -0.163", "PKX9 = -0.163");
    const Outcome r = run("tire " + tire);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("note: " + tire + ": 1 coefficients are not in the file and taken as: PKX2 = 0"));
    EXPECT_THAT(r.out, HasSubstr("key 'PKX9' in [LONGITUDINAL_COEFFICIENTS] is not known and not used"));
    const std::string car = changed("vehicles/bmw_323i.toml", "carcass_damping_s = 0.004", "friction_scale = 0.9");
    std::string text = contents(car);
    const std::string before = test::source_path(tire_file);
    text.replace(text.find(before), before.size(), tire);
    std::ofstream(car) << text;
    const Outcome check = run("check " + car);
    ASSERT_EQ(check.code, 0) << check.err;
    EXPECT_THAT(check.out, HasSubstr("key 'PKX9'")) << "a vehicle's check shows it as well";
}

TEST_F(Program, TellsATireFilesMistake) {
    const std::string tire = changed(tire_file, "FNOMIN = 4000", "FNOMIN = heavy");
    const Outcome r = run("tire " + tire);
    EXPECT_EQ(r.code, 3);
    EXPECT_THAT(r.err, HasSubstr(tire + ":"));
    EXPECT_THAT(r.err, HasSubstr("key 'FNOMIN' = 'heavy': expected a number"));
    EXPECT_EQ(run("tire nowhere.tir").code, 5);
}

// The road that the program writes is the road that it drives on.
TEST_F(Program, ShowsARoadAndWritesItAsOpenCrg) {
    const std::string road = "[[road.random]]\nclass = \"D\"\nstart_m = -50.0\n";
    const std::string rough = scenario_for(shipped_car_file, road);
    const Outcome r = run("road --json " + rough + " -o road.crg --length 1500");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto facts = nlohmann::json::parse(r.out);
    for (const auto& track : facts["tracks"]) EXPECT_EQ(track["iso_8608_class"], "D");
    const fs::path own = folder_ / "own.toml";
    fs::rename(rough, own);
    const std::string from_file = scenario_for(shipped_car_file, "[road]\ncrg_file = \"road.crg\"\n");
    const auto same = nlohmann::json::parse(run("road --json --length 1500 " + from_file).out);
    EXPECT_NEAR(same["tracks"][0]["highest_m"].get<double>(), facts["tracks"][0]["highest_m"].get<double>(), 2e-4)
        << "sections stand every 0.1 m and the track between two of them";
    const Outcome drive = run("run --json " + from_file + " -o drive");
    EXPECT_EQ(drive.code, 0) << drive.err;
    EXPECT_EQ(run("road " + from_file + " -o nowhere/x.crg").code, 5);
}

}  // namespace
}  // namespace hamilcar
