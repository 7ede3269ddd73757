// What the benchmarks say about themselves: medians and ratios of known times, counts that must agree with each other,
// errors of known paths, and a run that is as far as it should be after it was timed.
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/bench/bench.hpp"
#include "hamilcar/bench/interleave.hpp"
#include "hamilcar/bench/peak.hpp"
#include "hamilcar/bench/scenes.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

TEST(Race, TakesRatiosRoundByRound) {
    // The machine is slow in the second round and slower in the third: the ratio is two all along.
    const InterleavedTimes result({{2, 8, 6}, {1, 4, 3}});
    EXPECT_EQ(result.time(0), 6);
    EXPECT_EQ(result.time(1), 3);
    EXPECT_EQ(result.ratio(0, 1), 2);
}

TEST(Race, GivesEveryoneTheirTurns) {
    long first = 0, second = 0;
    std::vector<std::string> order;
    interleave({{"first", [&](long n) { first += n, order.emplace_back("first"); }},
                {"second", [&](long n) { second += n, order.emplace_back("second"); }}},
               1e-4, 3);
    EXPECT_GT(first, 0);
    EXPECT_GT(second, 0);
    const std::vector<std::string> last(order.end() - 4, order.end());
    EXPECT_EQ(last, (std::vector<std::string>{"first", "second", "first", "second"}));
}

TEST(Peak, DoesAsManyOperationsAsItSays) {
    for (const Engine* own : engines()) {
        for (const Precision p : {Precision::double_precision, Precision::single_precision}) {
            EXPECT_EQ(multiply_and_add(*own, p, 10), 10 * multiply_and_add(*own, p, 1));
            // The portable engine has more lanes than a register of the baseline that it is compiled for.
            const int lanes = own->name == "portable" ? 16 / (p == Precision::double_precision ? 8 : 4) : own->lanes(p);
            EXPECT_EQ(std::fmod(multiply_and_add(*own, p, 1), 2 * lanes), 0);
        }
        EXPECT_EQ(own->lanes(Precision::single_precision), 2 * own->lanes(Precision::double_precision));
    }
}

TEST(Operations, OfAStepAreThoseOfItsTurnsAndABitMore) {
    ScenarioDescription scenario = bend();
    const OperationCount turn = operations_of_rhs(Simulation(test::paper_car(), scenario));
    const OperationCount ab3 = operations_of_a_step(Simulation(test::paper_car(), scenario));
    scenario.solver.integrator = "rk4";
    const OperationCount rk4 = operations_of_a_step(Simulation(test::paper_car(), scenario));
    // 50 numbers with three past rates each, twelve closed coordinates at most and an orientation.
    EXPECT_GT(ab3.total(), turn.total());
    EXPECT_LT(ab3.total() - turn.total(), 2 * 50 * 3 + 100);
    EXPECT_EQ(ab3.divisions, turn.divisions);
    EXPECT_EQ(rk4.divisions, 4 * turn.divisions);
    EXPECT_GT(rk4.total(), 4 * turn.total());
}

TEST(PathError, IsTheLargestDistance) {
    const Trace reference{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, path{{0, 0, 0}, {1, 3, 4}, {2, 1, 0}};
    EXPECT_EQ(path_error(path, reference), 5);
    EXPECT_EQ(path_error(reference, reference), 0);
    EXPECT_TRUE(std::isinf(path_error({{0, 0, 0}}, reference)));
}

// The order of a method shows in the diagram: an eighth of the error at half the step of a third-order one.
TEST(Trials, ConvergeToTheReference) {
    ScenarioDescription scenario = lane_change();
    scenario.duration = 4;
    const VehicleDescription car = test::paper_car();
    const Trace reference = reference_path(car, scenario);
    const TrialResult coarse = run_trial(car, scenario, {"ab3", 2e-3}, reference, 1),
                      fine = run_trial(car, scenario, {"ab3", 1e-3}, reference, 1);
    EXPECT_LT(coarse.path_error, 1e-5);
    EXPECT_NEAR(std::log2(coarse.path_error / fine.path_error), 3, 0.3);
    EXPECT_GT(coarse.wall_time, 0);
}

// What README and docs/theory/formulation.md state of the default method over the whole of it, 15 s and 300 m.
TEST(Trials, LaneChangeIsThatOfAFarSmallerStep) {
    const VehicleDescription car = test::paper_car();
    const Trace reference = reference_path(car, lane_change());
    const TrialResult coarse = run_trial(car, lane_change(), {"ab3", 2e-3}, reference, 1),
                      fine = run_trial(car, lane_change(), {"ab3", 1e-3}, reference, 1);
    std::printf("ab3: %.2e m at 2 ms, %.2e m at 1 ms; joints open by %.1e m\n", coarse.path_error, fine.path_error,
                fine.violation);
    EXPECT_LT(coarse.path_error, 4e-7);
    EXPECT_LT(fine.path_error, 5e-8);
    EXPECT_LT(fine.violation, 3e-12);
}

TEST(StepJitter, AdvancesTheRunByWhatItTimed) {
    Simulation timed(test::paper_car(), bend()), alone(test::paper_car(), bend());
    const StepJitter s = step_jitter(timed, 2000);
    while (alone.steps_taken() < 2000) alone.advance();
    EXPECT_EQ(timed.steps_taken(), 2000);
    EXPECT_EQ(timed.state().values, alone.state().values);
    EXPECT_LE(s.late_alone, s.late);
    EXPECT_GT(s.median, 0);
}

TEST(Fleet, IsOfCarsThatDiffer) {
    const auto cars = fleet(test::paper_car(), 3);
    for (auto& car : cars) {
        for (int i = 0; i < 100; ++i) ASSERT_FALSE(car->advance());
    }
    EXPECT_NE(cars[0]->state().values, cars[1]->state().values);
    EXPECT_NE(cars[1]->state().values, cars[2]->state().values);
}

}  // namespace
}  // namespace hamilcar
