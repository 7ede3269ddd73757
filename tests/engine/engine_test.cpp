// One car by every engine that this processor has: the same bits, also in a stand-still that decays toward zero; and a
// caller whose arithmetic is left as it was.
#include <gtest/gtest.h>

#include <bit>

#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/engine/flush.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

State<double> driven_by(const Engine& engine, const ScenarioDescription& scenario, long steps) {
    EngineCar car(engine, Simulation(test::paper_car(), scenario));
    car.advance(steps);
    return car.state();
}

void expect_same_bits_by_every_engine(const ScenarioDescription& scenario, long steps) {
    const State<double> expected = driven_by(engine("baseline"), scenario, steps);
    for (const std::string_view set : supported_instruction_sets()) {
        const State<double> state = driven_by(engine(set), scenario, steps);
        for (std::size_t k = 0; k < state.values.size(); ++k) {
            EXPECT_EQ(std::bit_cast<std::uint64_t>(state.values[k]), std::bit_cast<std::uint64_t>(expected.values[k]))
                << set << ", number " << k;
        }
    }
}

TEST(Engines, DriveACarToTheSameBits) {
    for (const char* integrator : {"ab3", "rk4", "dopri5"}) {
        ScenarioDescription s = test::scenario(5, 20);
        s.solver.integrator = integrator;
        s.steering_input = SteeringInput::rack;
        s.steering = test::table({0, 0.2, 0.5}, {0, 0.006, -0.002});
        s.brake = test::table({0.3, 0.5}, {0, 0.3});
        expect_same_bits_by_every_engine(s, 800);
    }
}

TEST(Engines, LetACarStandToTheSameBits) {
    expect_same_bits_by_every_engine(test::scenario(20), 20000);
}

TEST(Engines, AreTheRichestFirstAndOpenByName) {
    const auto sets = supported_instruction_sets();
    EXPECT_EQ(sets.back(), "baseline");
    EXPECT_EQ(best_engine().instruction_set, sets.front());
    for (const std::string_view set : sets) EXPECT_EQ(engine(set).instruction_set, set);
    EXPECT_THROW(engine("x86-64-v9"), std::invalid_argument);
}

TEST(FlushTinyNumbers, LastsAsLongAsItLives) {
    volatile double tiny = 1e-300, factor = 1e-10;  // the product, 1e-310, has lost digits already
    EXPECT_NE(tiny * factor, 0);
    {
        const FlushTinyNumbers flush;
        EXPECT_EQ(tiny * factor, 0);
        EXPECT_EQ(tiny * 1e5, 1e-295);
    }
    EXPECT_NE(tiny * factor, 0);
    driven_by(best_engine(), test::scenario(1), 1);
    EXPECT_NE(tiny * factor, 0) << "a step leaves the caller's arithmetic as it was";
}

}  // namespace
}  // namespace hamilcar
