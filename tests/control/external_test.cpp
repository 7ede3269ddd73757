// Commands from outside: they hold until told otherwise, and actuators do what they say.
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "hamilcar/run/simulation.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

class ExternalControl : public testing::Test {
protected:
    static VehicleDescription vehicle() {
        VehicleDescription car = test::shipped("bmw_e90_330i");
        car.controllers = {{.kind = "external", .rate = 100, .settings = {}}};
        return car;
    }
    static Simulation driving() {
        ScenarioDescription s = test::scenario(2, 15);
        s.brake = test::table({0, 0.05}, {0, 0.3});
        s.gear = {{0}, {2}, Interpolation::steps};
        s.throttle = test::table({0}, {0.3});
        return Simulation(vehicle(), s);
    }
    void tell(const char* name, double value) {
        const int place = layout().find(name);
        ASSERT_GE(place, 0) << name;
        std::vector<double> told(car_.schedule().commands().begin(), car_.schedule().commands().end());
        told[static_cast<std::size_t>(place)] = value;
        car_.set_commands(told);
    }
    void advance(int steps) {
        for (int i = 0; i < steps; ++i) ASSERT_FALSE(car_.advance());
    }
    double pressure(std::size_t line) const {
        return car_.model().vehicle.brakes.pressure(line, car_.state().values.data());
    }
    double throttle() const { return car_.sample().momenta.powertrain.units[0].throttle; }
    const CommandLayout& layout() const { return car_.control()->layout(); }
    Simulation car_ = driving();
};

TEST_F(ExternalControl, RestsUntilItIsTold) {
    ScenarioDescription without = car_.scenario();
    without.controllers_off = {"all"};
    Simulation other(vehicle(), without);
    for (int i = 0; i < 300; ++i) ASSERT_FALSE(other.advance());
    advance(300);
    EXPECT_TRUE(std::ranges::equal(car_.schedule().commands(), layout().rest()));
    // A car that takes no commands computes with fewer numbers: the same but for round-off.
    for (int i = 0; i < car_.model().vehicle.state_size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double value = car_.state().values[k];
        EXPECT_NEAR(other.state().values[k], value, 1e-9 * (1 + std::abs(value))) << i;
    }
    EXPECT_EQ(car_.control()->activity(0, car_.control_memory()), 0);
}

TEST_F(ExternalControl, OpensAndClosesValvesAsTold) {
    advance(800);
    const double before = pressure(0), other = pressure(1);
    EXPECT_GT(before, 1e6);
    tell("front_left.brake.inlet", 0);
    advance(2);  // in which a method of three steps still knows earlier rates
    const double held = pressure(0);
    EXPECT_NEAR(held, before, 1e-6 * before);
    advance(100);
    EXPECT_EQ(pressure(0), held) << "to the bit";
    tell("front_left.brake.outlet", 1);
    advance(150);
    EXPECT_LT(pressure(0), 1e-3 * before);
    tell("front_left.brake.outlet", 0), tell("front_left.brake.pump", 1);
    advance(300);
    const SuspensionWheelDescription& wheel = car_.vehicle().suspensions[0].wheels[0];
    const double most = car_.vehicle().brakes.pump_pressure,
                 rate = car_.vehicle().brakes.pump_flow / wheel.brake.volume * brake_reference_pressure;
    EXPECT_NEAR(pressure(0), most * (1 - std::exp(-rate / most * 0.3)), 5e-3 * most);
    tell("front_left.brake.pump", 0), tell("front_left.brake.inlet", 1);
    advance(400);
    EXPECT_NEAR(pressure(0), before, 1e-3 * before) << "as the pedal says";
    EXPECT_NEAR(pressure(1), other, 1e-3 * other) << "the other wheel was told nothing";
}

TEST_F(ExternalControl, LimitsTheThrottle) {
    advance(1);
    EXPECT_NEAR(throttle(), 0.3, 1e-12);
    tell("engine.max_throttle", 0.1);
    EXPECT_NEAR(throttle(), 0.1, 1e-12);
    tell("engine.min_throttle", 0.05);
    EXPECT_NEAR(throttle(), 0.1, 1e-12);
    tell("engine.max_throttle", 1), tell("engine.min_throttle", 0.6);
    EXPECT_NEAR(throttle(), 0.6, 1e-12) << "more than the pedal";
    tell("engine.max_throttle", 0.2);
    EXPECT_NEAR(throttle(), 0.2, 1e-12) << "the upper limit has the last word";
    advance(100);
    EXPECT_NEAR(throttle(), 0.2, 1e-12) << "and holds";
}

TEST_F(ExternalControl, ListsItsCommandsByNameInTheVehiclesOrder) {
    const std::vector<Command>& commands = layout().commands();
    ASSERT_EQ(commands.size(), 4u * 3 + 2);
    EXPECT_EQ(commands[0].name, "front_left.brake.inlet");
    EXPECT_EQ(commands[5].name, "front_right.brake.pump");
    EXPECT_EQ(commands[12].name, "engine.max_throttle");
    for (std::size_t i = 0; i < commands.size(); ++i) {
        EXPECT_EQ(layout().find(commands[i].name), static_cast<int>(i));
        EXPECT_GE(commands[i].rest, commands[i].min);
        EXPECT_LE(commands[i].rest, commands[i].max);
    }
    EXPECT_EQ(layout().find("front_left.brake"), -1);
    EXPECT_EQ(layout().brake(2), 6);
    EXPECT_EQ(layout().unit(0), 12);
    VehicleDescription free = vehicle();
    free.controllers.clear();
    EXPECT_EQ(CommandLayout(free).size(), 0) << "without controllers all actuators are at rest";
    EXPECT_EQ(CommandLayout(free).brake(0), -1);
}

// Valves and limits half open in every way, on fluid and on air.
TEST(ExternalCommands, HaveTheBitsOfThePlainProgramByEveryEngine) {
    for (const char* name : {"bmw_e90_330i", "truck_semitrailer"}) {
        VehicleDescription car = test::shipped(name);
        car.controllers = {{.kind = "external", .rate = 100, .settings = {}}};
        ScenarioDescription s = test::everything_moves(car);
        s.brake = test::table({0.05, 0.1}, {0, 0.6});
        s.drive = {};
        s.gear = {{0}, {3}, Interpolation::steps};
        s.throttle = test::table({0}, {0.5});
        Simulation run(car, s);
        std::vector<double> told = run.control()->layout().rest();
        for (std::size_t i = 0; i < told.size(); ++i) told[i] = 0.5 + 0.5 * std::sin(static_cast<double>(i));
        run.set_commands(told);
        const SolverDescription& solver = run.scenario().solver;
        Integrator<State<double>> integrator(*find_method(solver.integrator), solver.step,
                                             run.model().vehicle.state_size, solver.tolerance);
        State<double> plain = run.state();
        constexpr long steps = 400;
        {
            const FlushDenormals flush;
            for (long i = 0; i < steps; ++i) {
                integration_block(run.model(), integrator, run.schedule(), static_cast<double>(i) * solver.step, plain);
            }
        }
        for (const Engine* engine : engines()) {
            EngineCar compiled(*engine, run);
            compiled.advance(steps);
            for (int i = 0; i < run.model().vehicle.state_size; ++i) {
                const auto k = static_cast<std::size_t>(i);
                ASSERT_EQ(compiled.state().values[k], plain.values[k]) << name << " by " << engine->name << ", " << i;
            }
        }
    }
}

}  // namespace
}  // namespace hamilcar
