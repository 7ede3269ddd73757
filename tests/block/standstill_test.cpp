// Cars that stand, stop, start and roll over: the low-speed and large-angle limits of the model.
#include <gtest/gtest.h>

#include "support/car.hpp"

namespace hamilcar {
namespace {

TEST(Standstill, BrakedCarOnASlopeStaysInPlace) {
    ScenarioDescription s = test::scenario(60);
    s.road.grade = 0.15;
    s.brake = test::table({0, 1}, {0.5, 0.5});
    Simulation simulation(test::paper_car(), s);
    const Vec3<double> start = simulation.state().position();
    double farthest = 0;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        farthest = std::max(farthest, (Vec3<double>(simulation.state().position()) - start).norm());
    }
    std::printf("farthest from the start in 60 s: %.2e m\n", farthest);
    EXPECT_LT(farthest, 1e-9);
}

TEST(Standstill, WithoutTheBrakeItRollsDown) {
    ScenarioDescription s = test::scenario(2);
    s.road.grade = 0.15;
    Simulation simulation(test::paper_car(), s);
    test::run_to_end(simulation);
    EXPECT_LT(simulation.state().position()[0], -1);
}

TEST(Standstill, CarOnTheFlatStaysInPlace) {
    Simulation simulation(test::paper_car(), test::scenario(60));
    const State<double> start = simulation.state();
    test::run_to_end(simulation);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(simulation.state().position()[i], start.position()[i], 1e-9);
    EXPECT_LT(simulation.sample().energy.kinetic, 1e-12);
}

TEST(Standstill, ABrakedCarStopsAndStays) {
    ScenarioDescription s = test::scenario(10, 20);
    s.brake = test::table({0.5, 0.8, 10}, {0, 0.5, 0.5});
    Simulation simulation(test::paper_car(), s);
    while (simulation.time() < 8 && !simulation.finished()) ASSERT_FALSE(simulation.advance());
    const Vec3<double> stopped = simulation.state().position();
    test::run_to_end(simulation);
    EXPECT_LT((Vec3<double>(simulation.state().position()) - stopped).norm(), 1e-3);
    EXPECT_LT(simulation.sample().velocity.chassis.norm(), 1e-3);
}

TEST(Start, FromRestTheCarDrivesOff) {
    ScenarioDescription s = test::scenario(5);
    s.drive = test::table({0, 0.5, 5}, {0, 600, 600});
    Simulation simulation(test::paper_car(), s);
    test::run_to_end(simulation);
    // T / R_e less rolling resistance over the mass with its wheels: about 1.6 m/s^2 for 4.75 s.
    const double rotating = 4 * 0.85 / (0.288 * 0.288),
                 acceleration = (600 / 0.288 - 0.013 * 1150 * 9.81) / (1150 + rotating);
    EXPECT_NEAR(simulation.sample().velocity.chassis[0], acceleration * 4.75, 0.1);
}

TEST(RollOver, RunsToTheEndWithFiniteNumbers) {
    ScenarioDescription s = test::scenario(5);
    s.initial.velocity = {0, 25, 0};
    s.initial.angular_velocity = {120 * std::numbers::pi / 180, 0, 0};
    Simulation simulation(test::paper_car(), s);
    double min_z_cosine = 1;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        min_z_cosine = std::min(min_z_cosine, simulation.sample().velocity.R_GC(2, 2));
    }
    EXPECT_LT(min_z_cosine, 0) << "the car was to go over";
    for (const double value : simulation.state().values) EXPECT_TRUE(std::isfinite(value));
    EXPECT_LT(simulation.sample().violation, 1e-9);
}

TEST(Equilibrium, HasTheLoadsHeightsAndStrutLengthItWasLaidOutFor) {
    Simulation simulation(test::paper_car(), test::scenario(1));
    const Sample s = simulation.sample();
    // Derived before there was a simulator, as vehicles/bmw_323i.toml grades it: 3059 N in front and 2581 N behind for
    // g = 9.81, a strut of 531.83 mm, wheel centers 0.278 and 0.280 m high.
    for (std::size_t i = 0; i < 4; ++i) {
        const double load = i < 2 ? 3059 : 2581, height = i < 2 ? 0.2778 : 0.2804;
        const WheelForces<double>& f = s.momenta.suspensions[i].wheels[0];
        EXPECT_NEAR(f.tire.Fz, load, 0.001 * load);
        EXPECT_NEAR(f.contact.depth, load / 180e3, 5e-5);
        EXPECT_NEAR(0.2948 - f.contact.depth, height, 2e-4);
        EXPECT_NEAR(f.travel, 0, 2e-4);
    }
    EXPECT_NEAR(s.momenta.suspensions[0].springs[0].length, 0.53183, 2e-4);
    EXPECT_NEAR(*s.model.vehicle.suspensions[2].state(s.state.values.data()).independent, 0, 2e-4 / 0.4185);
}

}  // namespace
}  // namespace hamilcar
