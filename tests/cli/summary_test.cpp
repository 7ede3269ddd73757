// What the program says of a run and of a tire, in words that cannot be taken for something else.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "cli/program.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;
using testing::Not;

// A car that drives to the left of the ground's x axis: its speed is no component of its velocity.
TEST_F(Program, SaysInWhichAxesTheVelocityIs) {
    const std::string scenario = scenario_for(test::source_path("vehicles/bmw_323i.toml"),
                                              "[initial]\nvelocity_m_per_s = 10.0\nyaw_deg = 90\n"
                                              "[output]\ncsv = false\nreport = false\n");
    const Outcome r = run("run " + scenario + " -o out");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, testing::ContainsRegex("velocity in ground axes x 0\\.000, y 9\\.[0-9]+, z 0\\.[0-9]+ m/s; "
                                              "speed 9\\.[0-9]+ m/s"));
    EXPECT_THAT(r.out, Not(HasSubstr("-0.000")));
}

TEST_F(Program, HasNoTrailForATireWithoutCorneringStiffness) {
    const std::string tire = changed("vehicles/tires/pacejka_205_60_r15.tir", "USE_MODE = 14", "USE_MODE = 1");
    const Outcome r = run("tire " + tire);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("none\n"));
    EXPECT_THAT(r.out, Not(HasSubstr("nan")));
    const auto facts = nlohmann::json::parse(run("tire --json " + tire).out);
    EXPECT_TRUE(facts["loads"][0]["pneumatic_trail_m"].is_null());
}

}  // namespace
}  // namespace hamilcar
