// Cars with adjustable dampers and active bars: the same bits by the plain program and by every engine, alone, in pairs of suspensions
// and in lanes, and after going back to a place in a run.
#include <bit>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "run/checkpoint_folder.hpp"
#include "support/active_chassis.hpp"
#include "support/allocation_guard.hpp"

namespace hamilcar {
namespace {

Simulation told(const VehicleDescription& car, const ScenarioDescription& scenario, double phase = 0) {
    Simulation run(test::told(car), scenario);
    run.set_commands(test::mixed_commands(run.control()->layout(), phase));
    return run;
}

// Every actuator has left its rest.
void expect_actuators_moved(const Simulation& run) {
    const Vehicle<double>& vehicle = run.model().vehicle;
    EXPECT_GT(vehicle.actuators.size(), 0u);
    for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
        EXPECT_NE(run.state().values[static_cast<std::size_t>(vehicle.actuator_place) + i], vehicle.actuators[i].rest);
    }
}

void expect_the_bits_of_the_plain_program(const Simulation& simulation) {
    constexpr long steps = 500;
    Simulation there = simulation;
    for (long i = 0; i < steps; ++i) ASSERT_FALSE(there.advance());
    expect_actuators_moved(there);
    const double step = simulation.scenario().solver.step;
    Integrator<State<double>> integrator(*find_method("ab3"), step, simulation.model().vehicle.state_size);
    State<double> expected = simulation.state();
    {
        const FlushDenormals flush;
        for (long i = 0; i < steps; ++i) {
            integration_block(simulation.model(), integrator, simulation.schedule(), static_cast<double>(i) * step,
                              expected);
        }
    }
    for (const Engine* engine : engines()) {
        EngineCar compiled(*engine, simulation);
        compiled.advance(steps);
        for (std::size_t k = 0; k < static_cast<std::size_t>(simulation.model().vehicle.state_size); ++k) {
            ASSERT_TRUE(std::isfinite(expected.values[k])) << k;
            ASSERT_EQ(compiled.state().values[k], expected.values[k]) << engine->name << ", number " << k;
        }
    }
}

// Suspensions in pairs, axles that hold both wheels, bars with arms, trailers.
class ActuatorBits : public testing::TestWithParam<std::string> {
protected:
    // Not so firm that a step of 1 ms is too long for the lightest wheels.
    VehicleDescription car_ =
        test::with_active_bars(test::with_adjustable_dampers(test::shipped(GetParam()), {0.4, 1.2}));
};
INSTANTIATE_TEST_SUITE_P(Cars, ActuatorBits, testing::ValuesIn(test::fleet()),
                         [](const auto& test) { return test.param; });

TEST_P(ActuatorBits, AreThoseOfThePlainProgramByEveryEngine) {
    for (const bool balance : {true, false}) {
        ScenarioDescription s = test::everything_moves(car_);
        s.solver.energy_balance = balance;
        expect_the_bits_of_the_plain_program(told(car_, s));
    }
}

TEST_P(ActuatorBits, AreThoseOfThePlainProgramWithTheLeftSideAdjustableAlone) {
    VehicleDescription car = car_;
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionDamperDescription& one : suspension.dampers) {
            if (one.name.find("right") != std::string::npos) one.damper.soft = one.damper.firm = 1;
        }
    }
    EXPECT_LT(CommandLayout(test::told(car)).actuators().size(), CommandLayout(test::told(car_)).actuators().size());
    expect_the_bits_of_the_plain_program(told(car, test::everything_moves(car)));
}

TEST_P(ActuatorBits, AreTheSameInLanes) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 5; ++i) {
        VehicleDescription one =
            test::with_active_bars(test::with_adjustable_dampers(test::shipped(GetParam()),
                                                                 {0.3 + 0.05 * i, 1.05 + 0.05 * i, 0.008 + 0.002 * i}),
                                   3000 + 500 * i, 0.02 + 0.005 * i);
        one.chassis.mass *= 1 + 0.03 * i;
        ScenarioDescription s = test::everything_moves(one);
        s.initial.velocity[0] += i;
        cars.push_back(told(one, s, i));
    }
    for (const Engine* engine : engines()) {
        Batch batch(cars, {.threads = 2, .engine = std::string(engine->name)});
        batch.advance(300);
        for (std::size_t i = 0; i < cars.size(); ++i) {
            Simulation alone = cars[i];
            for (int k = 0; k < 300; ++k) {
                const auto end = alone.advance();
                ASSERT_FALSE(end) << end->message;
            }
            expect_actuators_moved(alone);
            const State<double> there = batch.state(i);
            for (std::size_t k = 0; k < there.values.size(); ++k) {
                ASSERT_EQ(there.values[k], alone.state().values[k]) << engine->name << ", car " << i << ", " << k;
            }
        }
    }
}

// Over humps on one side in a lane change, by both controllers, with keys and rates of their own.
Simulation controlled(const std::string& name, int i) {
    const double share = i;
    const VehicleDescription car = test::controlled_by(
        test::with_both(test::shipped(name)),
        {test::controller("active_anti_roll", i % 2 == 0 ? 200 : 125,
                          {{"stiffness_N_per_m", 4e4 + 5e3 * share}, {"front_share", 0.4 + 0.05 * share}}),
         test::controller("skyhook", i % 2 == 0 ? 500 : 250,
                          {{"sky_damping", 1 + 0.2 * share}, {"least_damping", 0.3 + 0.03 * share}})});
    ScenarioDescription s = test::everything_moves(car);
    s.initial.velocity[0] += i;
    for (double& angle : s.steering.value) angle *= name == "truck_semitrailer" ? 6 : 2;  // hard enough for the bars
    s.road.obstacles.push_back({.shape = ObstacleShape::hump, .start = 4, .length = 3, .height = 0.05, .right = 0});
    return Simulation(car, s);
}
void advance(Simulation& run, int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_FALSE(run.advance());
}
void expect_same_place(const Simulation& a, const Simulation& b) {
    expect_same(a, b);
    EXPECT_TRUE(std::ranges::equal(a.schedule().commands(), b.schedule().commands()));
    EXPECT_EQ(a.control_memory(), b.control_memory());
}
// Dampers and bars are told something else than at rest.
void expect_at_work(const Simulation& run) {
    std::size_t dampers = 0, bars = 0;
    const std::vector<Command>& commands = run.control()->layout().commands();
    for (std::size_t i = 0; i < commands.size(); ++i) {
        if (run.schedule().commands()[i] == commands[i].rest) continue;
        dampers += commands[i].name.ends_with(".damper.setting") ? 1 : 0;
        bars += commands[i].name.ends_with(".anti_roll_bar.force") ? 1 : 0;
    }
    EXPECT_GT(dampers, 0u);
    EXPECT_GT(bars, 0u);
}

class ControlledChassis : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Cars, ControlledChassis, testing::Values("bmw_323i", "offroader", "truck_semitrailer"),
                         [](const auto& test) { return test.param; });

TEST_P(ControlledChassis, HasTheBitsOfACarAloneInABatch) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 5; ++i) cars.push_back(controlled(GetParam(), i));
    Batch batch(cars, {.threads = 2});
    for (const long steps : {1L, 299L, 300L}) batch.advance(steps);
    for (std::size_t i = 0; i < cars.size(); ++i) {
        Simulation alone = cars[i];
        advance(alone, 600);
        expect_at_work(alone);
        const State<double> there = batch.state(i);
        for (std::size_t k = 0; k < there.values.size(); ++k) {
            ASSERT_EQ(there.values[k], alone.state().values[k]) << "car " << i << ", number " << k;
        }
        EXPECT_TRUE(std::ranges::equal(batch.schedule(i).commands(), alone.schedule().commands())) << i;
        Snapshot here, of_alone;
        batch.save(i, here), alone.save(of_alone);
        const auto numbers = static_cast<std::ptrdiff_t>(alone.control_memory().size());
        EXPECT_TRUE(std::equal(here.control.begin(), here.control.begin() + numbers, of_alone.control.begin())) << i;
    }
}

TEST_P(ControlledChassis, GoesBackToTheSameBits) {
    Simulation run = controlled(GetParam(), 1);
    advance(run, 603);
    expect_at_work(run);
    const auto snapshot = std::make_unique<Snapshot>();
    run.save(*snapshot);
    Simulation later = run, other = controlled(GetParam(), 1);
    advance(later, 300);
    other.restore(*snapshot);
    advance(other, 300);
    expect_same_place(other, later);
}

TEST_P(ControlledChassis, DecidesWithoutAllocation) {
    Simulation run = controlled(GetParam(), 0);
    advance(run, 500);
    const test::AllocationGuard guard;
    for (int i = 0; i < 50; ++i) (void)run.advance();
    EXPECT_EQ(guard.allocations(), 0);
}

class ActuatorCheckpoint : public Checkpoint {};

TEST_F(ActuatorCheckpoint, GoesOnFromAFileToTheSameBits) {
    Simulation run = controlled("offroader", 0);
    advance(run, 503);
    write_checkpoint(path(), run, {});
    Simulation other = controlled("offroader", 0);
    read_checkpoint(path(), other);
    expect_same_place(other, run);
    advance(other, 200), advance(run, 200);
    expect_same_place(other, run);
}

TEST_F(ActuatorCheckpoint, IsRefusedForACarWithOtherActuators) {
    Simulation run = controlled("offroader", 0);
    advance(run, 10);
    write_checkpoint(path(), run, {});
    VehicleDescription other = run.vehicle();
    other.anti_roll_bars[1].max_force = 0;
    Simulation without(other, run.scenario());
    EXPECT_NE(message_of(path(), without), "");
    EXPECT_EQ(without.steps_taken(), 0);
}

TEST(ActuatorBatch, RefusesCarsWithOtherActuators) {
    const VehicleDescription car = test::with_both(test::shipped("bmw_323i"));
    const ScenarioDescription s = test::everything_moves(car);
    VehicleDescription no_bar = car, no_damper = car;
    no_bar.anti_roll_bars[0].max_force = 0;
    no_damper.suspensions[0].dampers[0].damper.firm = no_damper.suspensions[0].dampers[0].damper.soft = 1;
    for (const VehicleDescription& other : {no_bar, no_damper}) {
        const std::vector<Simulation> cars{told(car, s), told(other, s)};
        EXPECT_THROW(Batch(cars, {.threads = 1}), std::invalid_argument);
    }
}

}  // namespace
}  // namespace hamilcar
