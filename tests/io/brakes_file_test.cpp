// A brake system: what a file says becomes what a description holds, and what it leaves out follows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "brakes_sample.hpp"
#include "hamilcar/io/key_schema.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double bar = 1e5, cm3 = 1e-6;

VehicleDescription read_text(const std::string& text) {
    const TemporaryFolder folder;
    return read_vehicle(folder.write("car.toml", text));
}

const BrakeDescription& brake(const VehicleDescription& car, std::size_t wheel) {
    std::vector<const BrakeDescription*> all;
    for_each_wheel(car, [&](const SuspensionWheelDescription& one, std::size_t) { all.push_back(&one.brake); });
    return *all[wheel];
}

TEST(BrakesFile, ACarWithoutASystemHasNone) {
    const VehicleDescription car = read_text(shipped_car_text());
    EXPECT_FALSE(car.brakes.exists);
    EXPECT_FALSE(car.brakes.modulated);
    EXPECT_EQ(brake(car, 0).volume, 0);
}

// Forces on the master cylinder's rod: the booster's is in proportion up to the knee, and then stays.
TEST(BrakesFile, PressuresAreThoseOfPedalBoosterAndCylinder) {
    const BrakeSystemDescription brakes = read_text(car_with_brakes(fluid_system)).brakes;
    const double area = M_PI / 4 * 0.0238 * 0.0238, input = 300 * 3.5;
    const double input_at_knee = 100 * bar * area / 5, output = 100 * bar * area + (input - input_at_knee);
    EXPECT_TRUE(brakes.exists);
    EXPECT_EQ(brakes.medium, BrakeMedium::fluid);
    EXPECT_EQ(brakes.pedal_force, 300);
    EXPECT_EQ(brakes.pedal_ratio, 3.5);
    EXPECT_DOUBLE_EQ(brakes.master_area, area);
    EXPECT_DOUBLE_EQ(brakes.knee_pressure, 100 * bar);
    EXPECT_DOUBLE_EQ(brakes.knee_command, input_at_knee / input);
    EXPECT_DOUBLE_EQ(brakes.full_pressure, output / area);
    EXPECT_EQ(brakes.response_time, 0.03);
    EXPECT_EQ(brakes.circuits, BrakeCircuits::diagonal);
    EXPECT_EQ(brakes.failed_circuit, 2);
    EXPECT_TRUE(brakes.modulated);
    EXPECT_DOUBLE_EQ(brakes.pump_flow, 8 * cm3);
    EXPECT_DOUBLE_EQ(brakes.pump_pressure, 180 * bar);
}

TEST(BrakesFile, AKneeThatIsNotReachedIsNone) {
    for (const char* knee : {"", "knee_pressure_bar = 500"}) {
        const BrakeSystemDescription brakes =
            read_text(car_with_brakes(changed(fluid_system, "knee_pressure_bar = 100", knee))).brakes;
        EXPECT_EQ(brakes.knee_command, 1) << knee;
        EXPECT_DOUBLE_EQ(brakes.full_pressure, 300 * 3.5 * 5 / brakes.master_area) << knee;
        EXPECT_EQ(brakes.knee_pressure, brakes.full_pressure) << knee;
    }
}

TEST(BrakesFile, WhatASystemLeavesOutFollows) {
    const BrakeSystemDescription brakes = read_text(car_with_brakes(R"([brakes]
pedal_force_N = 500
pedal_ratio = 5
master_cylinder_diameter_mm = 20
)"))
                                              .brakes;
    EXPECT_EQ(brakes.medium, BrakeMedium::fluid);
    EXPECT_DOUBLE_EQ(brakes.full_pressure, 2500 / (M_PI / 4 * 0.02 * 0.02)) << "no booster";
    EXPECT_EQ(brakes.response_time, 0.05);
    EXPECT_EQ(brakes.trailer_response_time, brakes.response_time);
    EXPECT_EQ(brakes.circuits, BrakeCircuits::front_rear);
    EXPECT_EQ(brakes.failed_circuit, 0);
    EXPECT_FALSE(brakes.modulated);
}

TEST(BrakesFile, ABrakeHasALineAKindAndHeat) {
    const VehicleDescription car = read_text(car_with_brakes(fluid_system, front_brake));
    for (const std::size_t wheel : {0, 1}) {
        const BrakeDescription& front = brake(car, wheel);
        EXPECT_EQ(front.max_torque, 1650);
        EXPECT_DOUBLE_EQ(front.volume, 3.1 * cm3);
        EXPECT_DOUBLE_EQ(front.line_flow, 70 * cm3);
        EXPECT_EQ(front.self_energizing, 0.5);
        EXPECT_EQ(front.heat.capacity, 4000);
        EXPECT_EQ(front.heat.cooling, 15);
        EXPECT_EQ(front.heat.cooling_per_speed, 2.5);
        EXPECT_THAT(front.temperature, ElementsAre(0, 300, 700));
        EXPECT_THAT(front.friction, ElementsAre(0.9, 1.05, 0.6));
        EXPECT_EQ(front.friction_loss_per_speed, 0.004);
        EXPECT_EQ(front.friction_radius, 0.13);
    }
}

// By hand: at 1650 N m and the system's pressure, 0.104 m of pads and 1 mm of stroke; 2000 bar/s are 20 volumes a second.
TEST(BrakesFile, WhatABrakeLeavesOutFollows) {
    const VehicleDescription car = read_text(car_with_brakes(fluid_system));
    const BrakeDescription& front = brake(car, 0);
    EXPECT_NEAR(front.volume, 1650 / car.brakes.full_pressure / 0.104 * 1e-3, 1e-12);
    EXPECT_GT(front.volume, 1 * cm3);
    EXPECT_LT(front.volume, 4 * cm3);
    EXPECT_DOUBLE_EQ(front.line_flow, 20 * front.volume);
    EXPECT_DOUBLE_EQ(front.volume / brake(car, 2).volume, 1650. / 850);
    EXPECT_EQ(front.self_energizing, 0);
    EXPECT_EQ(front.heat.capacity, 0);
    EXPECT_TRUE(front.friction.empty());
    EXPECT_EQ(brake(read_text(car_with_brakes(fluid_system, "volume_cm3 = 5\n")), 0).line_flow, 100 * cm3);
}

TEST(BrakesFile, AirHasChambersInPlaceOfVolumes) {
    const VehicleDescription car = read_text(car_with_brakes(
        air_system, "fill_time_s = 0.2\nrelease_time_s = 0.25\ntype = \"drum\"\nself_energizing = 0\n"));
    EXPECT_EQ(car.brakes.medium, BrakeMedium::air);
    EXPECT_DOUBLE_EQ(car.brakes.full_pressure, 8 * bar);
    EXPECT_EQ(car.brakes.knee_command, 1);
    EXPECT_TRUE(car.brakes.modulated);
    EXPECT_EQ(brake(car, 0).fill_time, 0.2);
    EXPECT_EQ(brake(car, 0).release_time, 0.25);
    EXPECT_EQ(brake(car, 0).volume, 0);
    EXPECT_EQ(brake(car, 2).fill_time, 0.15);
    EXPECT_EQ(brake(car, 2).release_time, 0.15);
}

TEST(BrakesFile, ARightSideMayHaveASmallerDisc) {
    const std::string text = car_with_brakes(fluid_system, "heat.capacity_J_per_K = 4000\n");
    const VehicleDescription car = read_text(changed(
        text, "suspension = \"macpherson\"", "suspension = \"macpherson\"\nright.brake.heat.capacity_J_per_K = 3000"));
    EXPECT_EQ(brake(car, 0).heat.capacity, 4000);
    EXPECT_EQ(brake(car, 1).heat.capacity, 3000);
    EXPECT_EQ(brake(car, 1).volume, brake(car, 0).volume);
}

TEST(BrakesFile, AnotherFileChangesWhatItSaysAndKeepsTheRest) {
    const TemporaryFolder folder;
    folder.write("base.toml", car_with_brakes(fluid_system, front_brake));
    const VehicleDescription car = read_vehicle(folder.write("car.toml", R"(base = "base.toml"
[brakes]
failed_circuit = 1
[brakes.modulator]
pump_flow_cm3_per_s = 4
[[axle]]
name = "front"
brake.heat.capacity_J_per_K = 6000
)"));
    EXPECT_EQ(car.brakes.failed_circuit, 1);
    EXPECT_EQ(car.brakes.circuits, BrakeCircuits::diagonal);
    EXPECT_DOUBLE_EQ(car.brakes.pump_flow, 4 * cm3);
    EXPECT_DOUBLE_EQ(car.brakes.pump_pressure, 180 * bar);
    EXPECT_EQ(brake(car, 1).heat.capacity, 6000);
    EXPECT_EQ(brake(car, 1).heat.cooling, 15);
}

TEST(BrakesFile, AnotherFileMayAddTheTimeOfAChamber) {
    const TemporaryFolder folder;
    folder.write("base.toml", car_with_brakes(air_system, "fill_time_s = 0.2\n"));
    const VehicleDescription car = read_vehicle(folder.write("car.toml", R"(base = "base.toml"
[[axle]]
name = "front"
brake.release_time_s = 0.3
)"));
    EXPECT_EQ(brake(car, 0).fill_time, 0.2);
    EXPECT_EQ(brake(car, 0).release_time, 0.3);
}

TEST(BrakesFile, ATrailersControlLineHasALagOfItsOwn) {
    const TemporaryFolder folder;
    const VehicleDescription truck =
        read_vehicle(folder.write("truck.toml", "base = \"" + repository_path("vehicles/truck_semitrailer.toml") + R"("
[brakes]
medium = "air"
pedal_force_N = 350
full_pressure_bar = 8.5
response_time_s = 0.06
trailer_response_time_s = 0.1
)"));
    EXPECT_DOUBLE_EQ(truck.brakes.full_pressure, 8.5 * bar);
    EXPECT_EQ(truck.brakes.response_time, 0.06);
    EXPECT_EQ(truck.brakes.trailer_response_time, 0.1);
    for_each_wheel(truck, [](const SuspensionWheelDescription& wheel, std::size_t) {
        EXPECT_GT(wheel.brake.fill_time, 0) << wheel.name;
    });
}

// An editor offers the keys of both media, and marks those of the wrong one.
TEST(BrakesFile, TheSchemaKnowsWhichMediumHasWhichKeys) {
    const TableRecord file = record_keys([](const TableReader& table) { read_vehicle(table); });
    const Json brakes = table_schema(*file.find("brakes")->below.begin())["properties"];
    EXPECT_EQ(brakes["response_time_s"]["default"], 0.05);
    EXPECT_TRUE(brakes.contains("full_pressure_bar"));
    EXPECT_TRUE(brakes["modulator"]["properties"].contains("pump_flow_cm3_per_s"));
    const std::string wanted = requirements(*file.find("brakes")->below.begin()).dump();
    EXPECT_THAT(wanted, HasSubstr(R"({"const":"air"})"));
    EXPECT_THAT(wanted, HasSubstr(R"("required":["full_pressure_bar"])"));
    EXPECT_THAT(wanted, HasSubstr(R"("required":["pedal_ratio","master_cylinder_diameter_mm"])"));
}

}  // namespace
}  // namespace hamilcar::io
