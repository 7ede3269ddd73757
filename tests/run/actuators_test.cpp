// Adjustable dampers and active anti-roll bars on whole cars: how they follow what they are told, what their forces are by hand, that they
// change nothing at rest, and that the work of the bars is paid for.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "hamilcar/block/measurement.hpp"
#include "support/active_chassis.hpp"

namespace hamilcar {
namespace {

void tell(Simulation& run, const std::string& name, double value) {
    const int place = run.control()->layout().find(name);
    ASSERT_GE(place, 0) << name;
    std::vector<double> commands(run.schedule().commands().begin(), run.schedule().commands().end());
    commands[static_cast<std::size_t>(place)] = value;
    run.set_commands(commands);
}

// Where an actuator's number is in a state.
std::size_t place_of(const Simulation& run, const std::string& command) {
    const CommandLayout& layout = run.control()->layout();
    return static_cast<std::size_t>(run.model().vehicle.actuator_place + layout.actuator(layout.find(command)));
}

ScenarioDescription precise(ScenarioDescription s, double step = 1e-3) {
    s.solver.integrator = "rk4", s.solver.step = step;
    return s;
}

TEST(Actuators, FollowTheirCommandsWithALagOfFirstOrder) {
    struct Case {
        const char* command;
        double rest, target, response_time;
    };
    const VehicleDescription car =
        test::told(test::with_active_bars(test::with_adjustable_dampers(test::shipped("bmw_323i"), {0.4, 2, 0.012})));
    for (const auto& [method, tolerance] : {std::pair("rk4", 1e-6), {"ab3", 2e-3}}) {
        for (const Case& one : {Case{"front_left.damper.setting", 0.375, 1, 0.012},
                                {"rear_right.damper.setting", 0.375, 0, 0.012},
                                {"front_left.anti_roll_bar.force", 0, 0.8, 0.03},
                                {"rear_left.anti_roll_bar.force", 0, -1, 0.03}}) {
            ScenarioDescription s = test::scenario(0.3, 10);
            s.solver.integrator = method;
            Simulation run(car, s);
            const std::size_t place = place_of(run, one.command);
            const std::vector<double> before(run.state().values.begin(), run.state().values.end());
            EXPECT_NEAR(before[place], one.rest, 1e-15) << one.command;
            tell(run, one.command, one.target);
            for (int i = 1; i <= 100; ++i) {
                ASSERT_FALSE(run.advance());
                const double gone = 1 - std::exp(-1e-3 * i / one.response_time);
                EXPECT_NEAR(run.state().values[place], one.rest + (one.target - one.rest) * gone, tolerance)
                    << one.command << " by " << method << " after " << i << " ms";
            }
            for (int k = 0; k < static_cast<int>(run.model().vehicle.actuators.size()); ++k) {
                const auto other = static_cast<std::size_t>(run.model().vehicle.actuator_place + k);
                if (other == place) continue;
                EXPECT_EQ(run.state().values[other], before[other]) << "it was told nothing";
            }
        }
    }
}

TEST(Actuators, AreNamedAfterTheirWheelsInTheVehiclesOrder) {
    const VehicleDescription car = test::told(test::with_both(test::shipped("offroader")));
    const CommandLayout layout(car);
    const int first = layout.find("front_left.damper.setting");
    EXPECT_EQ(first, layout.damper(0));
    EXPECT_EQ(layout.find("rear_right.damper.setting"), layout.damper(3));
    EXPECT_EQ(layout.find("front_left.anti_roll_bar.force"), layout.bar(0));
    EXPECT_EQ(layout.find("rear_left.anti_roll_bar.force"), layout.bar(1));
    EXPECT_EQ(layout.actuators().size(), 6u);
    for (std::size_t i = 0; i < layout.actuators().size(); ++i) {
        EXPECT_EQ(layout.actuator(layout.actuators()[i].command), static_cast<int>(i));
    }
    EXPECT_EQ(layout.actuator(-1), -1);
    VehicleDescription alone = car;
    alone.controllers.clear();
    EXPECT_EQ(CommandLayout(alone).size(), 0) << "nothing commands them";
}

// Both forces, of all dampers and bars of a car.
std::vector<double> forces_of(const Simulation& run) {
    std::vector<double> out;
    const Sample at = run.sample();
    for (std::size_t s = 0; s < at.model.vehicle.suspensions.size(); ++s) {
        const SuspensionMomenta<double>& one = at.momenta.suspensions[s];
        for (std::size_t i = 0; i < at.model.vehicle.suspensions[s].dampers.size(); ++i) {
            out.push_back(one.dampers[i].force);
        }
        for (std::size_t i = 0; i < at.model.vehicle.suspensions[s].wheels.size(); ++i) {
            out.push_back(one.wheels[i].bar);
        }
    }
    return out;
}

class ActuatedCar : public testing::TestWithParam<const char*> {
protected:
    VehicleDescription plain_ = test::shipped(GetParam());
    VehicleDescription car_ = test::told(test::with_both(plain_));
    // In the middle of a lane change.
    static Simulation moving(const VehicleDescription& car) {
        Simulation run(car, precise(test::everything_moves(car)));
        for (int i = 0; i < 700; ++i) EXPECT_FALSE(run.advance());
        return run;
    }
};
INSTANTIATE_TEST_SUITE_P(Cars, ActuatedCar,
                         testing::Values("bmw_323i", "bmw_e90_330i", "hatchback", "offroader", "truck_semitrailer"),
                         [](const auto& test) { return test.param; });

TEST_P(ActuatedCar, AtRestIsTheCarWithoutActuators) {
    const Simulation actuated = moving(car_);
    for (const VehicleDescription& other : {test::told(plain_), test::controlled_by(test::with_both(plain_), {})}) {
        const Simulation without = moving(other);
        EXPECT_EQ(without.model().vehicle.actuators.size(), 0u);
        const auto numbers = static_cast<std::size_t>(without.model().vehicle.state_size);
        // Brakes and throttles without commands and with them differ in round-off, too.
        for (std::size_t k = 0; k < numbers; ++k) {
            const double value = without.state().values[k];
            EXPECT_NEAR(actuated.state().values[k], value, 1e-9 * (1 + std::abs(value))) << k;
        }
        const std::vector<double> forces = forces_of(without), of_actuated = forces_of(actuated);
        ASSERT_EQ(forces.size(), of_actuated.size());
        double most = 0;
        for (std::size_t i = 0; i < forces.size(); ++i) {
            EXPECT_NEAR(of_actuated[i], forces[i], 1e-7 + 1e-9 * std::abs(forces[i])) << i;
            most = std::max(most, std::abs(forces[i]));
        }
        EXPECT_GT(most, 30) << "the car moves";
    }
}

// Piecewise linear through the points and beyond them [N].
double curve(const DamperDescription& damper, double velocity) {
    std::size_t i = 1;
    while (i + 1 < damper.velocity.size() && velocity > damper.velocity[i]) ++i;
    const double share = (velocity - damper.velocity[i - 1]) / (damper.velocity[i] - damper.velocity[i - 1]);
    return damper.force[i - 1] + share * (damper.force[i] - damper.force[i - 1]);
}

TEST_P(ActuatedCar, HasTheDampersCurveBetweenSoftAndFirm) {
    const Simulation run = moving(car_);
    const CommandLayout& layout = run.control()->layout();
    double fastest = 0;
    for (const double setting : {0.0, 0.3, 1.0}) {
        State<double> state = run.state();
        double own = setting;
        for (std::size_t k = 0; k < run.model().vehicle.actuators.size(); ++k, own = 0.7 * own + 0.1) {
            state.values[static_cast<std::size_t>(run.model().vehicle.actuator_place) + k] = own;
        }
        const Sample at = sample_at(run.model(), state, run.schedule()(run.time()));
        for (std::size_t s = 0; s < car_.suspensions.size(); ++s) {
            for (std::size_t i = 0; i < car_.suspensions[s].dampers.size(); ++i) {
                const DamperDescription& damper = car_.suspensions[s].dampers[i].damper;
                const int actuator = layout.actuator(layout.damper(s, i));
                ASSERT_GE(actuator, 0);
                const double set =
                    state.values[static_cast<std::size_t>(run.model().vehicle.actuator_place + actuator)];
                const auto& [force, length, rate] = at.momenta.suspensions[s].dampers[i];
                const double expected = -curve(damper, rate) * (0.4 + (2 - 0.4) * set);
                EXPECT_NEAR(force, expected, 1e-9 * (1 + std::abs(expected))) << s << ", damper " << i;
                fastest = std::max(fastest, std::abs(rate));
            }
        }
    }
    EXPECT_GT(fastest, 0.01);
}

TEST_P(ActuatedCar, HasBarsThatPushOneWheelDownAndTheOtherUp) {
    const Simulation run = moving(car_);
    const CommandLayout& layout = run.control()->layout();
    ASSERT_FALSE(car_.anti_roll_bars.empty());
    for (std::size_t b = 0; b < car_.anti_roll_bars.size(); ++b) {
        const AntiRollBarDescription& bar = car_.anti_roll_bars[b];
        for (const double share : {-1.0, 0.0, 0.4}) {
            State<double> state = run.state();
            const int actuator = layout.actuator(layout.bar(b));
            ASSERT_GE(actuator, 0);
            state.values[static_cast<std::size_t>(run.model().vehicle.actuator_place + actuator)] = share;
            const Sample at = sample_at(run.model(), state, run.schedule()(run.time()));
            const auto wheel = [&](std::size_t number) -> const WheelForces<double>& {
                const auto [s, w] = locate_wheel(run.model().vehicle, static_cast<int>(number));
                return at.momenta.suspensions[s].wheels[w];
            };
            const double twist = wheel(bar.left).travel - wheel(bar.right).travel;
            const double expected = bar.rate * twist + 4000 * share;
            EXPECT_NEAR(wheel(bar.left).bar, -expected, 1e-9 * (1 + std::abs(expected)));
            EXPECT_NEAR(wheel(bar.right).bar, expected, 1e-9 * (1 + std::abs(expected)));
        }
    }
}

// The bars pump from outside, each at a frequency of its own; look(run) after each step.
void pump(Simulation& run, const std::function<void(const Simulation&)>& look) {
    const CommandLayout& layout = run.control()->layout();
    std::vector<double> commands = layout.rest();
    while (!run.finished()) {
        for (std::size_t b = 0; b < run.vehicle().anti_roll_bars.size(); ++b) {
            const double turn = 2 * std::numbers::pi * (1.2 + 0.4 * static_cast<double>(b)) * run.time();
            commands[static_cast<std::size_t>(layout.bar(b))] = 0.7 * std::sin(turn);
        }
        run.set_commands(commands);
        ASSERT_FALSE(run.advance());
        look(run);
    }
}

// That the bars give the car at an instant, from forces and speeds of wheels [W].
double power_of_bars(const Simulation& run, double max_force) {
    State<double> rate;
    const auto measured = evaluate_rhs(run.model(), run.schedule()(run.time()), run.state(), rate).measured;
    const MeasurementPlaces places(run.model().vehicle);
    double power = 0;
    for (std::size_t b = 0; b < run.vehicle().anti_roll_bars.size(); ++b) {
        const AntiRollBarDescription& bar = run.vehicle().anti_roll_bars[b];
        const CommandLayout& layout = run.control()->layout();
        const double share =
            run.state()
                .values[static_cast<std::size_t>(run.model().vehicle.actuator_place + layout.actuator(layout.bar(b)))];
        const auto speed = [&](std::size_t wheel) {
            return measured[static_cast<std::size_t>(places.travel_speed) + wheel];
        };
        power += max_force * share * (speed(bar.right) - speed(bar.left));
    }
    return power;
}

// Without anything that dissipates, the account of work has that of the bars alone.
TEST_P(ActuatedCar, PaysForTheWorkOfItsBars) {
    VehicleDescription car = test::told(test::with_active_bars(test::made_conservative(plain_), 1500));
    Simulation run(car, precise(test::scenario(1, 10), 2e-4));
    double work = 0, exchanged = 0, before = power_of_bars(run, 1500);
    pump(run, [&](const Simulation& at) {
        const double power = power_of_bars(at, 1500);
        work += 2e-4 * (before + power) / 2, exchanged += 2e-4 * std::abs(power);
        before = power;
    });
    const double missing = std::abs(run.sample().energy.balance() - run.initial_energy_balance());
    std::printf("%s: %.3f J given, %.1f J exchanged, by hand %.1e J less, %.1e J missing\n", GetParam(),
                run.state().work(), exchanged, work - run.state().work(), missing);
    EXPECT_GT(exchanged, 10);
    EXPECT_NEAR(run.state().work(), work, 1e-4 * exchanged);
    EXPECT_LT(missing, 1e-5 * exchanged);
}

TEST_P(ActuatedCar, KeepsItsEnergyAccountWhileBarsPump) {
    Simulation run(car_, precise(test::everything_moves(car_, 2), 5e-4));
    double exchanged = 0;
    pump(run, [&](const Simulation& at) { exchanged += 5e-4 * std::abs(power_of_bars(at, 4000)); });
    const double missing = std::abs(run.sample().energy.balance() - run.initial_energy_balance());
    std::printf("%s: %.1f J exchanged by bars, %.1e J missing\n", GetParam(), exchanged, missing);
    EXPECT_GT(exchanged, 50);
    EXPECT_LT(missing, 1e-5 * exchanged);
}

}  // namespace
}  // namespace hamilcar
