// Channels compiled for a batch against the same channels read off the plain blocks: the same bits, of every vehicle, in every
// lane, by every engine.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/run/channels.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

// Driven around a bend under power, so that everything moves.
ScenarioDescription bend(const VehicleDescription& vehicle, double speed) {
    ScenarioDescription s = test::scenario(5, speed);
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0, 0.3}, {0, 0.2 * vehicle.steering.rack_travel});
    if (!vehicle.power_units.empty()) {
        s.throttle = test::table({0, 0.2}, {0.2, 0.7});
        s.driver.shifting.emplace();
    }
    s.brake = test::table({0.4, 0.5}, {0, 0.1});
    return s;
}

struct Compiled {
    std::vector<Channel> channels;
    TracedReaders readers;
    explicit Compiled(const VehicleDescription& vehicle) {
        for (Channel& channel : all_channels(vehicle)) {
            if (!channel.trace) continue;
            readers.push_back(channel.trace);
            channels.push_back(std::move(channel));
        }
    }
};

class CompiledChannels : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(EveryVehicle, CompiledChannels, testing::ValuesIn(test::fleet()),
                         [](const auto& test) { return test.param; });

TEST_P(CompiledChannels, HaveTheBitsOfPlainOnes) {
    VehicleDescription vehicle = test::shipped(GetParam());
    std::vector<Simulation> cars;
    for (int i = 0; i < 5; ++i) {
        vehicle.chassis.mass *= 1.01;
        cars.emplace_back(vehicle, bend(vehicle, 8.0 + i));
    }
    const Compiled compiled(cars[0].vehicle());
    for (const Engine* engine : engines()) {
        Batch batch(cars, {.threads = 1, .engine = std::string(engine->name)});
        const Batch::Sampler sampler = batch.sampler(compiled.readers);
        std::vector<double> values(cars.size() * sampler.count);
        for (const long steps : {0L, 1L, 700L}) {
            batch.advance(steps);
            if (steps == 1) batch.restart(3);
            batch.sample(sampler, values.data());
            for (std::size_t car = 0; car < cars.size(); ++car) {
                const State<double> state = batch.state(car);
                const Sample plain = sample_at(cars[car].model(), state, batch.schedule(car)(batch.time(car)));
                for (std::size_t k = 0; k < sampler.count; ++k) {
                    const double expected = compiled.channels[k].read(plain), found = values[car * sampler.count + k];
                    ASSERT_TRUE(expected == found)
                        << engine->name << ", car " << car << ", " << compiled.channels[k].column.name << ": "
                        << expected << " and " << found;
                }
            }
        }
    }
}

TEST_P(CompiledChannels, AreNearPlainOnesInSinglePrecision) {
    const VehicleDescription vehicle = test::shipped(GetParam());
    const std::vector<Simulation> cars{Simulation(vehicle, bend(vehicle, 12))};
    const Compiled compiled(cars[0].vehicle());
    Batch batch(cars, {.threads = 1, .precision = Precision::single_precision});
    const Batch::Sampler sampler = batch.sampler(compiled.readers);
    std::vector<double> values(sampler.count);
    batch.advance(300);
    batch.sample(sampler, values.data());
    const State<double> state = batch.state(0);
    const Sample plain = sample_at(cars[0].model(), state, batch.schedule(0)(batch.time(0)));
    std::size_t near = 0;
    for (std::size_t k = 0; k < sampler.count; ++k) {
        ASSERT_TRUE(std::isfinite(values[k])) << compiled.channels[k].column.name;
        const double expected = compiled.channels[k].read(plain);
        near += std::abs(values[k] - expected) <= 1e-3 * std::max(1.0, std::abs(expected));
    }
    EXPECT_GE(static_cast<double>(near), 0.9 * static_cast<double>(sampler.count));  // the rest are small differences
}

// What controllers and learners look at: motion, controls, wheels, tires, springs, dampers, power units.
TEST(CompiledChannelsOfACar, AreThoseOfMotionAndForces) {
    const std::set<std::string> one_by_one{"chassis.bryant.1", "chassis.bryant.2",      "chassis.bryant.3",
                                           "input.rack_force", "input.steering_torque", "input.steering_wheel",
                                           "engine.gear"};
    std::size_t compiled = 0;
    for (const Channel& channel : all_channels(test::shipped_car())) {
        const std::string& name = channel.column.name;
        const bool looked_at = name.starts_with("chassis.") || name.starts_with("input.") ||
                               name.starts_with("engine.") || name.find(".wheel.") != name.npos ||
                               name.find(".tire.") != name.npos || name.find(".spring.") != name.npos ||
                               name.find(".damper.") != name.npos;
        if (!looked_at || is_motion(channel.column.role)) continue;
        ++compiled;
        EXPECT_EQ(channel.trace == nullptr, one_by_one.contains(name)) << name;
    }
    EXPECT_GT(compiled, 100u);
}

}  // namespace
}  // namespace hamilcar
