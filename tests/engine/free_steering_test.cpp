// A steering that moves on its own by the compiled step: the same bits as by the plain program, by every engine, alone and in lanes.
#include <gtest/gtest.h>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

// Pairs of suspensions, suspensions alone, trailers.
class FreeSteering : public testing::TestWithParam<std::string> {
protected:
    static VehicleDescription car() { return test::with_mechanics(test::shipped(GetParam()), test::full_mechanics()); }
};
INSTANTIATE_TEST_SUITE_P(Cars, FreeSteering, testing::ValuesIn(test::fleet()),
                         [](const auto& test) { return test.param; });

// A zero may have lost its sign (program/graph.hpp).
TEST_P(FreeSteering, HasTheSameBitsByEveryEngine) {
    for (const bool balance : {true, false}) {
        ScenarioDescription s = test::steering_moves(car());
        s.solver.energy_balance = balance;
        const Simulation simulation(car(), s);
        Integrator<State<double>> integrator(*find_method("ab3"), s.solver.step, simulation.model().vehicle.state_size);
        State<double> expected = simulation.state();
        {
            const FlushDenormals flush;
            for (int i = 0; i < 600; ++i) {
                integration_block(simulation.model(), integrator, simulation.schedule(), i * s.solver.step, expected);
            }
        }
        EXPECT_GT(std::abs(test::steering_state(simulation.model(), expected).rack), 1e-4);
        for (const Engine* engine : engines()) {
            EngineCar compiled(*engine, simulation);
            compiled.advance(600);
            for (std::size_t k = 0; k < static_cast<std::size_t>(simulation.model().vehicle.state_size); ++k) {
                ASSERT_TRUE(std::isfinite(expected.values[k])) << k;
                ASSERT_EQ(compiled.state().values[k], expected.values[k]) << engine->name << ", number " << k;
            }
        }
    }
}

// Cars with other masses, springs and steerings beside each other.
TEST_P(FreeSteering, HasTheSameBitsInLanes) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 5; ++i) {
        VehicleDescription one = car();
        one.chassis.mass *= 1 + 0.03 * i;
        SteeringMechanicsDescription& d = *one.steering.mechanics;
        d.rack_mass *= 1 + 0.2 * i, d.bar_stiffness *= 1 + 0.1 * i, d.wheel_friction *= 1 + 0.3 * i;
        d.joint_phase += 0.2 * i, d.assist.force[2] *= 1 + 0.1 * i, d.assist.fastest_rack *= 1 + 0.1 * i;
        one.steering.rack_per_revolution *= 1 + 0.02 * i;
        ScenarioDescription s = test::steering_moves(car());
        s.initial.velocity[0] += i;
        cars.emplace_back(one, s);
    }
    for (const Engine* engine : engines()) {
        Batch batch(cars, {.threads = 2, .engine = std::string(engine->name)});
        batch.advance(300);
        for (std::size_t i = 0; i < cars.size(); ++i) {
            Simulation alone = cars[i];
            for (int k = 0; k < 300; ++k) ASSERT_FALSE(alone.advance());
            const State<double> there = batch.state(i);
            EXPECT_EQ(batch.end(i).reason, EndReason::none);
            for (std::size_t k = 0; k < there.values.size(); ++k) {
                ASSERT_EQ(there.values[k], alone.state().values[k]) << engine->name << ", car " << i << ", " << k;
            }
        }
    }
}

}  // namespace
}  // namespace hamilcar
