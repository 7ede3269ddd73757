// Cars of a batch that begin again, take another's place or go back to where they were: each has the bits of a Simulation that does
// the same alone, whatever its neighbors do meanwhile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "hamilcar/batch/batch.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

Simulation various(int i, const SolverDescription& solver = {}) {
    VehicleDescription car = test::paper_car();
    car.chassis.mass *= 1 + 0.03 * i;
    ScenarioDescription s = test::scenario(10, 6 + 2 * i);
    s.solver = solver;
    s.brake = test::table({0, 0.1, 0.2, 4}, {0, 0, 0.01 * i, 0});
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0, 0.05, 0.3 + 0.02 * i}, {0, 0.002 * (i - 3), -0.004});
    return Simulation(car, s);
}
std::vector<Simulation> cars(int count, const SolverDescription& solver = {}) {
    std::vector<Simulation> all;
    for (int i = 0; i < count; ++i) all.push_back(various(i, solver));
    return all;
}
Simulation advanced(Simulation simulation, long steps) {
    for (long i = 0; i < steps; ++i) EXPECT_FALSE(simulation.advance().has_value());
    return simulation;
}
void expect_same_bits(const State<double>& a, const State<double>& b, const std::string& which) {
    for (std::size_t k = 0; k < a.values.size(); ++k) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(a.values[k]), std::bit_cast<std::uint64_t>(b.values[k]))
            << which << ", number " << k << ": " << a.values[k] << " and " << b.values[k];
    }
}

class RestartedBatch : public testing::TestWithParam<std::tuple<const Engine*, const char*>> {
protected:
    BatchOptions options() const { return {.threads = 2, .engine = std::string(std::get<0>(GetParam())->name)}; }
    SolverDescription solver() const { return {.integrator = std::get<1>(GetParam())}; }
};
INSTANTIATE_TEST_SUITE_P(All, RestartedBatch,
                         testing::Combine(testing::ValuesIn(engines()),
                                          testing::Values("ab1", "ab3", "ab5", "abm3", "rk4")),
                         [](const auto& test) {
                             return std::string(std::get<0>(test.param)->name) + "_" + std::get<1>(test.param);
                         });

TEST_P(RestartedBatch, HasTheBitsOfCarsThatBeginThen) {
    const std::vector<Simulation> all = cars(11, solver());
    Batch batch(all, options());
    batch.advance(1);
    batch.restart(2);
    batch.advance(1);
    batch.restart(7), batch.restart(2);
    batch.advance(150);
    batch.restart(0);
    batch.advance(60);
    const std::vector<long> expected{60, 212, 211 - 1, 212, 212, 212, 212, 210, 212, 212, 212};
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_DOUBLE_EQ(batch.time(i), 1e-3 * static_cast<double>(expected[i])) << i;
        expect_same_bits(batch.state(i), advanced(all[i], expected[i]).state(), "car " + std::to_string(i));
    }
}

TEST_P(RestartedBatch, GoesBackToWhereACarWas) {
    const std::vector<Simulation> all = cars(5, solver());
    Batch batch(all, options());
    batch.advance(70);
    Snapshot of_batch, alone;
    batch.save(3, of_batch);
    advanced(all[3], 70).save(alone);
    EXPECT_EQ(of_batch.step_count, alone.step_count);
    EXPECT_EQ(of_batch.memory.newest, alone.memory.newest);
    EXPECT_EQ(of_batch.memory.remembered, alone.memory.remembered);
    batch.advance(33);
    batch.restore(3, of_batch);
    batch.advance(50);
    expect_same_bits(batch.state(3), advanced(all[3], 120).state(), "from the batch's own");
    batch.restore(3, alone);
    batch.advance(1);
    batch.restore(
        1, of_batch = [&] {
            Snapshot early;
            advanced(all[1], 1).save(early);
            return early;
        }());
    batch.advance(49);
    expect_same_bits(batch.state(3), advanced(all[3], 120).state(), "from a Simulation's");
    expect_same_bits(batch.state(1), advanced(all[1], 50).state(), "from before the method had its past");
    expect_same_bits(batch.state(0), advanced(all[0], 203).state(), "a neighbor");

    Simulation back(all[3]);
    batch.save(3, of_batch);
    back.restore(of_batch);
    expect_same_bits(advanced(back, 40).state(), advanced(all[3], 160).state(), "from the batch to a Simulation");
}

TEST_P(RestartedBatch, TakesAnotherCarInThePlaceOfOne) {
    const std::vector<Simulation> all = cars(5, solver());
    const Simulation heavy = various(12, solver());
    BatchOptions with_variant = options();
    with_variant.variants = {&heavy};
    Batch batch(all, with_variant);
    batch.advance(80);
    batch.replace(2, heavy);
    batch.advance(90);
    expect_same_bits(batch.state(2), advanced(heavy, 90).state(), "the new one");
    expect_same_bits(batch.state(4), advanced(all[4], 170).state(), "a neighbor");
    batch.restart(2);
    batch.advance(10);
    expect_same_bits(batch.state(2), advanced(heavy, 10).state(), "the new one again");
}

TEST(RestartedBatchOfOneVehicle, RefusesACarThatDiffersInWhatIsShared) {
    const std::vector<Simulation> same{various(1), various(1)};
    Batch batch(same, {.threads = 1});
    const auto message = [&](const Simulation& by) -> std::string {
        try {
            batch.replace(0, by);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "accepted";
    };
    using testing::HasSubstr;
    EXPECT_THAT(message(various(2)), HasSubstr("made without a variant"));
    EXPECT_THAT(message(various(1, {.step = 5e-4})), HasSubstr("step"));
    EXPECT_THAT(message(advanced(various(1), 1)), HasSubstr("already been advanced"));
    EXPECT_EQ(message(various(1)), "accepted");
}

TEST(RestartedBatchOfEndedCars, BeginsAgain) {
    ScenarioDescription tipping = test::scenario(10, 10);
    tipping.initial.settle = false, tipping.initial.height = 0.6, tipping.initial.angular_velocity = {4, 0, 0};
    std::vector<Simulation> all = cars(2);
    all.emplace_back(test::paper_car(), tipping);
    Batch batch(all, {.threads = 1, .tilt_limit = 1.0});
    batch.advance(1500);
    ASSERT_EQ(batch.end(2).reason, EndReason::rolled_over);
    const double ended = batch.time(2);
    batch.restart(2);
    EXPECT_EQ(batch.end(2).reason, EndReason::none);
    EXPECT_EQ(batch.time(2), 0);
    batch.advance(100);
    expect_same_bits(batch.state(2), advanced(all[2], 100).state(), "the one that had tipped over");
    batch.advance(1400);
    EXPECT_EQ(batch.time(2), ended);
    expect_same_bits(batch.state(0), advanced(all[0], 3000).state(), "a neighbor");

    // All of them ended, and one begins again.
    const std::vector<Simulation> alone{Simulation(test::paper_car(), tipping), Simulation(test::paper_car(), tipping)};
    Batch both(alone, {.threads = 1, .tilt_limit = 1.0});
    both.advance(2000);
    both.restart(1);
    both.advance(100);
    expect_same_bits(both.state(1), advanced(alone[1], 100).state(), "the one that begins again");
    EXPECT_EQ(both.end(0).time, ended);
}

// Decisions and tables go by a car's own time.
TEST(RestartedDrivenBatch, HasTheBitsOfDriversThatBeginThen) {
    ScenarioDescription s = test::scenario(8, 8);
    s.driver.steering.emplace();
    s.driver.steering->path.points = {{0, 0}, {30, 0}, {60, 2}, {120, 2}, {400, 0}};
    s.driver.speed.emplace();
    s.driver.speed->speed = {{0, 4}, {8, 14}, Interpolation::linear};
    s.driver.shifting.emplace();
    std::vector<Simulation> all;
    for (int i = 0; i < 3; ++i) all.emplace_back(test::shipped_car(), s);
    Batch batch(all, {.threads = 1});
    batch.advance(1003);
    batch.restart(1);
    batch.advance(502);
    Snapshot where;
    batch.save(1, where);
    batch.advance(800);
    expect_same_bits(batch.state(1), advanced(all[1], 1302).state(), "restarted");
    expect_same_bits(batch.state(0), advanced(all[0], 2305).state(), "its neighbor");
    batch.restore(1, where);
    batch.advance(800);
    expect_same_bits(batch.state(1), advanced(all[1], 1302).state(), "gone back");
}

// A post under a wheel moves by the car's own time.
TEST(RestartedBatchOnPosts, FeelsThemAtItsOwnTime) {
    ScenarioDescription s = test::scenario(8);
    for (int wheel = 0; wheel < 4; ++wheel) {
        s.road.posts.height.push_back(test::table({0.05 * wheel, 0.2, 0.4}, {0, 0.01 * (wheel - 1), 0}));
    }
    std::vector<Simulation> all;
    for (int i = 0; i < 3; ++i) all.emplace_back(test::paper_car(), s);
    Batch batch(all, {.threads = 1});
    batch.advance(103);
    batch.restart(1);
    batch.advance(211);
    expect_same_bits(batch.state(1), advanced(all[1], 211).state(), "restarted");
    expect_same_bits(batch.state(2), advanced(all[2], 314).state(), "its neighbor");
}

}  // namespace
}  // namespace hamilcar
