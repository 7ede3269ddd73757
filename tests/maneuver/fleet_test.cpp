// Every maneuver on every shipped vehicle that can do it, at a coarse setting: it is driven or says why not, its energy adds up,
// and what it reports is a number or is missing with a reason.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/maneuver/common.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> vehicles() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(test::source_path("vehicles"))) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

// Searches and series cut short: what a setting of that name counts.
Settings coarse(const Maneuver& maneuver, const VehicleDescription& vehicle) {
    Settings chosen;
    for (const Setting& setting : maneuver.settings(vehicle)) {
        if (setting.name == "search" || setting.name == "top_speed") chosen[setting.name] = 0;
        if (setting.name == "amplitudes") chosen[setting.name] = std::max(setting.least, 1.0);
    }
    return chosen;
}

// What shipped vehicles cannot drive to its end: vehicle, maneuver. Nothing else may fail.
const std::set<std::pair<std::string, std::string>> expected_failures{};

class Fleet : public testing::TestWithParam<std::string> {};

TEST_P(Fleet, DrivesEveryManeuver) {
    const VehicleDescription vehicle = io::read_vehicle(test::source_path("vehicles/" + GetParam() + ".toml"));
    int driven = 0;
    for (const Maneuver& maneuver : maneuvers()) {
        SCOPED_TRACE(maneuver.name);
        if (!maneuver.obstacle(vehicle).empty()) continue;
        ++driven;
        ManeuverOptions options;
        options.keep_runs = false;
        const Outcome outcome =
            maneuver.drive(vehicle, complete_settings(maneuver, vehicle, coarse(maneuver, vehicle)), options);
        EXPECT_FALSE(outcome.figures.empty() && !outcome.failed);
        EXPECT_LT(std::abs(outcome.energy.gap()), 1e-3 * outcome.energy.turnover) << "the books do not close";
        EXPECT_TRUE(outcome.runs.empty());
        for (const Figure& figure : outcome.figures) {
            EXPECT_FALSE(std::isinf(figure.value)) << figure.name;
            EXPECT_FALSE(figure.name.empty());
        }
        for (const io::Chart& chart : outcome.charts) EXPECT_FALSE(chart.title.empty() || chart.x_label.empty());
        EXPECT_EQ(outcome.failed.has_value(), expected_failures.contains({GetParam(), maneuver.name}))
            << outcome.failed.value_or("was driven");
        EXPECT_FALSE(outcome.failed.value_or("driven").empty());
    }
    EXPECT_GE(driven, GetParam().find("paper") != std::string::npos ? 15 : 19);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Fleet, testing::ValuesIn(vehicles()),
                         [](const auto& vehicle) { return vehicle.param; });

TEST(Maneuvers, AreListedOnceWithTheirSettings) {
    std::set<std::string> names;
    for (const Maneuver& maneuver : maneuvers()) {
        EXPECT_TRUE(names.insert(maneuver.name).second) << maneuver.name;
        EXPECT_EQ(find_maneuver(maneuver.name), &maneuver);
        EXPECT_FALSE(maneuver.title.empty() || maneuver.standard.empty() || maneuver.summary.empty());
        std::set<std::string> keys;
        for (const Setting& setting : maneuver.settings(test::shipped_car())) {
            EXPECT_TRUE(keys.insert(setting.name).second) << setting.name;
            EXPECT_LE(setting.least, setting.usual) << maneuver.name << ", " << setting.name;
            EXPECT_LE(setting.usual, setting.most) << maneuver.name << ", " << setting.name;
            EXPECT_FALSE(setting.meaning.empty());
        }
        EXPECT_TRUE(fs::exists(test::source_path("docs/maneuvers/" + maneuver.name + ".md"))) << maneuver.name;
        EXPECT_TRUE(fs::exists(test::source_path("scenarios/maneuvers/" + maneuver.name + ".toml"))) << maneuver.name;
    }
    EXPECT_EQ(find_maneuver("sideways"), nullptr);
}

TEST(Maneuvers, RefuseSettingsThatDoNotExistOrLieOutside) {
    const Maneuver& maneuver = *find_maneuver("double_lane_change");
    const VehicleDescription car = test::shipped_car();
    EXPECT_THROW(complete_settings(maneuver, car, {{"sped", 80}}), io::Error);
    EXPECT_THROW(complete_settings(maneuver, car, {{"speed", 1e6}}), io::Error);
    EXPECT_THROW(complete_settings(maneuver, car, {{"speed", std::nan("")}}), io::Error);
    EXPECT_EQ(complete_settings(maneuver, car, {{"speed_km_per_h", 70}}).at("speed"), 70);
}

}  // namespace
}  // namespace hamilcar
