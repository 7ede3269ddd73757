// An independent engine: the shipped car, from the same file, in Simbody (free spindles, constraints with multipliers,
// wheels as bodies, force laws written a second time). Driven, steered and braked for 6 s over 90 m, both cars take the
// same path within 2e-8 m and 2e-10 rad, with the default method and its step of 1 ms within 5e-7 m. Simbody's car in
// relative coordinates, the peer of the benchmark, takes it as well.
#include <gtest/gtest.h>

#include "oracle/hand_over.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

struct Gap {
    double position = 0, angle = 0;
};
Gap gap_between(const oracle::CarState& one, const oracle::CarState& other) {
    const Vec3<double> a(one.position.data()), b(other.position.data());
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> A(one.rotation.data()),
        B(other.rotation.data());
    // The rotation between two close orientations: the skew part of A^T B.
    const Mat3<double> between = A.transpose() * B;
    const Vec3<double> angle(between(2, 1) - between(1, 2), between(0, 2) - between(2, 0),
                             between(1, 0) - between(0, 1));
    return {(a - b).norm(), 0.5 * angle.norm()};
}

void expect_within(const Gap& gap, double position, double angle) {
    testing::Test::RecordProperty("largest_path_gap_m", std::to_string(gap.position));
    std::printf("largest gap: %.2e m, %.2e rad\n", gap.position, gap.angle);
    EXPECT_LT(gap.position, position);
    EXPECT_LT(gap.angle, angle);
}

// Runs both and returns the largest gap over the run, looked at ten times a second.
Gap largest_gap(const ScenarioDescription& scenario) {
    const VehicleDescription car = test::paper_car();
    Simulation simulation(car, scenario);
    oracle::SimbodyCar simbody(car, {scenario.road.grade, scenario.road.bank, scenario.road.friction});
    const auto inputs = oracle::inputs_of(simulation);
    simbody.set_inputs(inputs(0));
    simbody.set_state(oracle::state_of(simulation));
    constexpr double oracle_step = 1e-3, look_every = 0.1;
    const long our_steps = std::lround(look_every / scenario.solver.step);
    Gap largest;
    while (!simulation.finished()) {
        const double t = simulation.time();
        simbody.advance(t, oracle_step, static_cast<int>(std::lround(look_every / oracle_step)), inputs);
        for (long i = 0; i < our_steps; ++i) {
            if (const auto end = simulation.advance()) ADD_FAILURE() << end->message;
        }
        const Gap gap = gap_between(oracle::state_of(simulation), simbody.state());
        largest = {std::max(largest.position, gap.position), std::max(largest.angle, gap.angle)};
    }
    EXPECT_LT(simbody.worst_constraint_error(), 1e-10);
    return largest;
}

ScenarioDescription driven_and_steered() {
    ScenarioDescription s = test::scenario(6, 15);
    s.solver.integrator = "rk4";
    s.solver.step = 5e-4;
    s.drive = test::table({0, 0.5, 3, 3.5}, {0, 500, 500, 0});
    s.brake = test::table({4, 4.5, 6}, {0, 0.15, 0.15});
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({1, 2, 3, 4, 5}, {0, 0.004, -0.004, 0.003, 0});
    return s;
}

TEST(Simbody, TakesTheSamePath) {
    expect_within(largest_gap(driven_and_steered()), 2e-8, 2e-10);
}

TEST(Simbody, TakesTheSamePathAsTheDefaultMethod) {
    ScenarioDescription scenario = driven_and_steered();
    scenario.solver.integrator = "ab3";
    scenario.solver.step = 1e-3;
    expect_within(largest_gap(scenario), 5e-7, 1e-8);
}

TEST(Simbody, AgreesOnASlopeFromRest) {
    ScenarioDescription scenario = driven_and_steered();
    scenario.initial.velocity = {0, 0, 0};
    scenario.road = {.grade = 0.05, .bank = 0.02, .friction = 0.9};
    scenario.brake = {};
    scenario.drive = test::table({0, 0.5, 6}, {0, 900, 900});
    expect_within(largest_gap(scenario), 2e-9, 1e-10);
}

// Simbody's car with free spindles, and in relative coordinates, at 15 m/s, for a bend with drive, then brake.
class SimbodySpindles : public testing::TestWithParam<oracle::SpindleModel> {
protected:
    SimbodySpindles() {
        for (oracle::SimbodyCar* car : {&free, &strut}) {
            car->set_inputs(inputs(0));
            car->set_state(oracle::state_of(simulation));
        }
    }

    static ScenarioDescription bend() {
        ScenarioDescription s = test::scenario(1, 15);
        s.drive = test::table({0, 0.2, 0.3}, {0, 500, 0});
        s.brake = test::table({0.3, 0.5}, {0, 0.15});
        s.steering_input = SteeringInput::rack;
        s.steering = test::table({0, 0.3, 0.6}, {0, 0.006, -0.002});
        return s;
    }

    Simulation simulation{test::paper_car(), bend()};
    std::function<oracle::Inputs(double)> inputs = oracle::inputs_of(simulation);
    oracle::SimbodyCar free{simulation.vehicle(), {}}, strut{simulation.vehicle(), {}, GetParam()};
};

double largest_difference(const oracle::CarState& one, const oracle::CarState& other) {
    double largest = 0;
    const auto compare = [&](double a, double b) { largest = std::max(largest, std::abs(a - b)); };
    for (std::size_t i = 0; i < 3; ++i) compare(one.velocity[i], other.velocity[i]);
    for (std::size_t i = 0; i < 3; ++i) compare(one.angular_velocity[i], other.angular_velocity[i]);
    for (std::size_t i = 0; i < one.suspensions.size(); ++i) {
        const oracle::TreeState &a = one.suspensions[i], &b = other.suspensions[i];
        for (std::size_t k = 0; k < a.coordinates.size(); ++k) {
            compare(a.coordinates[k], b.coordinates[k]);
            compare(a.rates[k], b.rates[k]);
        }
        compare(a.wheels[0].spin, b.wheels[0].spin);
    }
    return largest;
}

TEST_P(SimbodySpindles, HaveTheSameAccelerationsOnTheirStruts) {
    const double now = 0.15, h = 1e-4;
    free.advance(0, 1e-3, 150, inputs);
    ASSERT_GT(inputs(now).rack_rate, 0.01);
    strut.set_inputs(inputs(now));
    strut.set_state(free.state());
    EXPECT_LT(strut.worst_constraint_error(), 1e-12);
    EXPECT_LT(largest_difference(free.state(), strut.state()), 1e-11);
    EXPECT_NEAR(strut.energy() / free.energy(), 1, 1e-12);

    const oracle::CarState before = free.state();
    free.advance(now, h, 1, inputs);
    strut.advance(now, h, 1, inputs);
    EXPECT_GT(largest_difference(before, free.state()) / h, 1);  // [m/s^2 or rad/s^2]
    EXPECT_LT(largest_difference(free.state(), strut.state()) / h, 1e-6);
}

TEST_P(SimbodySpindles, TakeTheSamePathOnTheirStruts) {
    free.advance(0, 1e-3, 500, inputs);
    strut.advance(0, 1e-3, 500, inputs);
    const Gap gap = gap_between(free.state(), strut.state());
    std::printf("gap: %.2e m, %.2e rad\n", gap.position, gap.angle);
    EXPECT_LT(gap.position, 1e-7);
    EXPECT_LT(gap.angle, 1e-7);
    EXPECT_LT(strut.worst_constraint_error(), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Struts, SimbodySpindles,
                         testing::Values(oracle::SpindleModel::strut, oracle::SpindleModel::strut_one_constraint),
                         [](const auto& model) {
                             const bool own = model.param == oracle::SpindleModel::strut;
                             return own ? "BuiltInConstraints" : "OneConstraint";
                         });

}  // namespace
}  // namespace hamilcar
