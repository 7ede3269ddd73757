// The batch against single simulations: the same bits in any lane, with any neighbors and threads, by every engine;
// cars that end early are reported and do not affect others.
#include "hamilcar/batch/batch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <stdexcept>

#include "support/car.hpp"

namespace hamilcar {
namespace {

constexpr long steps = 1500;

// Cars of one topology with nothing else in common: masses, springs, tires, grade, friction, start and driver.
Simulation various(int i, SolverDescription solver = {}) {
    VehicleDescription car = test::paper_car();
    car.chassis.mass *= 1 + 0.03 * i;
    car.chassis.center_of_mass[0] += 0.01 * i;
    for (SuspensionDescription& corner : car.suspensions) {
        corner.springs[0].spring.rate *= 1 + 0.02 * i;
        std::get<LinearTireDescription>(corner.wheels[0].tire).friction *= 1 - 0.03 * i;
        corner.wheels[0].brake.max_torque *= 1 + 0.05 * i;
    }
    if (i % 2 == 1) car.suspensions[0].dampers[0].damper = {{-1, -0.1, 0.2, 1}, {-1500, -300, 400, 1200}};
    ScenarioDescription s = test::scenario(10, 4 + 2 * i);
    s.solver = solver;
    s.road.grade = 0.01 * (i % 3), s.road.bank = -0.005 * i, s.road.friction = 1 - 0.02 * i;
    s.drive = test::table({0, 0.5 + 0.01 * i, 3}, {0, 300.0 + 20 * i, 0});
    s.brake = test::table({0, 1, 1.2, 4}, {0, 0, 0.02 * i, 0});
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0, 0.2, 0.5 + 0.05 * i, 1.3}, {0, 0.002 * (i - 3), -0.004, 0.001 * i});
    return Simulation(car, s);
}

std::vector<Simulation> cars(int count, const SolverDescription& solver = {}) {
    std::vector<Simulation> all;
    for (int i = 0; i < count; ++i) all.push_back(various(i, solver));
    return all;
}

// The state of a single simulation after that many steps.
State<double> alone(Simulation simulation, long count) {
    for (long i = 0; i < count; ++i) {
        const auto end = simulation.advance();
        EXPECT_FALSE(end.has_value()) << end->message;
    }
    return simulation.state();
}

void expect_same_bits(const State<double>& a, const State<double>& b, const std::string& which) {
    for (std::size_t k = 0; k < a.values.size(); ++k) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(a.values[k]), std::bit_cast<std::uint64_t>(b.values[k]))
            << which << ", number " << k << ": " << a.values[k] << " and " << b.values[k];
    }
}

class EveryEngine : public testing::TestWithParam<const Engine*> {
protected:
    BatchOptions options(int threads) const { return {.threads = threads, .engine = std::string(GetParam()->name)}; }
};
INSTANTIATE_TEST_SUITE_P(All, EveryEngine, testing::ValuesIn(engines()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST_P(EveryEngine, GivesEveryCarTheBitsItHasAlone) {
    const std::vector<Simulation> all = cars(11);
    Batch batch(all, options(1));
    EXPECT_EQ(batch.engine(), GetParam()->name);
    batch.advance(steps / 2);
    batch.advance(steps - steps / 2);
    for (std::size_t i = 0; i < all.size(); ++i) {
        expect_same_bits(batch.state(i), alone(all[i], steps), "car " + std::to_string(i));
        EXPECT_EQ(batch.end(i).reason, EndReason::none);
    }
}

TEST_P(EveryEngine, GivesTheSameBitsWithOtherNeighborsAndThreads) {
    const std::vector<Simulation> all = cars(11);
    Batch batch(all, options(1));
    std::vector<const Simulation*> turned;
    for (std::size_t i = 0; i < all.size(); ++i) turned.push_back(&all[(7 * i + 3) % all.size()]);
    Batch other(turned, options(3));
    batch.advance(steps), other.advance(steps);
    for (std::size_t i = 0; i < all.size(); ++i) {
        expect_same_bits(other.state(i), batch.state((7 * i + 3) % all.size()), "car " + std::to_string(i));
    }
}

TEST_P(EveryEngine, GivesTheSameBitsInThePapersForm) {
    const SolverDescription paper{.integrator = "abm3",
                                  .constraints = ConstraintMode::stabilized,
                                  .stabilization = StabilizationRule::limit,
                                  .chart = ChassisChart::bryant};
    const std::vector<Simulation> all = cars(3, paper);
    Batch batch(all, options(2));
    batch.advance(300);
    for (std::size_t i = 0; i < all.size(); ++i) {
        expect_same_bits(batch.state(i), alone(all[i], 300), "car " + std::to_string(i));
    }
}

TEST_P(EveryEngine, GivesTheSameBitsInSinglePrecisionWhateverTheLane) {
    const std::vector<Simulation> all = cars(5);
    BatchOptions single = options(1);
    single.precision = Precision::single_precision;
    Batch batch(all, single);
    single.engine = "portable";
    Batch narrow(std::vector<const Simulation*>{&all[3], &all[0]}, single);
    batch.advance(steps), narrow.advance(steps);
    expect_same_bits(narrow.state(0), batch.state(3), "car 3");
    expect_same_bits(narrow.state(1), batch.state(0), "car 0");
}

// One car tips over on its side, one is thrown so hard that its numbers overflow; the others are not affected.
TEST_P(EveryEngine, ReportsCarsThatEndAndKeepsTheOthersAsTheyWere) {
    std::vector<Simulation> all = cars(4);
    ScenarioDescription tipping = test::scenario(10, 10);
    tipping.initial.settle = false, tipping.initial.height = 0.6, tipping.initial.angular_velocity = {4, 0, 0};
    all.insert(all.begin() + 1, Simulation(test::paper_car(), tipping));
    VehicleDescription stiff = test::paper_car();
    for (SuspensionDescription& corner : stiff.suspensions) corner.springs[0].spring.rate *= 1e4;
    ScenarioDescription thrown = test::scenario(10, 10);
    thrown.initial.settle = false, thrown.initial.height = 0.3;
    all.insert(all.begin() + 3, Simulation(stiff, thrown));

    BatchOptions limited = options(1);
    limited.tilt_limit = 1.2;
    Batch batch(all, limited);
    batch.advance(steps);
    EXPECT_EQ(batch.end(1).reason, EndReason::rolled_over);
    EXPECT_NE(batch.end(3).reason, EndReason::none);
    EXPECT_NE(batch.end(3).reason, EndReason::rolled_over);
    for (const std::size_t ended : {std::size_t{1}, std::size_t{3}}) {
        const double time = batch.end(ended).time;
        EXPECT_GT(time, 0);
        EXPECT_LT(time, steps * 1e-3);
        expect_same_bits(batch.state(ended), alone(all[ended], std::lround(time / 1e-3)), "the last good state");
    }
    for (const std::size_t runs : {0, 2, 4, 5}) {
        EXPECT_EQ(batch.end(runs).reason, EndReason::none);
        expect_same_bits(batch.state(runs), alone(all[runs], steps), "car " + std::to_string(runs));
    }
}

TEST(Batch, GoesOnQuietlyWhenAllHaveEnded) {
    ScenarioDescription tipping = test::scenario(10, 10);
    tipping.initial.settle = false, tipping.initial.height = 0.6, tipping.initial.angular_velocity = {4, 0, 0};
    const std::vector<Simulation> all{Simulation(test::paper_car(), tipping)};
    Batch batch(all, {.threads = 1, .tilt_limit = 1.0});
    batch.advance(2000);
    EXPECT_EQ(batch.end(0).reason, EndReason::rolled_over);
    EXPECT_DOUBLE_EQ(batch.time(), 2.0);
    const State<double> last = batch.state(0);
    batch.advance(10);
    expect_same_bits(batch.state(0), last, "an ended car");
}

TEST(Batch, TakesAnotherDriverOnTheWay) {
    const std::vector<Simulation> all = cars(2);
    Batch batch(all, {.threads = 1});
    batch.advance(100);
    batch.set_schedule(0, all[1].schedule());
    Batch same(all, {.threads = 1});
    same.advance(100);
    EXPECT_EQ(batch.state(0).values, same.state(0).values);
    batch.advance(400), same.advance(400);
    EXPECT_NE(batch.state(0).values, same.state(0).values);
    EXPECT_EQ(batch.state(1).values, same.state(1).values);
}

// What docs/batch.md states: a lane change of 15 s in floats stays within 5 cm of the same in doubles.
TEST(Batch, SinglePrecisionStaysNearDouble) {
    ScenarioDescription s = test::scenario(15, 20);
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({1, 2, 3, 4, 5, 6}, {0, 0.004, 0, -0.004, 0, 0});
    s.drive = test::table({0, 0.2, 15}, {100, 150, 150});
    const std::vector<Simulation> all{Simulation(test::paper_car(), s)};
    Batch doubles(all, {.threads = 1}), singles(all, {.threads = 1, .precision = Precision::single_precision});
    doubles.advance(15000), singles.advance(15000);
    const State<double> a = doubles.state(0), b = singles.state(0);
    const double gap = (a.position() - b.position()).norm();
    std::printf("after %.0f m: %.2e m between double and single precision\n", a.position().norm(), gap);
    EXPECT_LT(gap, 0.05);
}

TEST(Batch, RefusesWhatCannotShareAChunk) {
    const auto message = [](const std::vector<Simulation>& all, const BatchOptions& options) -> std::string {
        try {
            Batch(all, options);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "accepted";
    };
    using testing::HasSubstr;
    EXPECT_THAT(message({}, {}), HasSubstr("at least one car"));
    std::vector<Simulation> all = cars(2);
    all.push_back(various(2, {.step = 5e-4}));
    EXPECT_THAT(message(all, {}), HasSubstr("car 3 cannot share a chunk with the first one: they differ in step"));
    all.back() = various(2, {.integrator = "rk4"});
    EXPECT_THAT(message(all, {}), HasSubstr("integrator"));
    VehicleDescription springs = test::conservative_car();
    all.back() = Simulation(springs, test::scenario(1));
    EXPECT_THAT(message(all, {}), HasSubstr("tire model of wheel 1"));
    EXPECT_THAT(message({various(0, {.integrator = "dopri5"})}, {}), HasSubstr("fixed steps"));
    all.pop_back();
    all[1].advance();
    EXPECT_THAT(message(all, {}), HasSubstr("has already been advanced"));
    EXPECT_THAT(message(cars(1), {.engine = "sse9"}), HasSubstr("\"sse9\": expected one"));
}

TEST(WorkerPool, DoesEveryPieceOnceAndPassesFailuresOn) {
    WorkerPool pool(3);
    for (int round = 0; round < 200; ++round) {
        std::vector<int> done(17, 0);
        pool.run(17, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
        EXPECT_THAT(done, testing::Each(1));
    }
    EXPECT_THROW(pool.run(5,
                          [](int i) {
                              if (i == 3) throw std::runtime_error("piece 3");
                          }),
                 std::runtime_error);
    int after = 0;
    WorkerPool(1).run(4, [&](int) { ++after; });
    EXPECT_EQ(after, 4);
}

}  // namespace
}  // namespace hamilcar
