// The compiled step against the plain program: the same bits by every engine, for every shipped vehicle, tire, driveline, kind of
// road, integrator and constraint mode, in whatever situation; and a caller whose arithmetic is left as it was.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/bench/engine_car.hpp"
#include "hamilcar/engine/flush_denormals.hpp"
#include "road/crg_shapes.hpp"
#include "support/fleet.hpp"
#include "support/tires.hpp"

namespace hamilcar {
namespace {

// By the blocks as they are written. Copies the simulation's start.
State<double> driven_plainly(const Simulation& simulation, long steps) {
    const SolverDescription& solver = simulation.scenario().solver;
    Integrator<State<double>> integrator(*find_method(solver.integrator), solver.step,
                                         simulation.model().vehicle.state_size, solver.tolerance);
    State<double> state = simulation.state();
    const FlushDenormals flush;
    for (long i = 0; i < steps; ++i) {
        integration_block(simulation.model(), integrator, simulation.schedule(), static_cast<double>(i) * solver.step,
                          state);
    }
    return state;
}

// A zero may have lost its sign (program/graph.hpp); all else is to be the same to the last bit.
void expect_same_bits_by_every_engine(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                                      long steps, const std::string& what) {
    const Simulation simulation(vehicle, scenario);
    const State<double> expected = driven_plainly(simulation, steps);
    const auto size = static_cast<std::size_t>(simulation.model().vehicle.state_size);
    double moved = 0;
    for (std::size_t k = 0; k < size; ++k) {
        ASSERT_TRUE(std::isfinite(expected.values[k])) << what << ", number " << k;
        moved += std::abs(expected.values[k] - simulation.state().values[k]);
    }
    EXPECT_GT(moved, 0) << what;
    for (const Engine* engine : engines()) {
        EngineCar car(*engine, simulation);
        car.advance(steps);
        for (std::size_t k = 0; k < size; ++k) {
            ASSERT_EQ(car.state().values[k], expected.values[k]) << what << " by " << engine->name << ", number " << k;
        }
    }
}

ScenarioDescription with_kind(ScenarioDescription scenario, const char* integrator, ConstraintMode mode,
                              ChassisChart chart) {
    scenario.solver.integrator = integrator;
    scenario.solver.constraints = mode;
    scenario.solver.stabilization = StabilizationRule::limit;
    scenario.solver.chart = chart;
    return scenario;
}

// The vehicles that come with Hamilcar.
std::vector<std::string> shipped_vehicles() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_path("vehicles"))) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

class EveryVehicle : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, EveryVehicle, testing::ValuesIn(shipped_vehicles()),
                         [](const auto& test) { return test.param; });

// Steering, drive and brake for a second, exact and stabilized, in both charts, with the energy balance and without.
TEST_P(EveryVehicle, DrivesToTheBitsOfThePlainProgram) {
    const VehicleDescription vehicle = test::shipped(GetParam());
    ScenarioDescription scenario = test::everything_moves(vehicle);
    for (SignalDescription* input : {&scenario.drive, &scenario.brake, &scenario.steering}) {
        for (double& time : input->time) time /= 2.5;
    }
    expect_same_bits_by_every_engine(vehicle, scenario, 1000, "exact");
    scenario.solver.energy_balance = false;
    expect_same_bits_by_every_engine(
        vehicle, with_kind(scenario, "ab3", ConstraintMode::stabilized, ChassisChart::bryant), 1000, "stabilized");
}

// Thrown down rolling, so that wheels lift off, stops are hit and the body lands on its side.
TEST_P(EveryVehicle, RollsOverToTheBitsOfThePlainProgram) {
    const VehicleDescription vehicle = test::shipped(GetParam());
    ScenarioDescription scenario = test::scenario(2, 3);
    scenario.initial.settle = false;
    scenario.initial.height = 0.25;
    scenario.initial.angular_velocity = {2.5, 0, 0};
    expect_same_bits_by_every_engine(vehicle, scenario, 1000, "rolling over");
}

TEST_P(EveryVehicle, StandsToTheBitsOfThePlainProgram) {
    ScenarioDescription scenario = test::scenario(2);
    scenario.brake = test::table({0}, {0.5});
    scenario.road.grade = 0.05;
    expect_same_bits_by_every_engine(test::shipped(GetParam()), scenario, 1000, "standing");
}

// Cars of one topology with different masses, springs and hardpoints, in a batch and alone.
TEST_P(EveryVehicle, HasTheSameBitsInABatch) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 5; ++i) {
        VehicleDescription car = test::shipped(GetParam());
        car.chassis.mass *= 1 + 0.03 * i;
        for (SuspensionDescription& corner : car.suspensions) corner.springs[0].spring.rate *= 1 + 0.02 * i;
        for (SuspensionDescription& suspension : car.suspensions) {
            for (CutJointDescription& cut : suspension.linkage.cuts) cut.tip[2] += 5e-4 * i;
            for (SuspensionSpringDescription& spring : suspension.springs) spring.spring.rate *= 1 + 0.02 * i;
        }
        ScenarioDescription scenario = test::everything_moves(car);
        scenario.initial.velocity[0] += i;
        cars.emplace_back(car, scenario);
    }
    for (const Engine* engine : engines()) {
        Batch batch(cars, {.threads = 2, .engine = std::string(engine->name)});
        batch.advance(300);
        for (std::size_t i = 0; i < cars.size(); ++i) {
            const State<double> alone = driven_plainly(cars[i], 300), there = batch.state(i);
            EXPECT_EQ(batch.end(i).reason, EndReason::none);
            for (std::size_t k = 0; k < alone.values.size(); ++k) {
                ASSERT_EQ(there.values[k], alone.values[k]) << engine->name << ", car " << i << ", number " << k;
            }
        }
    }
}

TEST(Engines, RunEveryIntegratorToTheSameBits) {
    for (const Method& method : methods) {
        ScenarioDescription s = test::everything_moves(test::paper_car());
        s.solver.integrator = std::string(method.name);
        if (method.order > 5) s.solver.step = 2e-4;  // their regions of stability are small
        expect_same_bits_by_every_engine(test::paper_car(), s, 250, s.solver.integrator);
    }
}

TEST(Engines, RunEveryTireToTheSameBits) {
    for (const TireDescription& tire : test::slip_tires()) {
        VehicleDescription car = test::paper_car();
        for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].tire = tire;
        expect_same_bits_by_every_engine(car, test::everything_moves(car), 400, std::to_string(tire.index()));
    }
}

TEST(Engines, RunPowerUnitsAndWindToTheSameBits) {
    for (const char* name : {"bmw_e90_330i", "offroader", "electric_hatchback"}) {
        const VehicleDescription car = test::shipped(name);
        ScenarioDescription s = test::scenario(3, 8);
        s.throttle = test::table({0, 0.2, 0.6, 0.8}, {0.1, 0.8, 0.8, 0});
        if (car.power_units[0].gearbox.ratios.size() > 1) {
            s.gear = {{0, 0.5, 0.6}, {1, 1, 2}, Interpolation::linear};
        } else {
            s.gear = test::table({0}, {1});
        }
        s.clutch = test::table({0.4, 0.5, 0.6, 0.7}, {0, 1, 1, 0});
        s.wind_y = test::table({0, 0.5}, {0, 9});
        expect_same_bits_by_every_engine(car, s, 900, name);
    }
}

TEST(Engines, RunEveryElementOfARoadToTheSameBits) {
    const VehicleDescription car = test::shipped_car();
    ScenarioDescription s = test::everything_moves(car);
    s.road.grade = 0.03;
    s.road.random = {{.road_class = 'C', .start = -100}};
    s.road.obstacles.push_back({.shape = ObstacleShape::hump, .start = 3, .length = 2, .height = 0.05});
    s.road.waves.push_back({.amplitude = 0.01, .wavelength = 4, .right_phase = 1});
    s.road.grid =
        std::make_shared<HeightGridDescription>(HeightGridDescription{.x = 1,
                                                                      .y = -2,
                                                                      .spacing_x = 3,
                                                                      .spacing_y = 4,
                                                                      .rows = 2,
                                                                      .columns = 3,
                                                                      .heights = {0, 0.02, 0, 0.01, 0.03, -0.01}});
    s.road.crg =
        std::make_shared<CrgDescription>(test::straight([](double u, double v) { return 0.01 * u + 0.01 * v; }));
    s.road.patches.push_back({.start = 4, .end = 9, .right = -9, .left = 0, .friction = 0.3});
    s.road.posts.height.push_back(test::table({0, 0.5, 1}, {0, 0.02, 0}));
    expect_same_bits_by_every_engine(car, s, 600, "struts and trailing arms");
    expect_same_bits_by_every_engine(test::shipped("truck_semitrailer"), s, 300, "with a trailer");
}

// States that decay toward zero would become denormals.
TEST(Engines, LetACarStandToTheSameBits) {
    expect_same_bits_by_every_engine(test::paper_car(), test::scenario(20), 20000, "standing");
}

TEST(Engines, AreTheFastestFirstAndFoundByName) {
    EXPECT_EQ(engines().back()->name, "portable");
    EXPECT_EQ(&default_engine(), engines().front());
    for (const Engine* one : engines()) EXPECT_EQ(&engine(one->name), one);
    try {
        engine("sse9");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("\"sse9\": expected one that this machine supports: "));
        EXPECT_THAT(error.what(), testing::HasSubstr("portable"));
    }
#if defined(__x86_64__)
    EXPECT_EQ(refused_engines(), "");
    EXPECT_GT(engines().size(), 1u);
#endif
}

TEST(RhsProgram, IsSharedByRunsOfOneVehicle) {
    const Simulation one(test::paper_car(), test::scenario(1)), same(test::paper_car(), test::scenario(1, 5));
    VehicleDescription heavier = test::paper_car();
    heavier.chassis.mass += 1;
    const Simulation other(heavier, test::scenario(1));
    const Engine& engine = default_engine();
    EXPECT_EQ(rhs_program(one.model(), engine), rhs_program(same.model(), engine));
    EXPECT_NE(rhs_program(one.model(), engine), rhs_program(other.model(), engine));
}

// Without the energy balance its operations are not compiled.
TEST(RhsProgram, LeavesOutTheUnusedEnergyBalance) {
    Model<double> model = test::make_model(test::paper_car());
    model.energy_balance = true;
    const auto with = rhs_trace_without_dead_code(model).graph.size();
    model.energy_balance = false;
    EXPECT_LT(rhs_trace_without_dead_code(model).graph.size(), with);
}

TEST(FlushDenormals, LastsForItsLifetime) {
    volatile double tiny = 1e-300, factor = 1e-10;  // the product, 1e-310, is denormal
    EXPECT_NE(tiny * factor, 0);
    {
        const FlushDenormals flush;
        EXPECT_EQ(tiny * factor, 0);
        EXPECT_EQ(tiny * 1e5, 1e-295);
    }
    EXPECT_NE(tiny * factor, 0);
    EngineCar(default_engine(), Simulation(test::paper_car(), test::scenario(1))).advance(1);
    EXPECT_NE(tiny * factor, 0) << "a step leaves the caller's arithmetic as it was";
}

}  // namespace
}  // namespace hamilcar
