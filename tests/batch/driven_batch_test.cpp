// Closed-loop drivers in lanes: every car of a batch has the same bits as a Simulation of its own, whatever its neighbors.
#include <gtest/gtest.h>

#include "hamilcar/batch/batch.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

// Each with another speed, path and gearbox habit.
ScenarioDescription driven(int i) {
    ScenarioDescription s = test::scenario(4, 6 + 2 * i);
    s.driver.steering.emplace();
    s.driver.steering->path.points = {{0, 0}, {30, 0}, {60, 1.0 + i}, {120, 1.0 + i}, {400, 0}};
    s.driver.speed.emplace();
    s.driver.speed->speed = {{0, 4}, {6.0 + 2 * i, 14.0 + i}, Interpolation::linear};
    s.driver.shifting.emplace();
    if (i % 2 == 1) s.driver.shifting->gear = 2;
    if (i == 2) s.driver.interval = 0.01;
    if (i == 3) s.driver.interval = 0.0034;  // not of whole steps
    return s;
}

TEST(DrivenBatch, GivesTheBitsOfSimulationsOfTheirOwn) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 5; ++i) cars.emplace_back(test::shipped_car(), driven(i));
    Batch batch(cars, {.threads = 2});
    for (const long steps : {700, 1, 2503, 796}) batch.advance(steps);
    for (std::size_t i = 0; i < cars.size(); ++i) {
        Simulation alone(test::shipped_car(), driven(static_cast<int>(i)));
        test::run_to_end(alone);
        const State<double> state = batch.state(i);
        EXPECT_EQ(batch.end(i).reason, EndReason::none);
        for (int k = 0; k < alone.model().vehicle.state_size; ++k) {
            const auto at = static_cast<std::size_t>(k);
            ASSERT_EQ(state.values[at], alone.state().values[at]) << "car " << i << ", number " << k;
        }
    }
}

TEST(DrivenBatch, StopsACarWhereItsDriverEndsTheRun) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 3; ++i) {
        ScenarioDescription s = driven(i);
        if (i == 1) s.driver.ending.distance = 20;
        cars.emplace_back(test::shipped_car(), s);
    }
    Simulation alone(test::shipped_car(), cars[1].scenario());
    test::run_to_end(alone);
    ASSERT_TRUE(alone.ending());
    Batch batch(cars, {.threads = 1});
    batch.advance(4000);
    EXPECT_EQ(batch.end(1).reason, EndReason::driver_ended);
    EXPECT_EQ(batch.end(1).time, alone.time());
    EXPECT_EQ(batch.end(0).reason, EndReason::none);
    for (int k = 0; k < alone.model().vehicle.state_size; ++k) {
        const auto at = static_cast<std::size_t>(k);
        ASSERT_EQ(batch.state(1).values[at], alone.state().values[at]) << k;
    }
}

TEST(DrivenBatch, RefusesPowertrainsOfAnotherShape) {
    VehicleDescription five = test::shipped_car(), four = test::shipped_car();
    four.power_units[0].gearbox.ratios.pop_back();
    EXPECT_EQ(topology_difference(Simulation(five, driven(0)), Simulation(four, driven(0))),
              "power units or differentials");
}

}  // namespace
}  // namespace hamilcar
