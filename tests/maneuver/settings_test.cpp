// Settings by name and by key, and the numbers that each may have.
#include <gtest/gtest.h>

#include "hamilcar/io/error.hpp"
#include "hamilcar/maneuver/maneuver.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

// What is said of settings that cannot be; empty where they can.
std::string refused(const std::string& maneuver, const Settings& chosen) {
    try {
        complete_settings(*find_maneuver(maneuver), test::shipped_car(), chosen);
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::bad_file);
        EXPECT_NE(error.key(), "");
        return error.what();
    }
    return "";
}

bool says(const std::string& message, const std::string& words) {
    return message.find(words) != std::string::npos;
}

TEST(Settings, GoByOneNameWhicheverSpellingWasUsed) {
    const VehicleDescription car = test::shipped_car();
    const Maneuver& maneuver = *find_maneuver("step_steer");
    const Settings chosen = chosen_settings(maneuver, car, {{"speed_km_per_h", 120}});
    EXPECT_EQ(chosen, (Settings{{"speed", 120}}));
    EXPECT_TRUE(says(refused("step_steer", {{"speed", 90}, {"speed_km_per_h", 120}}), "each setting once"));
}

TEST(Settings, ThatAreCountsOrSwitchesTakeNothingBetween) {
    EXPECT_TRUE(says(refused("fishhook", {{"feedback", 0.3}}), "= 0.3: expected 'yes' or 'no'"));
    EXPECT_TRUE(says(refused("split_braking", {{"low_side", 0}}), "= 0: expected 'left' or 'right'"));
    EXPECT_TRUE(says(refused("split_braking", {{"low_side", 0.5}}), "= 0.5: expected 'left' or 'right'"));
    EXPECT_TRUE(says(refused("double_lane_change", {{"attempts", 2.5}}), "a whole number, 1 to 20"));
    for (const auto& [name, setting] :
         std::vector<std::pair<std::string, std::string>>{{"double_lane_change", "search"},
                                                          {"split_braking", "steering"},
                                                          {"straight_braking", "engine_connected"},
                                                          {"acceleration", "top_speed"},
                                                          {"acceleration", "elasticity_gear"},
                                                          {"sine_with_dwell", "amplitudes"},
                                                          {"rough_road", "road_class"},
                                                          {"rough_road", "seed"},
                                                          {"random_steer", "seed"},
                                                          {"weave", "periods"}}) {
        EXPECT_NE(refused(name, {{setting, 1.5}}), "") << name << ", " << setting;
        EXPECT_EQ(refused(name, {{setting, 1}}), "") << name << ", " << setting;
    }
}

TEST(Settings, GoByWordsOrByTheNumbersThatStandForThem) {
    const VehicleDescription car = test::shipped_car();
    const Maneuver &split = *find_maneuver("split_braking"), &hook = *find_maneuver("fishhook");
    for (const char* side : {"right", "Right"}) {
        EXPECT_EQ(settings_in_numbers(split, car, {{"low_side", side}}), (Settings{{"low_side", -1}})) << side;
    }
    EXPECT_EQ(settings_in_numbers(split, car, {{"low_side", -1.0}}), (Settings{{"low_side", -1}}));
    for (const char* on : {"yes", "true", "on"}) {
        EXPECT_EQ(settings_in_numbers(hook, car, {{"feedback", on}}), (Settings{{"feedback", 1}})) << on;
    }
    for (const char* off : {"no", "false", "off"}) {
        EXPECT_EQ(settings_in_numbers(hook, car, {{"feedback", off}}), (Settings{{"feedback", 0}})) << off;
    }
    EXPECT_EQ(settings_in_numbers(split, car, {{"speed_km_per_h", 70.0}}), (Settings{{"speed_km_per_h", 70}}));
}

TEST(Settings, TellTheirWordsAndTheNearestOne) {
    const VehicleDescription car = test::shipped_car();
    const auto told = [&](const char* setting, const char* word) -> std::string {
        try {
            settings_in_numbers(*find_maneuver("split_braking"), car, {{setting, word}});
        } catch (const io::Error& error) {
            EXPECT_EQ(error.key(), std::string("maneuver.settings.") + setting);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(told("low_side", "lefft"),
              "setting 'low_side' of maneuver 'split_braking' = 'lefft': expected 'left' or 'right'; did you mean "
              "'left'?");
    EXPECT_TRUE(says(told("steering", "yess"), "expected 'yes' or 'no'; did you mean 'yes'?"));
    EXPECT_TRUE(says(told("speed", "fast"), "= 'fast': expected 20 to 200 [km/h]"));
    EXPECT_TRUE(says(told("low_sid", "left"), "did you mean 'low_side'?"));
}

TEST(Settings, TellTheirRangeAndUnit) {
    EXPECT_TRUE(says(refused("step_steer", {{"speed", 1e6}}), "20 to 250 [km/h]"));
    EXPECT_TRUE(says(refused("step_steer", {{"sped", 80}}), "did you mean 'speed'?"));
}

}  // namespace
}  // namespace hamilcar
