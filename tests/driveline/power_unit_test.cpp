// Power units against hand calculations: interpolated curves, gears and their torsion, converters, and power that may be lost but
// never created.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hamilcar/vehicle/build.hpp"

namespace hamilcar {
namespace {

EngineDescription engine() {
    const std::vector<double> speed{80, 400, 600};
    return {.throttle = {0, 1}, .torque = {{speed, {-10, -30, -40}}, {speed, {100, 200, 150}}}, .idle_speed = 80};
}

// Two wheels behind one differential, nothing else.
VehicleDescription axle() {
    VehicleDescription d;
    d.suspensions.resize(2);
    for (SuspensionDescription& suspension : d.suspensions) {
        suspension.wheels.resize(1);
        suspension.wheels[0].wheel = {.center = {}, .spin_axis = {0, 1, 0}, .spin_inertia = 0.8};
    }
    PowerUnitDescription unit{.name = "engine", .source = engine(), .inertia = 0.2};
    unit.coupling = ClutchDescription{.capacity = 300};
    unit.stiffness = 1000, unit.damping_ratio = 0.1;
    unit.gearbox = {.ratios = {4, 2, 1}, .reverse_ratio = 3, .efficiency = 0.9};
    d.power_units = {unit};
    d.differentials = {{.name = "rear", .ratio = 3, .outputs = {{{true, 0}, {true, 1}}}, .shaft_stiffness = 5000}};
    return d;
}

Powertrain<double> powertrain() {
    return make_powertrain<double>(axle());
}

// In a chassis that stands, at the speeds of the rotor and of what it drives.
struct Speeds {
    double rotor, shaft;
};
PowerUnit<double>::Output evaluate(const PowerUnit<double>& unit, const PowertrainInput<double>& told, Speeds speeds,
                                   double windup, double oil_torque) {
    std::vector<double> values(static_cast<std::size_t>(unit.place) + 6);
    const auto at = unit.state(values.data());
    at.momentum = unit.inertia * speeds.rotor, at.windup = windup, at.oil_torque = oil_torque;
    const auto state = unit.state(static_cast<const double*>(values.data()));
    const Vec3<double> still = Vec3<double>::Zero();
    const auto demand = unit.demand(told, state, speeds.shaft, still, 0, 0);
    return unit.evaluate(demand, 1, told, state, still, speeds.shaft);
}

// Wheels that turn on a car that stands.
PowertrainMotion<double> turning(std::initializer_list<double> wheels) {
    PowertrainMotion<double> out;
    out.chassis.setZero(), out.axle_turns.fill(0), out.brakes.fill(0), out.wheels.fill(0);
    std::ranges::copy(wheels, out.wheels.begin());
    return out;
}

TEST(CombustionEngine, InterpolatesBetweenSpeedsAndThrottles) {
    const CombustionEngine<double> e(engine());
    EXPECT_NEAR(e.at(1, 240, 0), 150, 1e-12);
    EXPECT_NEAR(e.at(0, 240, 0), -20, 1e-12);
    EXPECT_NEAR(e.at(0.5, 240, 0), 65, 1e-12);
    EXPECT_NEAR(e.at(1, 500, 0), 175, 1e-12);
    EXPECT_NEAR(e.at(1, 900, 0), 150, 1e-12) << "constant beyond the last point";
    EXPECT_NEAR(e.at(2, 240, 0), e.at(1, 240, 0), 0) << "the pedal is limited";
}

TEST(CombustionEngine, GovernorHoldsTheIdleSpeed) {
    const CombustionEngine<double> e(engine());
    double speed = 300;  // runs freely, with the rotor's inertia
    for (int i = 0; i < 20000; ++i) speed += 1e-3 * e.at(0, speed, 0) / 0.2;
    EXPECT_GT(speed, 0.9 * 80);
    EXPECT_LT(speed, 80);
    EXPECT_NEAR(e.at(0, speed, 0), 0, 1e-9);
}

TEST(CombustionEngine, StallsUnderLoadAndStartsAgain) {
    const CombustionEngine<double> e(engine());
    EXPECT_GT(e.at(0, 0, 0), 0) << "the starter acts";
    EXPECT_LT(e.at(1, 0, 0), 0.5 * 100) << "no combustion";
    double speed = 0;
    for (int i = 0; i < 5000; ++i) speed += 1e-3 * e.at(0, speed, 0) / 0.2;
    EXPECT_GT(speed, 0.9 * 80) << "without load it returns to idle";
}

TEST(ElectricMotor, HasConstantTorqueThenConstantPower) {
    const ElectricMotor<double> m({.max_torque = 200, .max_power = 60e3, .max_speed = 1200, .regeneration = 0.25});
    EXPECT_NEAR(m.at(1, 100, 0), 200, 1e-12);
    EXPECT_NEAR(m.at(1, 299, 0), 200, 1e-12);
    EXPECT_NEAR(m.at(1, 600, 0), 100, 1e-12);
    EXPECT_NEAR(m.at(1, 1200, 0), 0, 1e-12);
    EXPECT_NEAR(m.at(0, 600, 0), -25, 1e-12);
    EXPECT_NEAR(m.at(0, 0, 0), 0, 1e-12) << "at rest nothing is regenerated";
    EXPECT_NEAR(m.at(0, -600, 0), 25, 1e-12) << "it brakes backward too";
}

TEST(Gears, AreInterpolatedAndConnectedOnlyIfTheyExist) {
    const Gears<double> gears = powertrain().units[0].gears;
    EXPECT_EQ(gears.at(1).ratio, 4);
    EXPECT_EQ(gears.at(3).ratio, 1);
    EXPECT_EQ(gears.at(7).ratio, 1) << "beyond the last gear: the last";
    EXPECT_EQ(gears.at(-1).ratio, -3);
    EXPECT_EQ(gears.at(0).ratio, 0);
    EXPECT_EQ(gears.at(0).connected, 0);
    EXPECT_NEAR(gears.at(1.25).ratio, 3.5, 1e-15);
    VehicleDescription forward_only = axle();
    forward_only.power_units[0].gearbox.reverse_ratio = 0;
    EXPECT_EQ(make_powertrain<double>(forward_only).units[0].gears.at(-1).connected, 0);
}

TEST(Gears, CombineTheTorsionOfAllShaftsInSeries) {
    // Both half-shafts side by side at the wheels, seen through 4 x 3 in first gear, in series with the unit's own.
    const double seen = 2 * 5000 / (12.0 * 12.0);
    EXPECT_NEAR(powertrain().units[0].gears.at(1).stiffness, 1 / (1 / 1000.0 + 1 / seen), 1e-9);
    const double wheels = 2 * 0.8 / (12.0 * 12.0), inertia = 0.2 * wheels / (0.2 + wheels);
    const auto first = powertrain().units[0].gears.at(1);
    EXPECT_NEAR(first.damping, 2 * 0.1 * std::sqrt(first.stiffness * inertia), 1e-9);
}

TEST(PowerUnit, PassesTheWindUpsTorqueThroughRatioAndEfficiency) {
    const PowerUnit<double> unit = powertrain().units[0];
    const double shaft = 20, rotor = 80, windup = 0.5;  // second gear of ratio 2: 40 rad/s at the input, slipping
    const auto out = evaluate(unit, {0.5, 0, 2, nullptr}, {rotor, shaft}, windup, 0);
    EXPECT_EQ(out.shaft_speed, 40);
    EXPECT_NEAR(out.out, 2 * 0.9 * out.clutch, 1e-12);
    EXPECT_NEAR(out.rotor, out.source - out.clutch, 1e-12);
    const auto open = evaluate(unit, {0.5, 1, 2, nullptr}, {rotor, shaft}, windup, 0);
    EXPECT_EQ(open.clutch, 0) << "a pressed pedal opens the clutch";
    EXPECT_EQ(open.out, 0);
    EXPECT_EQ(evaluate(unit, {0.5, 0, 0, nullptr}, {rotor, shaft}, windup, 0).out, 0) << "neutral";
}

TEST(PowerUnit, NeverCreatesPower) {
    VehicleDescription d = axle();
    d.power_units[0].coupling = ConverterDescription{
        .speed_ratio = {0, 0.8, 1}, .torque_ratio = {2, 1, 1}, .capacity = {2e-3, 1.6e-3, 0}, .lockup_capacity = 200};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> some(-1, 1);
    for (const VehicleDescription& vehicle : {axle(), d}) {
        const PowerUnit<double> unit = make_powertrain<double>(vehicle).units[0];
        for (int i = 0; i < 20000; ++i) {
            const double rotor = 400 * some(random), shaft = 60 * some(random), gear = 2 + 2 * some(random);
            const double steady = unit.converter.evaluate(rotor, unit.gears.at(gear).ratio * shaft).pump;
            const auto out = evaluate(unit, {0.3, 0, gear, nullptr}, {rotor, shaft}, 0, steady);
            const double in_power = (out.clutch + out.pump) * rotor, out_power = out.out * shaft;
            EXPECT_NEAR(out.loss, in_power - out_power, 1e-9 * (1 + std::abs(in_power)));
            EXPECT_GE(out.loss, -1e-9 * (1 + std::abs(in_power)))
                << "rotor " << rotor << ", shaft " << shaft << ", gear " << gear;
        }
    }
}

TEST(Converter, MultipliesTorqueAtStallButNotInOverrun) {
    Converter<double> c{Curve<double>({0, 0.8, 1}, {2, 1, 1}), Curve<double>({0, 0.8, 1}, {2e-3, 1.6e-3, 0}), 1, 120};
    const auto stall = c.evaluate(200, 0);
    EXPECT_NEAR(stall.pump, 2e-3 * 200 * 200, 1e-9);
    EXPECT_NEAR(stall.multiplication, 2, 1e-12);
    const auto alike = c.evaluate(200, 200);
    EXPECT_NEAR(alike.pump, 0, 1e-12);
    const auto overrun = c.evaluate(160, 200);
    EXPECT_NEAR(overrun.pump, -1.6e-3 * 200 * 200, 1e-9) << "the turbine drives the pump";
    EXPECT_EQ(overrun.multiplication, 1);
    EXPECT_EQ(c.lockup(200, 100), 0);
    EXPECT_EQ(c.lockup(200, 199), 1);
    EXPECT_EQ(c.lockup(100, 99), 0) << "too slow, it would stall the engine";
}

TEST(Differential, SplitsTorqueAndLocksByItsKind) {
    VehicleDescription d = axle();
    DifferentialDescription& rear = d.differentials[0];
    const auto made = [&] { return make_powertrain<double>(d).differentials[0]; };
    const auto open = made().evaluate(100, 30, 20, 0);
    EXPECT_EQ(open.a, 150);
    EXPECT_EQ(open.b, 150);
    EXPECT_EQ(made().input_speed(30, 20), 75);
    rear.kind = DifferentialKind::limited_slip, rear.locking_drive = 0.125, rear.preload = 20;
    const auto slipping = made().evaluate(100, 30, 20, 1.0);  // wound up beyond the friction limit
    EXPECT_NEAR(slipping.lock, 20 + 0.125 * 300, 1e-9);
    EXPECT_NEAR(slipping.a + slipping.b, 300, 1e-9);
    EXPECT_GT(slipping.b, slipping.a) << "the slower wheel receives more";
    rear.locking_coast = 0.05;
    EXPECT_NEAR(made().evaluate(-100, 30, 20, 1.0).lock, 20 + 0.05 * 300, 1e-9) << "braking";
    EXPECT_NEAR(made().evaluate(-100, -30, -40, 1.0).lock, 20 + 0.05 * 300, 1e-9)
        << "driving backward presses on the same ramps as braking";
    rear.kind = DifferentialKind::locked;
    const auto locked = made().evaluate(0, 0, 0, 0.01);
    EXPECT_NEAR(locked.lock, 0.01 * 5000 / 2, 1e-9) << "two shafts in series";
    rear = {.name = "rear", .kind = DifferentialKind::viscous, .ratio = 3, .viscosity = 8};
    rear.outputs = {{{true, 0}, {true, 1}}}, rear.shaft_stiffness = 5000;
    const auto viscous = made();
    double windup = 0;
    for (int i = 0; i < 2000; ++i) windup += 1e-3 * viscous.evaluate(0, 30, 20, windup).windup_rate;
    EXPECT_NEAR(viscous.evaluate(0, 30, 20, windup).lock, 80, 1e-9) << "the same slip for two seconds";
    EXPECT_EQ(viscous.evaluate(0, 25, 25, windup).lock, 0) << "no slip";
}

// Power in is power out and what the lock takes up, which its friction loses and its torsion stores.
TEST(Differential, PassesOnThePowerThatComesIn) {
    VehicleDescription d = axle();
    DifferentialDescription& rear = d.differentials[0];
    rear.kind = DifferentialKind::limited_slip, rear.locking_drive = 0.2, rear.preload = 30, rear.share = 0.4;
    const auto made = make_powertrain<double>(d).differentials[0];
    for (const double torque : {-150.0, 0.0, 400.0}) {
        for (const auto& [a, b] : {std::pair{30.0, 20.0}, {20.0, 30.0}, {-5.0, 8.0}}) {
            for (const double windup : {-0.02, 0.0, 0.01}) {
                const auto out = made.evaluate(torque, a, b, windup);
                EXPECT_NEAR(torque * made.input_speed(a, b), out.a * a + out.b * b + out.loss, 1e-9);
                EXPECT_NEAR(made.input_speed(a, b), rear.ratio * (0.4 * a + 0.6 * b), 1e-12);
                EXPECT_NEAR(out.a + out.lock, 0.4 * rear.ratio * torque, 1e-9) << "torques are shared as speeds are";
            }
        }
    }
}

TEST(Powertrain, PropagatesTorquesDownTheTreeAndSpeedsUp) {
    VehicleDescription d = axle();
    d.suspensions.resize(4, d.suspensions[0]);
    d.differentials = {
        {.name = "front", .ratio = 4, .outputs = {{{true, 0}, {true, 1}}}, .shaft_stiffness = 5e3},
        {.name = "rear", .ratio = 4, .outputs = {{{true, 2}, {true, 3}}}, .shaft_stiffness = 5e3},
        {.name = "center", .ratio = 1.5, .share = 0.4, .outputs = {{{false, 0}, {false, 1}}}, .shaft_stiffness = 5e4}};
    d.power_units[0].output = {.wheel = false, .number = 2};
    Powertrain<double> p = make_powertrain<double>(d);
    p.units[0].place = 0, p.differential_place = 4, p.supplied_place = 7;
    const PowertrainMotion<double> motion = turning({10, 12, 20, 24});
    const auto in = p.input_speeds(motion);
    EXPECT_NEAR(in[0], 44, 1e-12);
    EXPECT_NEAR(in[1], 88, 1e-12);
    EXPECT_NEAR(in[2], 1.5 * (0.4 * 44 + 0.6 * 88), 1e-12);
    std::vector<double> values(8);
    p.units[0].state(values.data()).momentum = 0.2 * 300;
    p.units[0].state(values.data()).windup = 0.3;
    PowertrainMomenta<double> out;
    p.evaluate({0.5, 0, 2, nullptr}, motion, values.data(), out);
    const double torque = out.units[0].out;
    EXPECT_NE(torque, 0);
    EXPECT_NEAR(out.wheels[0], torque * 1.5 * 0.4 * 4 / 2, 1e-9);
    EXPECT_NEAR(out.wheels[3], torque * 1.5 * 0.6 * 4 / 2, 1e-9);
    double wheel_power = 0;
    for (std::size_t i = 0; i < 4; ++i) wheel_power += out.wheels[i] * motion.wheels[i];
    EXPECT_NEAR(wheel_power, torque * in[2], 1e-9) << "open differentials lose nothing";
    EXPECT_NEAR(out.supplied, out.units[0].source * 300, 1e-9);
}

// A hybrid: what several units give to one differential adds up.
TEST(Powertrain, AddsTheTorquesOfItsUnits) {
    VehicleDescription d = axle();
    d.power_units.push_back(d.power_units[0]);
    d.power_units[1].name = "second";
    Powertrain<double> p = make_powertrain<double>(d);
    p.units[0].place = 0, p.units[1].place = 4, p.differential_place = 8, p.supplied_place = 9;
    const PowertrainMotion<double> motion = turning({10, 10});
    std::vector<double> values(10);
    for (std::size_t i = 0; i < 2; ++i) {
        p.units[i].state(values.data()).momentum = 0.2 * 300;
        p.units[i].state(values.data()).windup = i == 0 ? 0.1 : 0.05;
    }
    PowertrainMomenta<double> out;
    p.evaluate({0.5, 0, 2, nullptr}, motion, values.data(), out);
    EXPECT_GT(out.units[0].out, out.units[1].out + 1);
    EXPECT_NEAR(out.wheels[0], 3 * (out.units[0].out + out.units[1].out) / 2, 1e-9);
    EXPECT_NEAR(out.supplied, 300 * (out.units[0].source + out.units[1].source), 1e-9);
}

}  // namespace
}  // namespace hamilcar
