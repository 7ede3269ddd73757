// Rollouts: long runs, uneven roads, what is refused, and stopping.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "batch/rollout_car.hpp"
#include "support/driven.hpp"
#include "support/fleet.hpp"
#include "support/refuse_executable_memory.hpp"

namespace hamilcar {
namespace {

using namespace test;

TEST(Rollout, OfALongRunComputesRowsAgainForTheSameGradient) {
    const Car car(test::shipped("bmw_323i"));
    constexpr long steps = 250;
    Rollout rollout(car.car(), readers(car.simulation.vehicle()), {.steps = steps, .threads = 1});
    const auto lanes = static_cast<std::size_t>(default_engine().lanes(Precision::double_precision));
    const std::size_t bytes_of_row =
        4 * rollout.state_size() * lanes * sizeof(double) * static_cast<std::size_t>(steps);
    const std::size_t rows = (std::size_t{64} << 20) / bytes_of_row + 2;  // more than are kept
    const RolloutNumbers runs = runs_of(rollout, car, 1, rows);
    const auto numbers = [](std::size_t count, double phase) {
        std::vector<double> out(count);
        for (std::size_t i = 0; i < count; ++i) out[i] = std::sin(phase + 1.7 * static_cast<double>(i));
        return out;
    };
    const RolloutResults weights{numbers(rows * rollout.channel_count(), 0.3), numbers(rollout.state_size(), 0.8)};
    const RolloutNumbers along{numbers(runs.controls.size(), 1), std::vector<double>(rollout.state_size()), {}};
    RolloutResults changes;
    rollout.tangents(std::array{car.car()}, runs, along, rows, changes);
    const RolloutNumbers gradient = rollout.gradient(std::array{car.car()}, runs, weights, rows);
    double forward = 0, backward = 0, size = 0;
    const auto add = [&size](double& to, const std::vector<double>& x, const std::vector<double>& y) {
        for (std::size_t i = 0; i < x.size(); ++i) to += x[i] * y[i], size += std::abs(x[i] * y[i]);
    };
    add(forward, weights.channels, changes.channels), add(forward, weights.states, changes.states);
    add(backward, gradient.controls, along.controls);
    EXPECT_NEAR(forward, backward, 1e-10 * size);
}

TEST(Rollout, RefusesCarsWithOtherControls) {
    const Car car(test::shipped("bmw_323i"));
    VehicleDescription without = test::shipped("bmw_323i");
    for (SuspensionDescription& suspension : without.suspensions) {
        for (SuspensionWheelDescription& wheel : suspension.wheels) wheel.brake.max_torque = 0;
    }
    const Car other(without);
    Rollout rollout(car.car(), {}, {.variants = {&other.simulation}});
    EXPECT_EQ(rollout.obstacle(car.car()), "");
    EXPECT_THAT(rollout.obstacle(other.car()), testing::HasSubstr("controls"));
}

TEST(Rollout, StopsWhenAsked) {
    const Car car(test::shipped("bmw_323i"));
    Rollout rollout(car.car(), {}, {.steps = 100000000, .threads = 2});
    const RolloutNumbers runs = runs_of(rollout, car, 20, 3);
    std::atomic<int> asked = 0;
    rollout.set_stop([&] { return ++asked > 50; });
    rollout.run(std::vector<RolloutCar>(20, car.car()), runs, 3);
    rollout.gradient(std::vector<RolloutCar>(20, car.car()), runs,
                     {std::vector<double>(), std::vector<double>(20 * rollout.state_size())}, 3);
    EXPECT_GT(asked, 50);
}

// In a child process, for each engine: a rollout whose programs fall back to the portable engine, which may have other lanes.
TEST(RolloutDeathTest, RunsWhereTheSystemRefusesExecutableMemory) {
    GTEST_FLAG_SET(death_test_style, "fast");
    const Car car(shipped("bmw_323i"));
    constexpr std::size_t runs_at_once = 5, rows = 2;
    const std::vector<RolloutCar> cars(runs_at_once, car.car());
    Rollout plain(car.car(), {}, {.steps = 5, .threads = 1});
    const RolloutNumbers runs = runs_of(plain, car, runs_at_once, rows);
    const RolloutResults weights{{}, std::vector<double>(runs.states.size(), 1.0)};
    const std::vector<double> expected = plain.gradient(cars, runs, weights, rows).states;
    for (const Engine* engine : engines()) {
        const auto try_it = [&] {
            if (!refuse_executable_memory(false)) std::exit(100);
            Rollout refused(car.car(), {}, {.steps = 5, .threads = 1, .engine = std::string(engine->name)});
            std::exit(refused.gradient(cars, runs, weights, rows).states == expected ? 0 : 1);
        };
        EXPECT_EXIT(
            try_it(),
            [](int status) { return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 100); },
            "")
            << engine->name;
    }
}

TEST(Rollout, OnAnUnevenRoadHasTheTangentsOfDifferences) {
    ScenarioDescription s = rolling(8);
    s.road.waves.push_back({.start = 1, .length = 40, .amplitude = 0.03, .wavelength = 2.5});
    const Car car(test::shipped("bmw_323i"), s);
    constexpr std::size_t rows = 20;
    Rollout rollout(car.car(), readers(car.simulation.vehicle()), {.steps = 8, .threads = 1});
    const RolloutNumbers runs = runs_of(rollout, car, 1, rows);
    RolloutNumbers along{std::vector<double>(runs.controls.size()), std::vector<double>(rollout.state_size()), {}};
    along.states[0] = 1;  // along the road
    RolloutResults changes;
    rollout.tangents(std::array{car.car()}, runs, along, rows, changes);
    const auto shifted = [&](double by) {
        RolloutNumbers other = runs;
        other.states[0] += by;
        return rollout.run(std::array{car.car()}, other, rows);
    };
    constexpr double h = 1e-4;
    const RolloutResults after = shifted(h), before = shifted(-h);
    double largest = 0;
    for (std::size_t i = 0; i < after.states.size(); ++i) {
        const double expected = (after.states[i] - before.states[i]) / (2 * h);
        largest = std::max(largest, std::abs(expected));
        EXPECT_NEAR(changes.states[i], expected, 1e-4 * (1 + std::abs(expected))) << i;
    }
    EXPECT_GT(largest, 10);  // the road is felt
    RolloutResults weights{std::vector<double>(rows * rollout.channel_count()),
                           std::vector<double>(rollout.state_size())};
    weights.states[2] = 1;
    EXPECT_NEAR(rollout.gradient(std::array{car.car()}, runs, weights, rows).states[0], changes.states[2],
                1e-6 * (0.1 + std::abs(changes.states[2])));
}

TEST(Rollout, RefusesWhatHasNoDerivatives) {
    const auto problem = [](const VehicleDescription& vehicle, const ScenarioDescription& s) -> std::string {
        const Car car(vehicle, s);
        try {
            Rollout(car.car(), {}, {});
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    const VehicleDescription car = test::paper_car();
    ScenarioDescription s = rolling();
    EXPECT_EQ(problem(car, s), "");
    s.solver.integrator = "ab3";
    EXPECT_THAT(problem(car, s), testing::HasSubstr("expected rk4"));
    s = test::driven();
    s.solver.integrator = "rk4";
    EXPECT_THAT(problem(test::shipped("bmw_e90_330i"), s), testing::HasSubstr("driver"));
}

}  // namespace
}  // namespace hamilcar
