// Laws that hold for any parameters: energy at the method's order, momentum to 1e-14 of itself, and the energy balance
// of a driven car.
#include <gtest/gtest.h>

#include "support/car.hpp"

namespace hamilcar {
namespace {

// The conservative car thrown spinning: rolling, pitching, yawing, wheels a little too fast, within its travel.
State<double> thrown(const Model<double>& model) {
    const Input<double> input;
    State<double> state = design_state(model, Vec3<double>(0, 0, 0.005), Mat3<double>::Identity());
    EXPECT_TRUE(assemble(model, input.rack, state).assembled);
    Spatial<double> v;
    v << 10, 2, 0.1, 0.12, 0.1, 1.0;
    set_velocities(model, input, v, state);
    for (std::size_t i = 0; i < 4; ++i) {
        model.vehicle.suspensions[i].wheel_state(0, state.values.data()).spin_momentum *=
            1 + 0.1 * static_cast<double>(i);
    }
    return state;
}

struct Outcome {
    double worst_energy_error = 0, stop_force = 0;
    State<double> state;
};

constexpr double tight = 1e-9, any_error = 1e100;  // tolerances of the adaptive method; the second divides no step

Outcome run_thrown(const char* method, double step, double duration, double tolerance = tight) {
    const Model<double> model = test::make_model(test::conservative_car());
    const Input<double> input;
    const auto driver = [&](double) { return input; };
    State<double> state = thrown(model);
    Integrator<State<double>> integrator(*find_method(method), step, model.vehicle.state_size, tolerance);
    const double before = test::energy_of(model, state, input).balance();
    Outcome outcome;
    const int steps = static_cast<int>(std::lround(duration / step));
    for (int i = 0; i < steps; ++i) {
        integration_block(model, integrator, driver, i * step, state);
        const auto velocity = velocity_block(model, state, input);
        const auto momenta = momenta_block(model, state, input, velocity);
        const double error = std::abs(energy(model, state, velocity, momenta).balance() - before);
        outcome.worst_energy_error = std::max(outcome.worst_energy_error, error);
        for (std::size_t j = 0; j < 4; ++j) {
            outcome.stop_force = std::max(outcome.stop_force, std::abs(momenta.suspensions[j].wheels[0].stop));
        }
    }
    outcome.state = state;
    return outcome;
}

// The error of the energy has one order more than the method.
TEST(Energy, ErrorFallsBy32PerHalvingWithRungeKutta) {
    double coarser = 0;
    for (const double step : {2e-3, 1e-3, 5e-4, 2.5e-4}) {
        const Outcome outcome = run_thrown("rk4", step, 1);
        EXPECT_EQ(outcome.stop_force, 0) << "the throw must stay inside the stops, which are kinks";
        std::printf("rk4 h = %g s: worst |dE| = %.3e J\n", step, outcome.worst_energy_error);
        if (coarser > 0) {
            EXPECT_NEAR(coarser / outcome.worst_energy_error, 32, 1) << "step " << step;
        }
        coarser = outcome.worst_energy_error;
    }
}

// The order of the whole state, against a reference at a much smaller step: every fixed-step method has the order it
// states, at most 0.15 below, and so has the adaptive one where it divides no step. ab6 and ab7 are measured in
// tests/integrator alone: here the steps that they are stable with leave errors below 1e-9, too near the reference's own
// for a slope.
// One test, since each runs in a process of its own and the reference takes longest.
TEST(StatedOrder, IsMeasuredOnTheWholeCar) {
    constexpr double duration = 0.2;
    const State<double> reference = run_thrown("rk4", 1e-5, duration).state;
    // Relative to the reference, numbers below one counting as one.
    const auto error = [&](const char* method, double step) {
        const State<double> state = run_thrown(method, step, duration, any_error).state;
        double sum = 0;
        for (std::size_t i = 0; i < state.values.size(); ++i) {
            const double scale = std::max(1.0, std::abs(reference.values[i]));
            sum += std::pow((state.values[i] - reference.values[i]) / scale, 2);
        }
        return std::sqrt(sum);
    };
    for (const char* name : {"ab1", "ab2", "ab3", "ab4", "ab5", "abm2", "abm3", "abm4", "abm5", "rk4", "dopri5"}) {
        const Method& method = *find_method(name);
        const double coarse = method.family == MethodFamily::embedded_runge_kutta ? 4e-3
                              : method.order <= 2                                 ? 1e-3
                                                                                  : 5e-4;
        const double e1 = error(name, coarse), e2 = error(name, coarse / 2), order = std::log2(e1 / e2);
        std::printf("%s: error %.2e, %.2e, order %.2f\n", name, e1, e2, order);
        EXPECT_GT(order, method.order - 0.15) << name;
    }
}

TEST(Energy, AdaptiveMethodHoldsItsTolerance) {
    EXPECT_LT(run_thrown("dopri5", 5e-3, 1).worst_energy_error, 1e-3);
}

TEST(Momentum, StaysWithoutExternalForces) {
    VehicleDescription car = test::paper_car();
    car.gravity = 0;
    car.aerodynamics = {};
    for (const ChassisChart chart : {ChassisChart::quaternion, ChassisChart::bryant}) {
        Model<double> model = test::make_model(car);
        model.chart = chart;
        Input<double> input;
        input.drive_torque = 300;  // internal: wheels against the car
        const auto driver = [&](double) { return input; };
        State<double> state = design_state(model, Vec3<double>(100, 50, 30), Mat3<double>::Identity());
        assemble(model, input.rack, state);
        Spatial<double> v;
        v << 3, -2, 1, 0.3, 0.2, 0.6;
        set_velocities(model, input, v, state);
        const auto invariants = [&] {
            Vector<double, 6> p_and_L;
            with_chart(model, [&](auto c) {
                const Spatial<double> momentum = c.momentum(Vector<double, 4>(state.orientation()), state.momentum());
                const Vec3<double> p = momentum.head<3>();
                p_and_L << p, Vec3<double>(momentum.tail<3>()) + Vec3<double>(state.position()).cross(p);
            });
            return p_and_L;
        };
        const Vector<double, 6> before = invariants();
        Integrator<State<double>> integrator(*find_method("ab3"), 1e-3, model.vehicle.state_size);
        for (int i = 0; i < 1000; ++i) integration_block(model, integrator, driver, i * 1e-3, state);
        const Vector<double, 6> change = invariants() - before;
        std::printf("momentum changes by %.1e, moment of momentum by %.1e of them\n",
                    change.head<3>().norm() / before.norm(), change.tail<3>().norm() / before.norm());
        // (p, L) are integrated themselves, so only round-off is left; Bryant's D^T L is bent, so its error is AB3's.
        const double round_off = 1e-14 * before.norm();
        EXPECT_LT(change.head<3>().norm(), round_off);
        EXPECT_LT(change.tail<3>().norm(), chart == ChassisChart::quaternion ? round_off : 1e-10 * before.norm());
    }
}

TEST(EnergyBalance, HoldsForADrivenBrakedSteeredCarAtTheMethodsOrder) {
    ScenarioDescription s = test::scenario(4, 12);
    s.drive = test::table({0, 0.5, 2, 2.2}, {0, 500, 500, 0});
    s.brake = test::table({2.5, 3, 4}, {0, 0.1, 0.1});
    s.steering_input = SteeringInput::rack;
    s.steering = test::table({0.5, 1.5, 2.5, 3.5}, {0, 0.002, -0.002, 0});
    const auto worst = [&](const char* method, double step) {
        s.solver.integrator = method;
        s.solver.step = step;
        Simulation simulation(test::paper_car(), s);
        double largest = 0;
        while (!simulation.finished()) {
            if (const auto end = simulation.advance()) ADD_FAILURE() << end->message;
            largest =
                std::max(largest, std::abs(simulation.sample().energy.balance() - simulation.initial_energy_balance()));
        }
        return largest;
    };
    const double coarse = worst("ab3", 1e-3), fine = worst("ab3", 5e-4), rk4 = worst("rk4", 1e-3);
    std::printf("energy balance error: %.2e J at 1 ms, %.2e J at 0.5 ms; rk4 %.2e J at 1 ms\n", coarse, fine, rk4);
    EXPECT_LT(coarse, 3e-4);      // of about 100 kJ
    EXPECT_GT(coarse / fine, 4);  // at least second order across the kinks of the inputs
    EXPECT_LT(rk4, 1e-4);
}

}  // namespace
}  // namespace hamilcar
