// Brakes of whole cars: where the energy of a stop goes, what heat does to the torque, and that neither the account nor the stopping
// distance depends on the step while an anti-lock system opens and closes valves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/fleet.hpp"

namespace hamilcar {
namespace {

ScenarioDescription full_stop(double speed, double duration) {
    ScenarioDescription s = test::scenario(duration, speed);
    s.brake = test::table({0.1, 0.2}, {0, 1});
    return s;
}

const WheelForces<double>& wheel_of(const Sample& sample, int number) {
    const auto [s, w] = locate_wheel(sample.model.vehicle, number);
    return sample.momenta.suspensions[s].wheels[w];
}

// What went through a brake, by the trapezoidal rule over the wheel's torque and spin.
struct Account {
    double power = 0, cooling = 0;  // at the last sample [W]
    double friction = 0, lost = 0;  // up to there [J]

    void add(double power_now, double cooling_now, double step) {
        friction += 0.5 * step * (power + power_now), lost += 0.5 * step * (cooling + cooling_now);
        power = power_now, cooling = cooling_now;
    }
};

double temperature(const Sample& sample, std::size_t line) {
    return sample.model.vehicle.brakes.temperature(line, sample.state.values.data());
}

// From 130 km/h to standstill; the discs' heat against the work of the brakes, and against the car's kinetic energy.
TEST(BrakeHeat, IsTheWorkOfFrictionLessWhatIsCooled) {
    VehicleDescription car = test::shipped("bmw_e90_330i");
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionWheelDescription& wheel :
             suspension.wheels) {  // as fans would, so that it counts in the account
            wheel.brake.heat.cooling *= 100, wheel.brake.heat.cooling_per_speed *= 30;
        }
    }
    Simulation run(car, full_stop(130 / 3.6, 6));
    const std::vector<SuspensionWheelDescription> wheels = [&] {
        std::vector<SuspensionWheelDescription> out;
        for_each_wheel(car, [&](const SuspensionWheelDescription& wheel, std::size_t) { out.push_back(wheel); });
        return out;
    }();
    const double step = run.scenario().solver.step, kinetic = run.sample().energy.kinetic;
    std::vector<Account> accounts(wheels.size());
    const auto read = [&](double interval) {
        const Sample sample = run.sample();
        for (std::size_t i = 0; i < wheels.size(); ++i) {
            const WheelForces<double>& at = wheel_of(sample, static_cast<int>(i));
            const BrakeHeatDescription& heat = wheels[i].brake.heat;
            const double speed = std::abs(at.spin) * casing_of(wheels[i].tire).rolling_radius;
            const double warmer = temperature(sample, i) - 20;
            accounts[i].add(-at.brake_torque * at.spin, (heat.cooling + heat.cooling_per_speed * speed) * warmer,
                            interval);
        }
    };
    read(0);
    while (!run.finished()) {
        ASSERT_FALSE(run.advance());
        read(step);
    }
    double discs = 0, air = 0;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        const double stored = wheels[i].brake.heat.capacity * (temperature(run.sample(), i) - 20);
        EXPECT_NEAR(stored + accounts[i].lost, accounts[i].friction, 1e-4 * accounts[i].friction) << wheels[i].name;
        discs += stored, air += accounts[i].lost;
    }
    EXPECT_GT(air, 0.05 * discs) << "cooling counts";
    EXPECT_LT(run.sample().energy.kinetic, 1e-4 * kinetic) << "it stands";
    // The rest went into tires, air and dampers.
    EXPECT_GT(discs + air, 0.85 * kinetic);
    EXPECT_LT(discs + air, kinetic);
}

// Of a hand's calculation, between its points.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
    if (at <= x.front()) return y.front();
    for (std::size_t i = 1; i < x.size(); ++i) {
        if (at < x[i]) return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
    }
    return y.back();
}

// Held at half a pedal in a long stop from a speed that makes discs red-hot: torque over pressure follows the file's curve.
TEST(BrakeHeat, FadesAsTheFilesCurveSays) {
    for (const double self_energizing : {0.0, 0.6}) {
        VehicleDescription car = test::shipped("bmw_e90_330i");
        for (SuspensionDescription& suspension : car.suspensions) {
            for (SuspensionWheelDescription& wheel : suspension.wheels) {
                wheel.brake.heat.capacity /= 4;
                wheel.brake.self_energizing = self_energizing;
                wheel.brake.friction_loss_per_speed = 0.004, wheel.brake.friction_radius = 0.14;
            }
        }
        ScenarioDescription s = test::scenario(4, 60);
        s.brake = test::table({0, 0.1}, {0, 0.4});
        Simulation run(car, s);
        const BrakeDescription& front = car.suspensions[0].wheels[0].brake;
        double hottest = 0, fully_faded = 1;
        for (int i = 1; !run.finished(); ++i) {
            ASSERT_FALSE(run.advance());
            if (i % 500 != 0) continue;
            const Sample sample = run.sample();
            const BrakeSystem<double>& brakes = sample.model.vehicle.brakes;
            const double pressure = brakes.pressure(0, sample.state.values.data()), hot = temperature(sample, 0);
            const WheelForces<double>& wheel = wheel_of(sample, 0);
            const double fast = 1 - 0.004 * 0.14 * std::abs(wheel.spin);
            const double friction = interpolated(front.temperature, front.friction, hot) * fast;
            const double gain = friction * (1 - self_energizing) / (1 - self_energizing * friction);
            const double expected = front.max_torque * pressure / car.brakes.full_pressure * gain;
            // Sliding friction, in front: the damper of the wind-up counts in it.
            EXPECT_NEAR(-wheel.brake_torque, expected, 2e-3 * expected) << "at " << hot << " degrees";
            hottest = std::max(hottest, hot);
            fully_faded = std::min(fully_faded, gain);
        }
        EXPECT_GT(hottest, 500);
        EXPECT_LT(fully_faded, self_energizing > 0 ? 0.6 : 0.75) << "a drum loses more";
    }
}

// All that is exchanged in a stop on which valves open and close, to a hundred-thousandth.
TEST(BrakeEnergy, BalancesWhileTheAntiLockSystemWorks) {
    for (const char* name : {"bmw_e90_330i", "truck_semitrailer"}) {
        ScenarioDescription s = full_stop(20, 4);
        s.road.friction = 0.4;
        Simulation run(test::shipped(name), s);
        const double before = run.sample().energy.kinetic;
        double active = 0;
        while (!run.finished()) {
            ASSERT_FALSE(run.advance());
            active = std::max(active, run.control()->activity(0, run.control_memory()));
        }
        const Sample end = run.sample();
        EXPECT_GT(active, 0.9) << name;
        EXPECT_NEAR(end.energy.balance(), run.initial_energy_balance(), 1e-5 * (before - end.energy.kinetic)) << name;
    }
}

// Decisions every 5 ms whatever the step.
class BrakeConvergence : public testing::Test {
protected:
    using Commands = std::vector<std::vector<double>>;  // every 5 ms

    // With the car's own controllers, or with commands from outside.
    static Simulation stop(double step, double speed, bool external) {
        VehicleDescription car = test::shipped("bmw_e90_330i");
        if (external) car.controllers = {{.kind = "external", .rate = 200, .settings = {}}};
        ScenarioDescription s = full_stop(speed, 6);
        s.solver.step = step;
        s.road.friction = 0.4;
        return Simulation(car, s);
    }
    // The way until it stands, or for a time [m].
    static double distance(Simulation run, double duration, const Commands& told, Commands* made = nullptr) {
        const long decision = std::lround(5e-3 / run.scenario().solver.step);
        while (!run.finished() && run.time() < duration - 1e-9) {
            const bool decides = run.steps_taken() % decision == 0;
            const auto number = static_cast<std::size_t>(run.steps_taken() / decision);
            if (decides && !told.empty()) run.set_commands(told.at(number));
            EXPECT_FALSE(run.advance());
            if (decides && made) made->emplace_back(run.schedule().commands().begin(), run.schedule().commands().end());
            if (run.state().momentum()[0] < 1) break;
        }
        return run.state().position()[0];
    }
};

// Of the first order, for commands that switch between the instants at which a method of several steps looks.
TEST_F(BrakeConvergence, OfTheWayUnderCommandsThatAreHeld) {
    Commands commands;
    distance(stop(1e-3, 20, false), 2, {}, &commands);
    std::vector<double> ways, differences;
    for (const double step : {1e-3, 5e-4, 2.5e-4, 1.25e-4}) {
        ways.push_back(distance(stop(step, 20, true), 2, commands));
        if (ways.size() > 1) differences.push_back(std::abs(ways.back() - ways[ways.size() - 2]));
    }
    EXPECT_LT(differences[0], 1e-4 * ways[0]);
    EXPECT_GT(differences[0], 1.8 * differences[1]);
    EXPECT_GT(differences[1], 1.8 * differences[2]);
}

// With decisions by thresholds, the least difference decides whether a wheel is let go once more: the way to standstill jumps by some
// meter between neighboring speeds as well as between steps, about the same middle.
TEST_F(BrakeConvergence, OfTheStoppingDistanceAsFarAsDecisionsAllow) {
    std::vector<double> middles;
    for (const double step : {1e-3, 2.5e-4}) {
        std::vector<double> ways;
        for (const double speed : {20.0, 20.001, 20.002, 20.003})
            ways.push_back(distance(stop(step, speed, false), 6, {}));
        const auto [least, most] = std::ranges::minmax(ways);
        EXPECT_LT(most - least, 0.04 * least) << "step " << step;
        middles.push_back((least + most) / 2);
    }
    EXPECT_NEAR(middles[0], middles[1], 0.04 * middles[0]);
}

}  // namespace
}  // namespace hamilcar
