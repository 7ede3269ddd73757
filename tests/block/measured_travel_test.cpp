// What sensors of wheel travel read, against channels and finite differences, and which of it a controller is shown.
#include <gtest/gtest.h>

#include "hamilcar/block/measurement.hpp"
#include "hamilcar/control/kinds.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "hamilcar/run/channels.hpp"
#include "support/active_chassis.hpp"

namespace hamilcar {
namespace {

std::vector<double> measured(const Simulation& run) {
    State<double> rate;
    const FlushDenormals flush;
    const auto all = evaluate_rhs(run.model(), run.schedule()(run.time()), run.state(), rate).measured;
    return {all.begin(), all.begin() + MeasurementPlaces(run.model().vehicle).size};
}

// A lane change over a bump on one side.
ScenarioDescription bumpy(const VehicleDescription& car, double step) {
    ScenarioDescription s = test::everything_moves(car, 1.2);
    s.solver.integrator = "rk4", s.solver.step = step;
    s.road.obstacles.push_back({.shape = ObstacleShape::hump, .start = 3, .length = 2, .height = 0.04, .right = 0});
    return s;
}

class MeasuredTravel : public testing::TestWithParam<const char*> {
protected:
    VehicleDescription car_ = test::told(test::with_both(test::shipped(GetParam())));
};
INSTANTIATE_TEST_SUITE_P(Cars, MeasuredTravel,
                         testing::Values("bmw_323i", "formula", "hatchback", "offroader", "truck_semitrailer"),
                         [](const auto& test) { return test.param; });

TEST_P(MeasuredTravel, IsWhatTheChannelShowsAndItsRate) {
    constexpr double h = 1e-4;
    Simulation run(car_, bumpy(car_, h));
    const MeasurementPlaces places(run.model().vehicle);
    std::vector<const Channel*> travels;
    const std::vector<Channel> all = all_channels(run.vehicle());
    for_each_wheel(car_, [&](const SuspensionWheelDescription& wheel, std::size_t) {
        const auto name = [](const Channel& one) { return one.column.name; };
        const auto found = std::ranges::find(all, wheel.name + ".wheel.travel", name);
        ASSERT_NE(found, all.end()) << wheel.name;
        travels.push_back(&*found);
    });
    const auto shown = [&] {
        std::vector<double> out;
        const Sample at = run.sample();
        for (const Channel* one : travels) out.push_back(one->read(at));
        return out;
    };
    std::vector<double> fastest(travels.size());
    while (run.time() < 1) {
        for (int i = 0; i < 500; ++i) ASSERT_FALSE(run.advance());
        const std::vector<double> before = shown();
        ASSERT_FALSE(run.advance());
        const std::vector<double> there = shown(), numbers = measured(run);
        ASSERT_FALSE(run.advance());
        const std::vector<double> after = shown();
        for (std::size_t i = 0; i < travels.size(); ++i) {
            const double speed = numbers[static_cast<std::size_t>(places.travel_speed) + i];
            EXPECT_NEAR(numbers[static_cast<std::size_t>(places.travel) + i], there[i], 1e-12) << i;
            EXPECT_NEAR(speed, (after[i] - before[i]) / (2 * h), 2e-5 + 1e-4 * std::abs(speed))
                << "wheel " << i << " at " << run.time();
            fastest[i] = std::max(fastest[i], std::abs(speed));
        }
    }
    for (const double one : fastest) EXPECT_GT(one, 0.01);
}

// Remembers what it is shown.
class Watcher final : public Controller {
public:
    explicit Watcher(std::size_t wheels) : wheels_(wheels) {}
    std::size_t memory_size() const override { return 2 * wheels_ + 2; }
    void decide(const Measured& shown, std::span<double> memory, const Commands&) const override {
        std::ranges::copy(shown.travel, memory.begin());
        std::ranges::copy(shown.travel_speed, memory.begin() + static_cast<std::ptrdiff_t>(wheels_));
        memory[2 * wheels_] = shown.rotor_speed.empty() ? 0 : shown.rotor_speed[0];
        memory[2 * wheels_ + 1] = shown.steering_wheel;
    }
    double activity(std::span<const double>) const override { return 0; }

private:
    std::size_t wheels_;
};

TEST_P(MeasuredTravel, IsShownToControllers) {
    if (!find_controller_kind("watcher")) {
        add_controller_kind({.keyword = "watcher",
                             .meaning = "looks on",
                             .keys = {},
                             .lacks = [](const VehicleDescription&) { return std::string(); },
                             .make =
                                 [](const ControllerSettings&, const ControlledCar& car) {
                                     return std::unique_ptr<const Controller>(new Watcher(car.wheels.size()));
                                 }});
    }
    const VehicleDescription car = test::controlled_by(car_, {test::controller("watcher", 1000)});
    ScenarioDescription s = bumpy(car, 1e-3);
    s.drive = {}, s.throttle = test::table({0}, {0.3}), s.gear = {{0}, {1}, Interpolation::steps};
    s.initial.velocity[0] = 6;
    Simulation run(car, s);
    for (int i = 0; i < 600; ++i) ASSERT_FALSE(run.advance());
    const std::vector<double> before = measured(run);
    ASSERT_FALSE(run.advance());
    ASSERT_FALSE(run.advance());
    const MeasurementPlaces places(run.model().vehicle);
    const auto wheels = static_cast<std::size_t>(places.travel_speed - places.travel);
    const std::vector<double>& memory = run.control_memory();
    const double* seen = memory.data() + memory.size() - (2 * wheels + 2);
    for (std::size_t i = 0; i < 2 * wheels; ++i) {
        EXPECT_EQ(seen[i], before[static_cast<std::size_t>(places.travel) + i]) << i;
    }
    EXPECT_EQ(seen[2 * wheels], before[static_cast<std::size_t>(places.rotor_speed)]);
    EXPECT_NE(seen[2 * wheels], 0);
    EXPECT_NE(seen[2 * wheels + 1], 0) << "the steering wheel stands behind them";
}

}  // namespace
}  // namespace hamilcar
