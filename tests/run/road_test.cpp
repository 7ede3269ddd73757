// Cars on roads that are not planes: over cleats, rough roads and grids, on split and jumping friction, on posts. What they
// show is compared with planes, with closed forms and with smaller steps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hamilcar/batch/batch.hpp"
#include "support/car.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

// A quantity every 10 ms.
template <class Read>
std::vector<double> history(const VehicleDescription& car, ScenarioDescription s, double step, const Read& read) {
    s.solver.step = step;
    Simulation simulation(car, s);
    std::vector<double> out;
    const long each = std::lround(0.01 / step);
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) {
            ADD_FAILURE() << end->message;
            break;
        }
        if (simulation.steps_taken() % each == 0) out.push_back(read(simulation));
    }
    return out;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    EXPECT_EQ(a.size(), b.size());
    double worst = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

ObstacleDescription cleat() {
    return {.shape = ObstacleShape::plateau, .start = 3, .length = 0.1, .height = 0.02, .ramp = 0.03};
}

// The front wheel's load and the chassis' height while crossing: halving the step changes them less each time.
TEST(UnevenRoad, CrossingACleatConvergesWithTheStep) {
    for (const double speed : {5 / 3.6, 30 / 3.6, 100 / 3.6}) {
        ScenarioDescription s = test::scenario(std::max(6 / speed, 0.5), speed);
        s.road.obstacles = {cleat()};
        const auto load = [](const Simulation& at) { return at.sample().momenta.suspensions[0].wheels[0].tire.Fz; };
        const auto height = [](const Simulation& at) { return at.state().position()[2]; };
        std::vector<double> loads, heights;
        std::vector<std::vector<double>> load_runs, height_runs;
        for (const double step : {1e-3, 0.5e-3, 0.25e-3, 0.125e-3}) {
            load_runs.push_back(history(test::shipped_car(), s, step, load));
            height_runs.push_back(history(test::shipped_car(), s, step, height));
        }
        for (std::size_t i = 0; i + 1 < load_runs.size(); ++i) {
            loads.push_back(distance(load_runs[i], load_runs[i + 1]));
            heights.push_back(distance(height_runs[i], height_runs[i + 1]));
        }
        const double peak = *std::max_element(load_runs.back().begin(), load_runs.back().end());
        std::printf("%3.0f km/h: peak load %.0f N; changes %.2e %.2e %.2e N, %.1e %.1e %.1e m\n", 3.6 * speed, peak,
                    loads[0], loads[1], loads[2], heights[0], heights[1], heights[2]);
        EXPECT_GT(peak, 3059 * 1.25) << "the cleat is felt";
        EXPECT_LT(loads[2], 0.3 * loads[0]);
        EXPECT_LT(heights[0], 1e-4);
        EXPECT_LT(heights[2], 0.3 * heights[0]);
    }
}

std::shared_ptr<const HeightGridDescription> slope_as_grid(double grade, double bank) {
    auto grid = std::make_shared<HeightGridDescription>();
    grid->x = -60, grid->y = -60, grid->spacing_x = grid->spacing_y = 2, grid->rows = grid->columns = 80;
    for (int row = 0; row < 80; ++row) {
        for (int column = 0; column < 80; ++column) {
            grid->heights.push_back(grade * (-60 + 2 * column) + bank * (-60 + 2 * row));
        }
    }
    return grid;
}

// A grid that is a slope against the plane of the same slope, up and down: start, contacts and hull.
TEST(UnevenRoad, AGridOfASlopeIsThePlane) {
    for (const double grade : {0.05, -0.15}) {
        ScenarioDescription on_plane = test::scenario(3, 10);
        on_plane.initial.position = {5, 3};
        on_plane.steering_input = SteeringInput::steering_wheel;
        on_plane.steering = test::table({0.3, 0.8, 1.6}, {0, 1, -0.5});
        ScenarioDescription on_grid = on_plane;
        on_plane.road.grade = grade, on_plane.road.bank = -0.03;
        on_grid.road.grid = slope_as_grid(grade, -0.03);
        for (const int axis : {0, 1, 2}) {
            const auto place = [axis](const Simulation& at) { return at.state().position()[axis]; };
            const auto a = history(test::shipped_car(), on_plane, 1e-3, place);
            const auto b = history(test::shipped_car(), on_grid, 1e-3, place);
            EXPECT_LT(distance(a, b), 1e-7) << "axis " << axis << ", grade " << grade;
        }
    }
}

// Deep in a valley of the grid a car that goes over lies on the ground there and not on a plane far above.
TEST(UnevenRoad, ACarOnItsRoofLiesOnTheGround) {
    ScenarioDescription s = test::scenario(6);
    s.road.grid = slope_as_grid(-0.02, 0);
    s.initial.position = {40, 0};
    s.initial.velocity = {0, 22, 0};
    s.initial.angular_velocity = {2.1, 0, 0};
    Simulation simulation(test::shipped_car(), s);
    double most_tilted = 1;
    while (!simulation.finished()) {
        if (const auto end = simulation.advance()) FAIL() << end->message;
        most_tilted = std::min(most_tilted, simulation.sample().velocity.R_GC(2, 2));
    }
    const Vec3<double> at = simulation.state().position();
    EXPECT_LT(most_tilted, 0) << "the car was to go over";
    const Vec3<double> middle = at + simulation.sample().velocity.R_GC * Vec3<double>(-1.2, 0, 0.6);
    EXPECT_GT(middle[2], -0.02 * middle[0]) << "above the ground";
    EXPECT_LT(middle[2], -0.02 * middle[0] + 1.2) << "and on it";
}

// Nothing takes energy but the road's own motion under the wheels, and that is in the energy balance, which closes at the
// integrator's order.
TEST(UnevenRoad, KeepsItsEnergyBalance) {
    ScenarioDescription s = test::scenario(1.5, 12);
    s.solver.integrator = "rk4";
    s.road.waves = {{.amplitude = 0.03, .wavelength = 4, .right_phase = 1}};
    s.road.random = {{.road_class = 'C', .start = -50}};
    const auto worst = [&](double step) {
        s.solver.step = step;
        Simulation simulation(test::made_conservative(test::shipped_car()), s);
        double error = 0, swing = 0;
        const double start = simulation.sample().energy.balance(), kinetic = simulation.sample().energy.kinetic;
        while (!simulation.finished()) {
            EXPECT_FALSE(simulation.advance());
            if (simulation.steps_taken() % 20) continue;
            const Sample sample = simulation.sample();
            error = std::max(error, std::abs(sample.energy.balance() - start));
            swing = std::max(swing, std::abs(sample.energy.kinetic - kinetic));
        }
        return std::pair(error, swing);
    };
    const auto [coarse, swing] = worst(2e-3);
    const double middle = worst(1e-3).first, fine = worst(0.5e-3).first;
    std::printf("energy: %.1e, %.1e, %.1e J of a swing of %.0f J\n", coarse, middle, fine, swing);
    EXPECT_GT(swing, 100);
    EXPECT_LT(middle, coarse / 8);
    EXPECT_LT(fine, middle / 8);
    EXPECT_LT(fine, 1e-3);
}

TEST(Friction, ASplitRoadPullsTheBrakedCarToItsGrip) {
    ScenarioDescription s = test::scenario(2.5, 20);
    s.road.patches = {{.right = -100, .left = 0, .friction = 0.2}};
    s.brake = test::table({0.3, 0.5, 2.5}, {0, 0.6, 0.6});
    Simulation simulation(test::shipped_car(), s);
    while (simulation.time() < 0.8) ASSERT_FALSE(simulation.advance());
    const Sample sample = simulation.sample();
    const auto& left = sample.momenta.suspensions[0].wheels[0];
    const auto& right = sample.momenta.suspensions[1].wheels[0];
    EXPECT_NEAR(left.contact.friction, 1, 1e-12);
    EXPECT_NEAR(right.contact.friction, 0.2, 1e-12);
    EXPECT_LT(left.tire.Fx, 3 * right.tire.Fx);
    EXPECT_GT(angular(sample.velocity.chassis)[2], 0.05) << "to the left, where the grip is";
}

TEST(Friction, AnIcePatchIsFeltWhereItIs) {
    ScenarioDescription s = test::scenario(2, 15);
    s.road.patches = {{.start = 8, .end = 14, .friction = 0.1}};
    s.brake = test::table({0, 0.2, 2}, {0, 0.35, 0.35});
    std::vector<double> before, on, after;
    Simulation simulation(test::shipped_car(), s);
    while (!simulation.finished()) {
        ASSERT_FALSE(simulation.advance());
        const double x = simulation.state().position()[0];  // the origin is between the front wheels
        const Sample sample = simulation.sample();
        const double force =
            -sample.momenta.suspensions[0].wheels[0].tire.Fx / sample.momenta.suspensions[0].wheels[0].tire.Fz;
        if (x > 5 && x < 7) before.push_back(force);
        if (x > 9.5 && x < 13) on.push_back(force);
        if (x > 16 && x < 18) after.push_back(force);
    }
    ASSERT_FALSE(before.empty() || on.empty() || after.empty());
    EXPECT_GT(before.back(), 0.3);
    EXPECT_LT(on.back(), 0.13);
    EXPECT_GT(after.back(), 0.3);
}

// Far below the body's frequency the car follows the posts; posts that heave together move nothing else.
TEST(Posts, CarryTheCarUpAndDown) {
    ScenarioDescription s = test::scenario(12);
    SignalDescription post;
    for (int i = 0; i <= 240; ++i) {
        post.time.push_back(0.05 * i);
        post.value.push_back(0.02 * (1 - std::cos(2 * std::numbers::pi * 0.05 * i / 6)));
    }
    s.road.posts.height.assign(4, post);
    Simulation simulation(test::shipped_car(), s);
    const double start = simulation.state().position()[2];
    while (simulation.time() < 3) ASSERT_FALSE(simulation.advance());
    EXPECT_NEAR(simulation.state().position()[2] - start, 0.04, 0.002);
    test::run_to_end(simulation);
    EXPECT_NEAR(simulation.state().position()[2] - start, 0, 1e-3);
    const Sample end = simulation.sample();
    EXPECT_LT(std::abs(end.energy.balance() - simulation.initial_energy_balance()), 1e-2);
}

// In a batch every car has a road of its own, and the bits of a run of its own.
TEST(UnevenRoad, LanesComputeTheBitsOfLoneCars) {
    std::vector<ScenarioDescription> scenarios(3, test::scenario(0.3, 15));
    scenarios[0].road.obstacles = {cleat()};
    scenarios[2].road.random = {{.road_class = 'D', .start = -20}};
    scenarios[2].road.patches = {{.start = 2, .end = 3, .friction = 0.3}};
    std::vector<Simulation> cars;
    for (const auto& s : scenarios) cars.emplace_back(test::shipped_car(), s);
    Batch batch(cars, {.threads = 1});
    batch.advance(300);
    for (std::size_t i = 0; i < scenarios.size(); ++i) {
        Simulation alone(test::shipped_car(), scenarios[i]);
        test::run_to_end(alone);
        const State<double> lane = batch.state(i);
        for (int k = 0; k < alone.model().vehicle.state_size; ++k) {
            ASSERT_EQ(lane.values[static_cast<std::size_t>(k)], alone.state().values[static_cast<std::size_t>(k)])
                << "car " << i << ", number " << k;
        }
    }
}

}  // namespace
}  // namespace hamilcar
