// Cars with controllers in a batch, each with settings, sensors and commands of its own: every one has the bits of a Simulation that
// does the same alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "hamilcar/batch/batch.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

// Stops on roads of different friction, by controllers that differ in what their keys say and in how often they decide.
Simulation stopping(int i, const std::vector<std::string>& off = {}) {
    VehicleDescription car = test::shipped("bmw_e90_330i");
    car.chassis.mass *= 1 + 0.02 * i;
    for (ControllerDescription& one : car.controllers) {
        if (one.kind == "abs") one.settings = {{"slip", 0.06 + 0.02 * i}}, one.rate = i % 2 == 0 ? 200 : 125;
    }
    car.sensors.seed = static_cast<std::uint64_t>(i);
    car.sensors.wheel_speed.noise = 0.02 * i;
    if (i % 3 == 1) car.sensors.wheel_speed.delay = 5e-3;
    ScenarioDescription s = test::scenario(3, 20 + i);
    s.road.friction = 0.3 + 0.05 * i;
    s.brake = test::table({0.05, 0.1}, {0, 1});
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0.1, 0.4 + 0.02 * i}, {0, 0.6});
    s.controllers_off = off;
    return Simulation(car, s);
}
std::vector<Simulation> cars(int count) {
    std::vector<Simulation> all;
    for (int i = 0; i < count; ++i) all.push_back(stopping(i));
    return all;
}
Simulation advanced(Simulation simulation, long steps) {
    for (long i = 0; i < steps; ++i) EXPECT_FALSE(simulation.advance().has_value());
    return simulation;
}
void expect_same_car(const Batch& batch, std::size_t car, const Simulation& alone, const std::string& which) {
    const State<double> there = batch.state(car);
    for (std::size_t k = 0; k < there.values.size(); ++k) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(there.values[k]), std::bit_cast<std::uint64_t>(alone.state().values[k]))
            << which << ", number " << k << ": " << there.values[k] << " and " << alone.state().values[k];
    }
    EXPECT_TRUE(std::ranges::equal(batch.schedule(car).commands(), alone.schedule().commands())) << which;
    Snapshot here, of_alone;
    batch.save(car, here), alone.save(of_alone);
    const std::size_t numbers = alone.control_memory().size();
    EXPECT_TRUE(std::equal(here.control.begin(), here.control.begin() + static_cast<std::ptrdiff_t>(numbers),
                           of_alone.control.begin()))
        << which;
}

class ControlledBatch : public testing::TestWithParam<const Engine*> {
protected:
    BatchOptions options() const { return {.threads = 2, .engine = std::string(GetParam()->name)}; }
};
INSTANTIATE_TEST_SUITE_P(All, ControlledBatch, testing::ValuesIn(engines()),
                         [](const auto& test) { return std::string(test.param->name); });

TEST_P(ControlledBatch, HasTheBitsOfEachCarAlone) {
    const std::vector<Simulation> all = cars(9);
    Batch batch(all, options());
    for (const long steps : {1L, 2L, 397L, 200L}) batch.advance(steps);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Simulation alone = advanced(all[i], 600);
        EXPECT_GT(alone.control()->activity(0, alone.control_memory()), 0) << "the anti-lock system works";
        expect_same_car(batch, i, alone, "car " + std::to_string(i));
    }
}

TEST_P(ControlledBatch, BeginsAgainTakesAnotherCarAndGoesBack) {
    const std::vector<Simulation> all = cars(4);
    const Simulation other = stopping(7);
    BatchOptions with_variant = options();
    with_variant.variants = {&other};
    Batch batch(all, with_variant);
    batch.advance(303);
    batch.restart(1);
    batch.replace(2, other);
    batch.advance(204);
    expect_same_car(batch, 0, advanced(all[0], 507), "a neighbor");
    expect_same_car(batch, 1, advanced(all[1], 204), "restarted");
    expect_same_car(batch, 2, advanced(other, 204), "another one");

    Snapshot of_batch, alone;
    batch.save(3, of_batch);
    advanced(all[1], 101).save(alone);
    batch.advance(151);
    batch.restore(3, of_batch);
    batch.restore(1, alone);
    batch.advance(93);
    expect_same_car(batch, 3, advanced(all[3], 600), "gone back");
    expect_same_car(batch, 1, advanced(all[1], 194), "from a Simulation's");

    batch.save(2, of_batch);
    Simulation back(other);
    back.restore(of_batch);
    const Simulation further = advanced(back, 40);
    batch.advance(40);
    expect_same_car(batch, 2, further, "from the batch to a Simulation");
}

// In single precision too a car's decisions are its own, whatever its lane and its neighbors.
TEST_P(ControlledBatch, HasTheSameBitsInEveryLaneInSinglePrecision) {
    const std::vector<Simulation> all = cars(5);
    std::vector<const Simulation*> turned;
    for (const Simulation& car : all) turned.insert(turned.begin(), &car);
    BatchOptions single = options();
    single.precision = Precision::single_precision;
    Batch one(all, single), other(turned, single);
    one.advance(400), other.advance(400);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t there = all.size() - 1 - i;
        const State<double> a = one.state(i), b = other.state(there);
        for (std::size_t k = 0; k < a.values.size(); ++k) ASSERT_EQ(a.values[k], b.values[k]) << i << ", number " << k;
        EXPECT_TRUE(std::ranges::equal(one.schedule(i).commands(), other.schedule(there).commands()));
    }
}

TEST(ControlledBatchOfOneVehicle, RefusesCarsOfWhichOnlySomeHaveControllers) {
    std::vector<Simulation> all{stopping(0), stopping(0, {"all"})};
    try {
        const Batch batch(all, {.threads = 1});
        ADD_FAILURE() << "they share a program";
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("they differ in "));
        EXPECT_THAT(error.what(),
                    testing::AnyOf(testing::HasSubstr("the brake system"), testing::HasSubstr("controllers")));
    }
}

// One that has esc alone takes the same commands.
TEST(ControlledBatchOfOneVehicle, TakesCarsWithDifferentControllers) {
    std::vector<Simulation> all{stopping(0), stopping(1, {"abs"}), stopping(2, {"esc", "traction_control"})};
    Batch batch(all, {.threads = 1});
    batch.advance(500);
    for (std::size_t i = 0; i < all.size(); ++i) {
        expect_same_car(batch, i, advanced(all[i], 500), "car " + std::to_string(i));
    }
}

}  // namespace
}  // namespace hamilcar
