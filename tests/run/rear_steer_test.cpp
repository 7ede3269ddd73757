// Axles that an actuator steers: the rack follows its command as the oscillator that it is, the geometry is that of the linkage, and the
// controller makes turning circles small and lane changes calm.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hamilcar/analysis/wheel_motion.hpp"
#include "hamilcar/run/controlled_car.hpp"
#include "support/active_chassis.hpp"

namespace hamilcar {
namespace {

constexpr double frequency = 6;  // of the actuator [Hz]

// The rear toe link's inner end moves along y.
VehicleDescription rear_steered(std::vector<ControllerDescription> controllers) {
    static const VehicleDescription car = test::shipped_with("bmw_e90_330i", "rear",
                                                             "hardpoints.steered = true\n"
                                                             "hardpoints.rack_axis = [0.0, 1.0, 0.0]\n"
                                                             "steering_actuator.travel_m = 0.03\n"
                                                             "steering_actuator.frequency_hz = 6.0\n"
                                                             "steering_actuator.damping_ratio = 0.8");
    return test::controlled_by(car, std::move(controllers));
}

ScenarioDescription turning(double duration, double speed, double angle) {
    ScenarioDescription s = test::scenario(duration, speed);
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0.1, 0.6}, {0, angle});
    return s;
}

int place_of(const Simulation& run) {
    return run.model().vehicle.axle_steers[0].place;
}

TEST(AxleSteer, FollowsItsCommandAsADampedOscillator) {
    ScenarioDescription s = test::scenario(0.5, 10);
    s.solver.integrator = "rk4";
    Simulation run(rear_steered({test::controller("external", 100)}), s);
    std::vector<double> commands = run.control()->layout().rest();
    commands[static_cast<std::size_t>(run.control()->layout().find("rear.steer"))] = 0.5;
    run.set_commands(commands);
    const double w = 2 * std::numbers::pi * frequency, damping = 0.8, damped = w * std::sqrt(1 - damping * damping);
    while (!run.finished()) {
        ASSERT_FALSE(run.advance());
        const double t = run.time(), fading = std::exp(-damping * w * t);
        const double expected =
            0.5 * (1 - fading * (std::cos(damped * t) + damping * w / damped * std::sin(damped * t)));
        ASSERT_NEAR(run.state().values[static_cast<std::size_t>(place_of(run))], expected, 1e-6) << t;
        EXPECT_NEAR(run.sample().velocity.axle_racks[0].displacement, 0.03 * expected, 1e-6 * 0.03);
    }
    EXPECT_NEAR(run.sample().energy.balance(), run.initial_energy_balance(), 1e-4 * run.sample().energy.kinetic)
        << "the actuator's work is a part of the account";
}

// The wheels turn by what a difference of the linkage's own positions says, and nothing else of the car knows of the rack.
TEST(AxleSteer, TurnsItsWheelsByTheirLinkage) {
    const VehicleDescription car = rear_steered({test::controller("external", 100)});
    Simulation run(car, test::scenario(1.5, 0));
    const auto toe = [&](std::size_t s) {
        const Vec3<double> axis = run.sample().velocity.suspensions[s].axis[0];
        return std::atan2(-axis[0], axis[1]);
    };
    const std::array before{toe(0), toe(1), toe(2), toe(3)};
    const std::vector<WheelMotion> motions = wheel_motions(car, run.model(), run.state(), 0);
    std::vector<double> commands = run.control()->layout().rest();
    commands[static_cast<std::size_t>(run.control()->layout().find("rear.steer"))] = 0.1;
    run.set_commands(commands);
    test::run_to_end(run);
    for (const std::size_t s : {0, 1}) EXPECT_NEAR(toe(s), before[s], 2e-4) << "the front axle stays";
    for (const std::size_t s : {2, 3}) {
        const double by_rack = motions[s].own_steer[5] * 0.003;
        EXPECT_GT(std::abs(by_rack), 0.01);
        EXPECT_NEAR(toe(s) - before[s], by_rack, 0.05 * std::abs(by_rack)) << s;
        EXPECT_EQ(motions[s].steer.norm(), 0) << "it is no wheel that the driver steers";
    }
    for (const std::size_t s : {0, 1}) EXPECT_EQ(motions[s].own_steer.norm(), 0);
}

// Slowly the car turns about a point on the line between its axles' normals: R = L / (tan front - tan rear).
TEST(RearSteer, MakesTheTurningCircleSmaller) {
    const auto radius = [](std::vector<ControllerDescription> controllers) {
        Simulation run(rear_steered(std::move(controllers)), turning(12, 3, 5));
        test::run_to_end(run);
        const Sample s = run.sample();
        return linear(s.velocity.chassis)[0] / angular(s.velocity.chassis)[2];
    };
    const ControllerDescription rear = test::controller("rear_steer", 100, {{"share_at_rest", -0.4}});
    const double without = radius({}), with = radius({rear});
    EXPECT_NEAR(with / without, 1 / 1.4, 0.05);
}

// At 30 m/s the rear wheels turn along: the nose points out by the angle of the rear wheels, as the single track has it, for the same
// lateral acceleration.
TEST(RearSteer, TakesTheSideslipOutOfAFastTurn) {
    struct Turn {
        double sideslip, lateral, rear;  // [rad], [m/s^2], [rad]
    };
    const auto turn = [](std::vector<ControllerDescription> controllers, double angle) {
        ScenarioDescription s = turning(4, 30, angle);
        s.driver.speed.emplace();
        s.driver.speed->speed = {.time = {0}, .value = {30}, .interpolation = Interpolation::linear};
        const VehicleDescription car = rear_steered(std::move(controllers));
        Simulation run(car, s);
        const auto motions = wheel_motions(car, run.model(), run.state(), 0);
        test::run_to_end(run);
        const Sample at = run.sample();
        const Vec3<double> v = velocity_at<double>(at.velocity.chassis, at.model.vehicle.chassis.center);
        return Turn{std::atan2(v[1], v[0]), v[0] * angular(at.velocity.chassis)[2],
                    at.velocity.axle_racks[0].displacement * motions[2].own_steer[5]};
    };
    const Turn without = turn({}, 0.2), with = turn({test::controller("rear_steer", 100)}, 0.3);
    EXPECT_LT(without.sideslip, -0.001) << "the nose points inward";
    EXPECT_NEAR(with.lateral, without.lateral, 0.3 * without.lateral) << "alike enough to be compared";
    EXPECT_GT(with.rear, 0.001);
    const double expected = without.sideslip / without.lateral + with.rear / with.lateral;
    EXPECT_NEAR(with.sideslip / with.lateral, expected, 0.1 * with.rear / with.lateral);
}

// It acts in a run whose steering moves on its own as well.
TEST(RearSteer, GoesWithASteeringThatMovesOnItsOwn) {
    ScenarioDescription s = turning(2, 20, 0.5);
    s.steering_mechanics = true;
    Simulation run(rear_steered({test::controller("rear_steer", 100)}), s);
    test::run_to_end(run);
    EXPECT_GT(std::abs(run.sample().velocity.axle_racks[0].displacement), 1e-4);
    EXPECT_NEAR(run.sample().energy.balance(), run.initial_energy_balance(), 1e-3 * run.sample().energy.kinetic);
}

}  // namespace
}  // namespace hamilcar
