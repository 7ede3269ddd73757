// Every maneuver on every shipped vehicle that can do it, at a coarse setting: it is driven or says why not, its energy adds up,
// and it finds the figures and verdicts that are kept in figures/VEHICLE.tsv. Where a change of these is meant,
// HAMILCAR_KEEP_FIGURES=tests/maneuver/figures has the test write them anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/maneuver/test_run.hpp"
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
        if (setting.name == "amplitudes") chosen[setting.name] = 1;
    }
    return chosen;
}

// What shipped vehicles cannot drive to its end: vehicle, maneuver. Nothing else may fail.
const std::set<std::pair<std::string, std::string>> expected_failures{};

// Figures by maneuver and name; verdicts with 1 for passed.
using Found = std::map<std::string, double>;

void add(const Maneuver& maneuver, const Outcome& outcome, Found& found) {
    for (const Figure& figure : outcome.figures) {
        found[fmt::format("{}\t{}\t{}", maneuver.name, figure.name, figure.unit)] = figure.value;
    }
    for (const Verdict& verdict : outcome.verdicts) {
        found[fmt::format("{}\t{}\tpassed", maneuver.name, verdict.criterion)] = verdict.passed;
    }
}

void write(const std::string& path, const Found& found) {
    std::ofstream file(path);
    for (const auto& [name, value] : found) file << fmt::format("{}\t{:.9g}\n", name, value);
}

Found kept(const std::string& path) {
    Found out;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        const std::size_t tab = line.rfind('\t');
        out[line.substr(0, tab)] = std::stod(line.substr(tab + 1));
    }
    return out;
}

void expect_kept(const Found& found, const std::string& vehicle) {
    if (const char* folder = std::getenv("HAMILCAR_KEEP_FIGURES")) {
        write(std::string(folder) + "/" + vehicle + ".tsv", found);
        return;
    }
    const Found before = kept(test::source_path("tests/maneuver/figures/" + vehicle + ".tsv"));
    EXPECT_GT(before.size(), 200u);
    for (const auto& [name, value] : before) {
        const auto now = found.find(name);
        if (now == found.end()) {
            ADD_FAILURE() << "no longer found: " << name;
        } else if (std::isnan(value)) {
            EXPECT_TRUE(std::isnan(now->second)) << name;
        } else {
            // Compilers may differ in the last bits, which a driver's feedback carries on.
            EXPECT_NEAR(now->second, value, 1e-6 * std::abs(value) + 1e-6) << name;
        }
    }
    for (const auto& [name, value] : found) EXPECT_TRUE(before.contains(name)) << "not kept: " << name;
}

class Fleet : public testing::TestWithParam<std::string> {};

TEST_P(Fleet, DrivesEveryManeuver) {
    const VehicleDescription vehicle = io::read_vehicle(test::source_path("vehicles/" + GetParam() + ".toml"));
    int driven = 0;
    Found found;
    for (const Maneuver& maneuver : maneuvers()) {
        SCOPED_TRACE(maneuver.name);
        if (!maneuver.unsupported_reason(vehicle).empty()) continue;
        ++driven;
        ManeuverOptions options;
        options.keep_runs = false;
        const Outcome outcome =
            maneuver.drive(vehicle, complete_settings(maneuver, vehicle, coarse(maneuver, vehicle)), options);
        EXPECT_FALSE(outcome.figures.empty() && !outcome.failed);
        EXPECT_LT(std::abs(outcome.energy.residual()), 1e-3 * outcome.energy.exchanged)
            << "the energy account does not balance";
        EXPECT_TRUE(outcome.runs.empty());
        for (const Figure& figure : outcome.figures) {
            EXPECT_FALSE(std::isinf(figure.value)) << figure.name;
            EXPECT_FALSE(figure.name.empty());
        }
        for (const io::Chart& chart : outcome.charts) EXPECT_FALSE(chart.title.empty() || chart.x_label.empty());
        EXPECT_EQ(outcome.failed.has_value(), expected_failures.contains({GetParam(), maneuver.name}))
            << outcome.failed.value_or("was driven");
        EXPECT_FALSE(outcome.failed.value_or("driven").empty());
        add(maneuver, outcome, found);
    }
    expect_kept(found, GetParam());
    EXPECT_GE(driven, GetParam().find("paper") != std::string::npos ? 16 : 20);
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
            EXPECT_LE(setting.min, setting.default_value) << maneuver.name << ", " << setting.name;
            EXPECT_LE(setting.default_value, setting.max) << maneuver.name << ", " << setting.name;
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
