// `hamilcar check`: what it shows of a vehicle, what it finds odd, and how it ends.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

const std::string shipped = test::source_path("vehicles/bmw_323i.toml");

TEST_F(Program, ChecksAVehicleAndCountsTenDegreesOfFreedom) {
    const Outcome r = run("check --structure " + shipped);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("degrees of freedom       10"));
    EXPECT_THAT(r.out, HasSubstr("5 x 7 = 35 coordinates - 25 constraints = 10"));
    const Outcome other = run("check --structure " + test::source_path("vehicles/bmw_e90_330i.toml"));
    EXPECT_THAT(other.out, HasSubstr("degrees of freedom       10"));
    EXPECT_THAT(other.out, testing::Not(HasSubstr("Table 2"))) << "five links are not of the paper's shape";
    const auto facts = nlohmann::json::parse(run("check --json " + shipped).out);
    EXPECT_EQ(facts["degrees_of_freedom"], 10);
    EXPECT_EQ(facts["bodies"], 5);
    EXPECT_EQ(facts["cut_equations"], 6);
}

TEST_F(Program, ShowsTheRightWheelWhereItDiffers) {
    const Outcome both = run("kinematics " + shipped + " --vehicle-set axle.front.right.alignment.camber_deg=-2");
    EXPECT_THAT(both.out, HasSubstr("-0.690 deg, right -2.000 deg"));
    EXPECT_THAT(run("kinematics " + shipped).out, testing::Not(HasSubstr("right")));
}

TEST_F(Program, ChecksAVehicleAsAColleagueWould) {
    const Outcome r = run("check --strict " + shipped);
    ASSERT_EQ(r.code, 0) << r.err;
    for (const char* piece : {"wheelbase                2.570 m", "steering ratio", "turning circle", "axle 2 (rear)",
                              "front wheel hop", "static stability factor", "cross weight 50.00 %"})
        EXPECT_THAT(r.out, HasSubstr(piece));
    EXPECT_THAT(r.out, testing::Not(HasSubstr("Table 2"))) << "the paper's only where it is asked";
    const std::string car = changed("vehicles/bmw_323i.toml", "per_revolution = 0.0365", "per_revolution = 36.5");
    const Outcome odd = run("check " + car), strict = run("check --strict " + car);
    EXPECT_EQ(odd.code, 0) << odd.err;
    EXPECT_THAT(odd.out, HasSubstr(": ok, but 1 thing is odd"));
    EXPECT_THAT(odd.out, HasSubstr("odd: steering: the ratio is"));
    EXPECT_EQ(strict.code, 3);
    EXPECT_EQ(nlohmann::json::parse(run("check --json " + car).out)["odd"][0]["where"], "steering");
}

TEST_F(Program, TellsThePreloadsThatItFinds) {
    const std::string car =
        changed("vehicles/bmw_323i.toml", "force_at_design_N = ", "force_at_design_N = \"carry\" # ");
    const Outcome r = run("check --strict " + car);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out,
                testing::ContainsRegex("note: front_left: the spring carries its share at design with [0-9.]+ N\n"));
    EXPECT_THAT(r.out, HasSubstr("note: front_right: "));
    EXPECT_THAT(r.out, testing::Not(HasSubstr("note: rear_left: "))) << "its force is given";
}

TEST_F(Program, ChecksAScenarioThatInheritsItsVehicle) {
    const std::string base = scenario_for(shipped);
    std::ofstream(folder_ / "derived.toml") << "base = \"scenario.toml\"\nduration_s = 2.0\n";
    EXPECT_EQ(run("check derived.toml").code, 0);
}

}  // namespace
}  // namespace hamilcar
