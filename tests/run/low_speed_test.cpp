// Tires where most models fail: standing, parking, stopping, starting, locked and on ice; and that what is found there does
// not depend on the step. Every tire with slip curves drives the shipped car.
#include <gtest/gtest.h>

#include <cmath>

#include "support/car.hpp"
#include "support/tires.hpp"

namespace hamilcar {
namespace {

VehicleDescription car_on(const TireDescription& tire) {
    VehicleDescription car = test::paper_car();
    for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].tire = tire;
    return car;
}

class LowSpeed : public testing::TestWithParam<std::size_t> {
protected:
    VehicleDescription car() const { return car_on(test::slip_tires()[GetParam()]); }
};

Vec3<double> place(const Simulation& simulation) {
    return simulation.state().position();
}

double speed(const Simulation& simulation) {
    return simulation.sample().velocity.chassis.head<3>().norm();
}

#ifdef HAMILCAR_SANITIZED
constexpr double standing = 60;  // [s]; instrumented, ten minutes of a car take minutes of everybody
#else
constexpr double standing = 600;
#endif

TEST_P(LowSpeed, StandsOnASlopeForTenMinutes) {
    ScenarioDescription s = test::scenario(standing);
    s.road.grade = 0.2;
    s.brake = test::table({0, 1}, {0.6, 0.6});
    Simulation simulation(car(), s);
    const Vec3<double> start = place(simulation);
    double farthest = 0;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        farthest = std::max(farthest, (place(simulation) - start).norm());
    }
    std::printf("farthest from the start in %.0f s: %.2e m\n", standing, farthest);
    EXPECT_LT(farthest, 3e-6);
}

TEST_P(LowSpeed, StopsWithoutJudderAndStays) {
    ScenarioDescription s = test::scenario(8, 10);
    s.brake = test::table({0.5, 0.8, 8}, {0, 0.4, 0.4});
    Simulation simulation(car(), s);
    double stopped = -1, farthest = 0, before = 1;
    Vec3<double> there = Vec3<double>::Zero();
    std::array<double, 6> fastest{};  // second by second after the stop
    std::array<int, 6> turns{};
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        const double v = simulation.sample().velocity.chassis[0];
        if (stopped < 0 && v <= 0) stopped = simulation.time(), there = place(simulation);
        if (stopped < 0) continue;
        const auto second = std::min(static_cast<std::size_t>(simulation.time() - stopped), fastest.size() - 1);
        fastest[second] = std::max(fastest[second], std::abs(v));
        turns[second] += v * before < 0;
        before = v;
        farthest = std::max(farthest, (place(simulation) - there).norm());
    }
    ASSERT_GT(stopped, 0);
    EXPECT_LT(farthest, 0.06) << "the body's last nod";
    // The car rocks on its brakes' wind-up and its tires, at some 3 Hz; nothing chatters, and it dies away.
    for (std::size_t second = 1; second < 5; ++second) {
        EXPECT_LT(fastest[second], 0.5 * fastest[second - 1]) << "in second " << second;
        EXPECT_LE(turns[second], 10) << "in second " << second;
    }
    EXPECT_LT(fastest[4], 5e-3);
}

TEST_P(LowSpeed, StartsOnAHill) {
    ScenarioDescription s = test::scenario(4);
    s.road.grade = 0.2;
    s.brake = test::table({0, 0.5, 1.0}, {0.6, 0.6, 0});
    s.drive = test::table({0.3, 1.0}, {0, 1100});
    Simulation simulation(car(), s);
    const Vec3<double> start = place(simulation);
    double back = 0;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        back = std::min(back, (place(simulation) - start)[0]);
    }
    EXPECT_GT(place(simulation)[0] - start[0], 3);
    EXPECT_GT(back, -0.02) << "it does not roll back";
}

TEST_P(LowSpeed, LocksAndReleasesItsWheels) {
    ScenarioDescription s = test::scenario(4, 15);
    s.brake = test::table({0.5, 0.6, 1.2, 1.3, 4}, {0, 1, 1, 0, 0});
    Simulation simulation(car(), s);
    double slowest_spin = 1e9;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        if (simulation.time() > 1.1 && simulation.time() < 1.2) {
            slowest_spin = std::min(slowest_spin, simulation.sample().momenta.suspensions[0].wheels[0].contact.omega);
        }
    }
    EXPECT_LT(std::abs(slowest_spin), 0.5) << "the front wheels were to lock";
    const Sample end = simulation.sample();
    const auto& forces = end.momenta.suspensions[0].wheels[0];
    EXPECT_GT(end.velocity.chassis[0], 3);
    EXPECT_NEAR(forces.contact.omega * 0.288 / end.velocity.chassis[0], 1, 0.02) << "and roll again";
}

TEST_P(LowSpeed, SpinsUpOnIceAndComesBack) {
    ScenarioDescription s = test::scenario(6);
    s.road.friction = 0.1;
    s.drive = test::table({0.2, 0.5, 3, 3.2, 6}, {0, 700, 700, 0, 0});
    Simulation simulation(car(), s);
    double fastest_wheel = 0;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        fastest_wheel = std::max(fastest_wheel, simulation.sample().momenta.suspensions[2].wheels[0].contact.omega);
    }
    const Sample end = simulation.sample();
    EXPECT_GT(fastest_wheel * 0.288, 10) << "the driven wheels spin";
    // Rear axle 45 percent of the weight and more as it squats, at the ice's friction.
    EXPECT_LT(end.velocity.chassis[0], 0.1 * 1.3 * 9.81 * 0.52 * 6);
    EXPECT_GT(end.velocity.chassis[0], 0.5);
    EXPECT_LT(std::abs(end.velocity.chassis[1]), 0.2) << "straight on";
    for (const double number : simulation.state().values) ASSERT_TRUE(std::isfinite(number));
}

TEST_P(LowSpeed, ParksAndTurnsOnTheSpot) {
    ScenarioDescription s = test::scenario(6);
    s.drive = test::table({0.1, 0.3, 1.0, 1.2}, {0, 250, 250, 0});
    s.brake = test::table({2.5, 3.0, 6}, {0, 0.3, 0.3});
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0, 2.0, 3.5, 5.5}, {0, 8, 8, -8});
    Simulation simulation(car(), s);
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
    }
    EXPECT_GT(place(simulation).norm(), 0.3);
    EXPECT_LT(speed(simulation), 0.02);
}

// From parking to the limit: half the step moves no point of the path by ten micrometers.
TEST_P(LowSpeed, PathsDoNotDependOnTheStep) {
    struct Drive {
        const char* name;
        ScenarioDescription scenario;
    };
    std::vector<Drive> drives;
    ScenarioDescription stop = test::scenario(5, 10);
    stop.brake = test::table({0.5, 0.8, 5}, {0, 0.5, 0.5});
    drives.push_back({"stop", stop});
    ScenarioDescription swerve = test::scenario(4, 25);
    swerve.steering_input = SteeringInput::steering_wheel;
    swerve.steering = test::table({0.3, 0.8, 1.6, 2.2}, {0, 1.2, -1.2, 0});
    drives.push_back({"swerve", swerve});
    ScenarioDescription start = test::scenario(4);
    start.road.friction = 0.2;
    start.drive = test::table({0.1, 0.4, 4}, {0, 900, 900});
    drives.push_back({"start on snow", start});
    for (auto& [name, scenario] : drives) {
        const auto path = [&, &scenario = scenario](double step) {
            scenario.solver.step = step;
            Simulation simulation(car(), scenario);
            std::vector<Vec3<double>> points;
            const long each = std::lround(0.1 / step);
            while (!simulation.finished()) {
                EXPECT_FALSE(simulation.advance());
                if (simulation.steps_taken() % each == 0) points.push_back(place(simulation));
            }
            return points;
        };
        const auto once = path(1e-3), half = path(0.5e-3), quarter = path(0.25e-3);
        double first = 0, second = 0;
        for (std::size_t i = 0; i < once.size(); ++i) {
            first = std::max(first, (once[i] - half[i]).norm()),
            second = std::max(second, (half[i] - quarter[i]).norm());
        }
        std::printf("%s: 1 to 0.5 ms %.1e m, 0.5 to 0.25 ms %.1e m\n", name, first, second);
        EXPECT_LT(first, 1e-5) << name;
        EXPECT_LT(second, std::max(0.5 * first, 1e-6)) << name << ": it converges";
    }
}

std::string name_of(const testing::TestParamInfo<std::size_t>& tire) {
    const auto keyword = [](const auto& model) { return std::string(model.keyword); };
    return std::visit(keyword, make_tire<double>(test::slip_tires()[tire.param]));
}
INSTANTIATE_TEST_SUITE_P(Tires, LowSpeed, testing::Range(std::size_t{0}, test::slip_tires().size()), name_of);

}  // namespace
}  // namespace hamilcar
