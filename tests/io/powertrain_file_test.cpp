// Power units and differentials: what a file says becomes what a description holds.
#include "hamilcar/io/vehicle_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/io/vehicle_file.hpp"
#include "powertrain_sample.hpp"

namespace hamilcar::io {
namespace {

using testing::DoubleEq;
using testing::ElementsAre;
using testing::Pointwise;

constexpr double rpm = 2 * M_PI / 60;

VehicleDescription read_text(const std::string& text) {
    const TemporaryFolder folder;
    return read_vehicle(folder.write("car.toml", text));
}

void expect_output(const DrivenPart& output, bool wheel, std::size_t number) {
    EXPECT_EQ(output.wheel, wheel);
    EXPECT_EQ(output.number, number);
}

TEST(PowertrainFile, DifferentialsStandAfterWhatTheyDrive) {
    const auto car = read_text(car_driven_by(four_driven_wheels));
    ASSERT_EQ(car.differentials.size(), 3u);
    const auto &rear = car.differentials[0], &front = car.differentials[1], &center = car.differentials[2];
    EXPECT_EQ(rear.name, "rear");
    EXPECT_EQ(front.name, "front");
    EXPECT_EQ(center.name, "center");
    expect_output(rear.outputs[0], true, 2), expect_output(rear.outputs[1], true, 3);
    expect_output(front.outputs[0], true, 1), expect_output(front.outputs[1], true, 0);
    expect_output(center.outputs[0], false, 1), expect_output(center.outputs[1], false, 0);
    EXPECT_EQ(rear.ratio, 3.25);
    EXPECT_EQ(center.ratio, 1);
    EXPECT_EQ(rear.share, 0.5);
    EXPECT_EQ(center.share, 0.4);
    EXPECT_EQ(center.shaft_stiffness, 14e3);
    EXPECT_EQ(front.kind, DifferentialKind::viscous);
    EXPECT_EQ(front.viscosity, 12);
}

// Torques of the outputs at the limit of the lock, by the description's formula: a = share in - lock, b = the rest.
TEST(PowertrainFile, LockingValuesAreThoseOfTheTrade) {
    const auto car = read_text(car_driven_by(four_driven_wheels));
    const auto& slipping = car.differentials[0];
    const auto locking_value = [](double lock) { return ((0.5 + lock) - (0.5 - lock)) / 1; };
    EXPECT_EQ(slipping.kind, DifferentialKind::limited_slip);
    EXPECT_DOUBLE_EQ(locking_value(slipping.locking_drive), 0.25);
    EXPECT_DOUBLE_EQ(locking_value(slipping.locking_coast), 0.1);
    EXPECT_EQ(slipping.preload, 50);
    const auto& biasing = car.differentials[2];
    EXPECT_EQ(biasing.kind, DifferentialKind::torque_biasing);
    EXPECT_DOUBLE_EQ((0.5 + biasing.locking_drive) / (0.5 - biasing.locking_drive), 3);
    EXPECT_EQ(biasing.locking_coast, biasing.locking_drive);
    EXPECT_EQ(biasing.preload, 20);
}

TEST(PowertrainFile, EngineWithConverterAndAutomaticGearbox) {
    const auto car = read_text(car_driven_by(four_driven_wheels));
    ASSERT_EQ(car.power_units.size(), 2u);
    const PowerUnitDescription& unit = car.power_units[0];
    EXPECT_EQ(unit.name, "engine");
    expect_output(unit.output, false, 2);
    EXPECT_EQ(unit.inertia, 0.2);
    EXPECT_THAT(unit.axis, ElementsAre(-1, 0, 0));
    EXPECT_EQ(unit.response_time, 0.1);
    EXPECT_EQ(unit.stiffness, 1500);
    EXPECT_EQ(unit.damping_ratio, 0.2);
    const auto& engine = std::get<EngineDescription>(unit.source);
    EXPECT_DOUBLE_EQ(engine.idle_speed, 900 * rpm);
    EXPECT_THAT(engine.throttle, ElementsAre(0, 0.5, 1));
    ASSERT_EQ(engine.torque.size(), 3u);
    EXPECT_THAT(engine.torque[0].torque, ElementsAre(-10, -20, -40));
    EXPECT_THAT(engine.torque[1].torque, ElementsAre(90, 120, 0));
    EXPECT_THAT(engine.torque[2].torque, ElementsAre(100, 200, 0));
    for (const TorqueCurve& curve : engine.torque) {
        EXPECT_THAT(curve.speed, Pointwise(DoubleEq(), {600 * rpm, 3000 * rpm, 6000 * rpm}));
    }
    const auto& converter = std::get<ConverterDescription>(unit.coupling);
    EXPECT_THAT(converter.speed_ratio, ElementsAre(0, 0.9, 1));
    EXPECT_THAT(converter.torque_ratio, ElementsAre(2, 1, 1));
    EXPECT_NEAR(converter.capacity[0] * std::pow(2000 * rpm, 2), 250, 1e-9);
    EXPECT_EQ(converter.lockup_capacity, 350);
    const GearboxDescription& gearbox = unit.gearbox;
    EXPECT_THAT(gearbox.ratios, ElementsAre(3, 1.5, 1));
    EXPECT_EQ(gearbox.reverse_ratio, 2);
    EXPECT_EQ(gearbox.efficiency, 0.9);
    EXPECT_TRUE(gearbox.automatic);
    EXPECT_EQ(gearbox.shift_time, 0.3);
    EXPECT_DOUBLE_EQ(gearbox.upshift_speed, 5500 * rpm);
    EXPECT_DOUBLE_EQ(gearbox.upshift_speed_closed, 2000 * rpm);
    EXPECT_DOUBLE_EQ(gearbox.downshift_speed, 2500 * rpm);
    EXPECT_DOUBLE_EQ(gearbox.downshift_speed_closed, 900 * rpm);
}

TEST(PowertrainFile, MotorNeedsNeitherClutchNorGearbox) {
    const auto car = read_text(car_driven_by(four_driven_wheels));
    const PowerUnitDescription& unit = car.power_units[1];
    const auto& motor = std::get<MotorDescription>(unit.source);
    EXPECT_EQ(motor.max_torque, 200);
    EXPECT_EQ(motor.max_power, 60e3);
    EXPECT_DOUBLE_EQ(motor.max_speed, 9000 * rpm);
    EXPECT_EQ(motor.regeneration, 0.3);
    expect_output(unit.output, false, 0);
    EXPECT_EQ(unit.damping_ratio, 0.1);
    EXPECT_EQ(std::get<ClutchDescription>(unit.coupling).capacity, 0);
    EXPECT_THAT(unit.gearbox.ratios, ElementsAre(1));
    EXPECT_FALSE(unit.gearbox.automatic);
}

TEST(PowertrainFile, MayBeLeftOut) {
    const auto car = read_text(car_driven_by(""));
    EXPECT_TRUE(car.power_units.empty());
    EXPECT_TRUE(car.differentials.empty());
    const auto paper_car = read_vehicle(repository_path("vehicles/bmw_323i_paper.toml"));
    EXPECT_TRUE(paper_car.power_units.empty());
    EXPECT_TRUE(paper_car.differentials.empty());
}

// 110 kW and 205 N m (beemerlab.org); Motor Sport saw 2734 rpm at 70 mph in fifth gear.
TEST(PowertrainFile, ShippedCarHasThePublishedPower) {
    const auto car = read_vehicle(repository_path("vehicles/bmw_323i.toml"));
    const PowerUnitDescription& unit = car.power_units.at(0);
    const auto& full = std::get<EngineDescription>(unit.source).torque.back();
    double power = 0, torque = 0;
    for (std::size_t i = 0; i < full.speed.size(); ++i) {
        power = std::max(power, full.speed[i] * full.torque[i]), torque = std::max(torque, full.torque[i]);
    }
    EXPECT_NEAR(power, 110e3, 500);
    EXPECT_EQ(torque, 205);
    EXPECT_THAT(unit.gearbox.ratios, ElementsAre(3.83, 2.20, 1.40, 1.00, 0.81));
    const double speed = 2734 * rpm / (unit.gearbox.ratios.back() * car.differentials.at(0).ratio) * 0.289;
    EXPECT_NEAR(speed, 70 * 0.44704, 0.5);
}

// Every wheel that the file gives a share of the drive torque is driven by a power unit, and no other.
TEST(PowertrainFile, ShippedVehiclesDriveTheWheelsThatHaveAShare) {
    for (const auto& file : std::filesystem::directory_iterator(repository_path("vehicles"))) {
        if (file.path().extension() != ".toml" || file.path().stem() == "bmw_323i_paper") continue;
        const auto car = read_vehicle(file.path().string());
        std::vector<bool> has_share, driven;
        for_each_wheel(car, [&](const auto& wheel, std::size_t) { has_share.push_back(wheel.drive_share > 0); });
        driven.resize(has_share.size());
        for (const auto& differential : car.differentials) {
            for (const auto& output : differential.outputs) {
                if (output.wheel) driven.at(output.number) = true;
            }
        }
        EXPECT_EQ(driven, has_share) << file.path();
        EXPECT_FALSE(car.power_units.empty()) << file.path();
    }
}

}  // namespace
}  // namespace hamilcar::io
