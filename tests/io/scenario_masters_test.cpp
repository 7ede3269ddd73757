// Who drives in a scenario: every control has one master, and a maneuver is that of all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files.hpp"
#include "hamilcar/io/scenario_file.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;

const std::string minimal = "name = 'rest'\nvehicle = '../vehicles/car.toml'\nduration_s = 2\n";

std::string masters(const std::string& text, const std::string& base = "") {
    const TemporaryFolder folder;
    if (!base.empty()) folder.write("base.toml", minimal + base);
    try {
        read_scenario(folder.write("s.toml", (base.empty() ? minimal : "base = 'base.toml'\n") + text));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

const std::string speed = "[driver.speed]\nspeed_m_per_s = 5\n", gear = "[driver.gear]\nnumber = 2\n";
const std::string follow = "[driver.path]\nx_m = [0, 9]\ny_m = [0, 0]\n", maneuver = "[maneuver]\nname = 'weave'\n";

TEST(Masters, AreOneForEveryControl) {
    const auto both = [](const std::string& first, const std::string& second) {
        return testing::HasSubstr("'" + second + "' = a table: expected either this or '" + first + "', not both");
    };
    const std::string brake = "[inputs.brake]\ncommand = 0.1\n", wheel = "[inputs.steering_wheel]\nangle_deg = 9\n";
    EXPECT_THAT(masters(follow + wheel), both("driver.path", "inputs.steering_wheel"));
    EXPECT_THAT(masters(follow + "[inputs.rack]\ndisplacement_m = 0\n"), both("driver.path", "inputs.rack"));
    EXPECT_THAT(masters(speed + brake), both("driver.speed", "inputs.brake"));
    EXPECT_THAT(masters(speed + "[inputs.drive]\ntorque_N_m = 9\n"), both("driver.speed", "inputs.drive"));
    EXPECT_THAT(masters(speed + "[inputs.throttle]\npedal = 0.1\n"), both("driver.speed", "inputs.throttle"));
    EXPECT_THAT(masters(gear + "[inputs.gear]\nnumber = 1\n"), both("driver.gear", "inputs.gear"));
    EXPECT_THAT(masters(gear + "[inputs.clutch]\npedal = 0\n"), both("driver.gear", "inputs.clutch"));
    EXPECT_THAT(masters(maneuver + speed), both("maneuver", "driver"));
    EXPECT_THAT(masters(maneuver + brake), both("maneuver", "inputs"));
    EXPECT_THAT(masters(maneuver + "[initial]\nyaw_deg = 1\n"), both("maneuver", "initial"));
    EXPECT_THAT(masters(maneuver + "[wind]\nspeed_m_per_s = 25\n"), both("maneuver", "wind"));
    EXPECT_THAT(masters(maneuver + "[output]\ncsv = false\n"), both("maneuver", "output"));
    EXPECT_THAT(masters(maneuver + "[[course.cone]]\nposition_m = [0, 0]\n"), both("maneuver", "course"));
    EXPECT_THAT(masters(maneuver),
                testing::HasSubstr("'duration_s' = 2: expected either this or 'maneuver', not both"));
    for (const std::string& meant :
         {speed + "may_brake = false\n" + brake + wheel, speed + "[inputs.gear]\nnumber = 2\n",
          gear + "[inputs.throttle]\npedal = 0.1\n" + brake, follow + speed + gear, follow + brake}) {
        EXPECT_EQ(masters(meant), "") << meant;
    }
}

TEST(Masters, OfAFileOverrideThoseItInherits) {
    const TemporaryFolder folder;
    const std::string brake = "[inputs.brake]\ncommand = 0.1\n";
    folder.write("braked.toml", minimal + brake + "[inputs.gear]\nnumber = 2\n");
    const auto driven = read_scenario(folder.write("driven.toml", "base = 'braked.toml'\n" + speed));
    EXPECT_TRUE(driven.driver.speed && driven.brake.value.empty());
    EXPECT_THAT(driven.gear.value, ElementsAre(2));
    const auto again = read_scenario(folder.write("again.toml", "base = 'driven.toml'\n" + brake));
    EXPECT_FALSE(again.driver.speed);
    EXPECT_THAT(again.brake.value, ElementsAre(0.1));
    const auto woven = read_scenario(folder.write("woven.toml", "base = 'driven.toml'\n" + maneuver));
    EXPECT_EQ(woven.maneuver.name, "weave");
    EXPECT_FALSE(woven.driver.speed || !woven.gear.value.empty());
    EXPECT_THAT(masters(brake, maneuver), testing::HasSubstr("'inputs' = a table: expected either this or 'maneuver'"));
}

}  // namespace
}  // namespace hamilcar::io
