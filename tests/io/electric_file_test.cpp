// Batteries, motors by maps and at wheels, shafts, parking brakes, axles that an actuator steers: what a file says, and must not say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "electric_sample.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;

constexpr double rpm = 2 * std::numbers::pi / 60;

VehicleDescription read_text(const std::string& text) {
    const TemporaryFolder folder;
    return read_vehicle(folder.write("car.toml", text));
}

const MotorDescription& motor(const VehicleDescription& car, std::size_t unit) {
    return std::get<MotorDescription>(car.power_units[unit].source);
}

const SuspensionWheelDescription& wheel(const VehicleDescription& car, std::size_t number) {
    std::size_t at = 0;
    const SuspensionWheelDescription* found = nullptr;
    for (const SuspensionDescription& suspension : car.suspensions) {
        for (const SuspensionWheelDescription& one : suspension.wheels) {
            if (at++ == number) found = &one;
        }
    }
    return *found;
}

TEST(ElectricFile, MapsAndBatteryAreWhatTheFileSays) {
    const VehicleDescription car = read_text(car_driven_by(electric_drive));
    const BatteryDescription& battery = car.battery;
    EXPECT_TRUE(battery.exists);
    EXPECT_EQ(battery.capacity, 360e3);
    EXPECT_EQ(battery.initial_charge, 0.7);
    EXPECT_EQ(battery.resistance, 0.1);
    EXPECT_THAT(battery.voltage, ElementsAre(300, 350, 400));
    EXPECT_EQ(battery.max_charge, 80e3);
    const MotorDescription& front = motor(car, 0);
    EXPECT_THAT(front.torque.level, ElementsAre(300, 400));
    EXPECT_THAT(front.torque.value[1], ElementsAre(260, 260, 60));
    EXPECT_EQ(front.max_torque, 260);
    EXPECT_NEAR(front.max_speed, 12000 * rpm, 1e-9);
    EXPECT_NEAR(front.max_power, 260 * 4000 * rpm, 1e-6) << "of its points";
    EXPECT_EQ(front.brake_regeneration, 0.8);
    EXPECT_THAT(front.efficiency_map.value[0], ElementsAre(0.5, 0.8));
    EXPECT_EQ(motor(car, 1).efficiency, 0.9) << "by default";
    EXPECT_EQ(motor(car, 2).efficiency, 0.8);
}

TEST(ElectricFile, AMotorOnACarrierTurnsWithItsWheel) {
    const VehicleDescription car = read_text(car_driven_by(electric_drive)), plain = read_text(shipped_car_text());
    EXPECT_TRUE(car.power_units[1].in_wheel);
    EXPECT_TRUE(car.power_units[1].output.wheel);
    EXPECT_EQ(car.power_units[1].output.number, 2u);
    EXPECT_NEAR(wheel(car, 2).wheel.spin_inertia, wheel(plain, 2).wheel.spin_inertia + 25 * 0.02, 1e-12);
    EXPECT_EQ(wheel(car, 2).drive_reaction, wheel(car, 2).part);
    EXPECT_FALSE(car.power_units[2].in_wheel);
    EXPECT_EQ(wheel(car, 3).wheel.spin_inertia, wheel(plain, 3).wheel.spin_inertia);
    EXPECT_EQ(wheel(car, 3).drive_reaction, wheel(plain, 3).drive_reaction);
    const ShaftsDescription& shafts = car.power_units[2].shafts;
    EXPECT_TRUE(shafts.exists);
    EXPECT_EQ(shafts.gearbox_inertia, 0.01);
    EXPECT_NEAR(shafts.backlash, 3 * std::numbers::pi / 180, 1e-12);
}

TEST(ElectricFile, AParkingBrakeIsWhatTheFileSays) {
    const std::string text =
        changed(shipped_car_text(), "max_torque_N_m = ", "parking_torque_N_m = 600\nmax_torque_N_m = ");
    const VehicleDescription car = read_text(text);
    EXPECT_EQ(wheel(car, 0).brake.parking_torque, 600) << "of the first axle in the file";
    EXPECT_EQ(wheel(car, 2).brake.parking_torque, 0);
    EXPECT_TRUE(has_parking_brake(car));
}

TEST(ElectricFile, AnAxleIsSteeredByAnActuator) {
    const std::string axle = "[[axle]]\nname = \"front\"\n";
    const auto with = [&](const std::string& keys) {
        return changed(shipped_car_text(), axle, axle + "steering_actuator = {" + keys + "}\n");
    };
    const VehicleDescription car = read_text(with("travel_m = 0.02, frequency_hz = 4"));
    ASSERT_EQ(car.axle_steers.size(), 1u);
    EXPECT_EQ(car.axle_steers[0].axle, "front");
    EXPECT_NEAR(car.axle_steers[0].frequency, 8 * std::numbers::pi, 1e-12);
    EXPECT_EQ(car.axle_steers[0].damping_ratio, 1);
    EXPECT_EQ(car.suspensions[0].steered_by, 0u);
    EXPECT_FALSE(car.suspensions[2].steered_by);
    const TemporaryFolder folder;
    const std::string rear = "[[axle]]\nname = \"rear\"\n";
    const std::string path =
        folder.write("rear.toml", changed(shipped_car_text(), rear, rear + "steering_actuator = {travel_m = 0.02}\n"));
    expect_error([&] { read_vehicle(path); }, ExitCode::bad_file,
                 {"axle[rear].steering_actuator", "expected a linkage whose 'steered' is true"});
}

TEST(ElectricFile, ABatteryNeedsAMotor) {
    const TemporaryFolder folder;
    const std::string path = folder.write("car.toml", shipped_car_text() + R"(
[battery]
capacity_Ah = 1
charge = [0, 1]
open_voltage_V = [12, 14]
resistance_ohm = 0.01
max_discharge_W = 1e3
max_charge_W = 1e3
)");
    expect_error([&] { read_vehicle(path); }, ExitCode::bad_file, {"expected a [[power_unit]] with a motor"});
}

class BadElectricDrive : public testing::TestWithParam<BadInput> {};

TEST_P(BadElectricDrive, IsToldWithPlaceKeyValueAndExpectation) {
    expect_refused(car_driven_by(electric_drive), GetParam(), [](const std::string& path) { read_vehicle(path); });
}

const std::vector<BadInput> bad_drives{
    {"SpeedsThatFall", "[0, 4000, 12000]", "[0, 4000, 3000]", "[0, 4000, 3000]", {"expected numbers that increase"}},
    {"VoltagesThatFall",
     "voltage_V = 400",
     "voltage_V = 200",
     "200\ntorque",
     {"expected a number above the one before"}},
    {"TorquesTooFew",
     "[250, 200, 30]",
     "[250, 200]",
     "[250, 200]",
     {"expected 3 numbers, one for each of 'speed_rpm'"}},
    {"EfficiencyInPercent", "[0.7, 0.95]", "[70, 95]", "70, 95]", {"expected a number from 0.05 to 1"}},
    {"ChargeInPercent",
     "charge = [0, 0.5, 1]",
     "charge = [0, 50, 100]",
     "[0, 50, 100]",
     {"expected numbers from 0 to 1"}},
    {"MoreThanItsResistanceLetsThrough",
     "resistance_ohm = 0.1",
     "resistance_ohm = 0.2",
     "150e3\nmax",
     {"expected a number below 112500, all that the resistance lets through"}},
    {"UnknownWheel", "output = \"rear_left\"", "output = \"rear_lef\"", "\"rear_lef\"", {"did you mean 'rear_left'?"}},
    {"WheelOfADifferential",
     "output = \"rear_left\"",
     "output = \"front_left\"",
     "\"front_left\"\nmount",
     {"expected a wheel that no differential drives, or the differential 'front'"}},
    {"GearsOnACarrier", "ratios = [5]", "ratios = [5, 4]", "[power_unit.gearbox]\nratios = [5, 4]", {"one ratio"}},
    {"DifferentialOnACarrier",
     "output = \"front\"",
     "output = \"front\"\nmount = \"carrier\"",
     "\"front\"\nmount",
     {"expected the name of a wheel, on whose carrier"}},
    {"BacklashOfAHalfTurn", "backlash_deg = 3", "backlash_deg = 180", "180\n", {"expected a number from 0 to 45"}},
};
INSTANTIATE_TEST_SUITE_P(Mistakes, BadElectricDrive, testing::ValuesIn(bad_drives),
                         [](const auto& bad) { return bad.param.name; });

}  // namespace
}  // namespace hamilcar::io
