// The numbers of a document by their names: all of them, with what they may be, and each name reaches its number.
#include "hamilcar/io/key_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/set_key.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "support/fleet.hpp"
#include "support/paths.hpp"

namespace hamilcar::io {
namespace {

std::vector<NamedNumber> numbers_of_vehicle(const Node& document) {
    return numbers_in(document, format_of([](const TableReader& file) { read_vehicle(file); }));
}
std::vector<std::string> fleet_paths() {
    std::vector<std::string> out;
    for (const std::string& name : test::fleet()) out.push_back(test::source_path("vehicles/" + name + ".toml"));
    return out;
}
const NamedNumber& called(const std::vector<NamedNumber>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &NamedNumber::name);
    if (found == all.end()) throw std::out_of_range(name);
    return *found;
}

TEST(KeyList, TellsUnitRangeAndDefault) {
    const std::vector<NamedNumber> all = numbers_of_vehicle(read_toml(test::source_path("vehicles/bmw_323i.toml")));
    const NamedNumber& mass = called(all, "chassis.mass_kg");
    EXPECT_EQ(mass.unit, "kg");
    EXPECT_EQ(mass.min, 0);
    EXPECT_FALSE(mass.min_included);
    EXPECT_TRUE(std::isinf(mass.max));
    EXPECT_FALSE(mass.is_default);
    const NamedNumber& gravity = called(all, "gravity_m_per_s2");
    EXPECT_EQ(gravity.value, 9.80665);
    EXPECT_TRUE(gravity.is_default);
    EXPECT_EQ(called(all, "chassis.center_of_mass_m.2").unit, "m");
    EXPECT_EQ(called(all, "axle.front.spring.rate_N_per_m").unit, "N/m");
}

// Whatever the kinds of suspensions and tires of a vehicle.
TEST(KeyList, NamesThatReachTheirNumbers) {
    for (const std::string& path : fleet_paths()) {
        const Node document = read_toml(path);
        const std::vector<NamedNumber> all = numbers_of_vehicle(document);
        EXPECT_GT(all.size(), 100u) << path;
        for (const NamedNumber& one : all) {
            const Node* there = value_at(document, one.name);
            EXPECT_EQ(there == nullptr, one.is_default) << path << ": " << one.name;
            EXPECT_EQ(there ? std::get<double>(there->value) : one.value, one.value) << path << ": " << one.name;
            EXPECT_LE(one.min, one.value) << path << ": " << one.name;
            EXPECT_GE(one.max, one.value) << path << ": " << one.name;
        }
    }
}

// Every number of the file itself is in the list: no table is passed over.
TEST(KeyList, LeavesNoNumberOfAFileOut) {
    std::size_t numbers = 0;
    const std::function<void(const Node&)> count = [&](const Node& node) {
        if (std::holds_alternative<double>(node.value)) ++numbers;
        if (const auto* list = std::get_if<ListValue>(&node.value)) std::ranges::for_each(list->items, count);
        if (const auto* table = std::get_if<TableValue>(&node.value)) std::ranges::for_each(table->entries, count);
    };
    for (const std::string& path : fleet_paths()) {
        const Node document = read_toml(path);
        numbers = 0;
        count(document);
        std::size_t listed = 0;
        for (const NamedNumber& one : numbers_of_vehicle(document)) listed += !one.is_default;
        EXPECT_EQ(listed, numbers) << path;
    }
}

TEST(KeyList, KnowsScenariosToo) {
    const Node document = read_toml(test::source_path("scenarios/step_steer.toml"));
    const auto all = numbers_in(document, format_of([](const TableReader& file) { read_scenario(file); }));
    EXPECT_EQ(called(all, "initial.velocity_m_per_s").value, 20);
    EXPECT_EQ(called(all, "inputs.steering_wheel.angle_deg.1").value, 30);
    EXPECT_EQ(called(all, "inputs.steering_wheel.angle_deg.1").unit, "deg");
    EXPECT_EQ(called(all, "solver.step_s").max, 0.1);
}

TEST(ValueAt, IsNothingWhereNothingStands) {
    const Node document = read_toml(test::source_path("vehicles/bmw_323i.toml"));
    for (const char* key : {"", "chassis.", "chassis.mas_kg", "axle.middle.spring", "axle.9", "chassis.mass_kg.more",
                            "chassis.center_of_mass_m.3", "axle[front"}) {
        EXPECT_EQ(value_at(document, key), nullptr) << key;
    }
}

}  // namespace
}  // namespace hamilcar::io
