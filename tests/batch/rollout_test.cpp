// Rollouts: the bits of a batch, and derivatives by routes of their own: dual numbers for the right-hand side, differences for whole runs,
// and both directions against each other.
#include "hamilcar/batch/rollout.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <memory>

#include "batch/rollout_car.hpp"
#include "hamilcar/batch/batch.hpp"
#include "hamilcar/block/rhs.hpp"
#include "hamilcar/engine/lane_numbers.hpp"
#include "hamilcar/math/dual.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using namespace test;

// Vehicles, and a smaller one with each kind of tire.
std::vector<std::string> kinds() {
    std::vector<std::string> out = test::fleet();
    for (const char* tire : {"magic", "tmeasy", "fiala", "brush", "dugoff"}) out.push_back(std::string("tire_") + tire);
    return out;
}
VehicleDescription vehicle_of(const std::string& kind) {
    const bool is_tire = kind.starts_with("tire_");
    VehicleDescription car = test::shipped(is_tire ? "bmw_323i" : kind);
    car.controllers.clear();  // whose decisions have no derivatives
    if (!is_tire) return car;
    const std::string tire = kind.substr(5);
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionWheelDescription& wheel : suspension.wheels) {
            if (tire == "magic") wheel.tire = test::magic_tire();
            if (tire == "tmeasy") wheel.tire = test::tmeasy_tire();
            if (tire == "fiala") wheel.tire = test::fiala_tire();
            if (tire == "brush") wheel.tire = test::brush_tire();
            if (tire == "dugoff") wheel.tire = test::dugoff_tire();
        }
    }
    return car;
}

class RolloutOf : public testing::TestWithParam<std::string> {
protected:
    VehicleDescription vehicle_ = vehicle_of(GetParam());
    Car car_{vehicle_};
    // A car with a heavier body: its mass, its inertia and its springs are parameters then.
    Car heavier_ = [this] {
        VehicleDescription other = vehicle_;
        other.chassis.mass *= 1.02;
        return Car(other);
    }();
    RolloutOptions options_{.steps = 8, .threads = 1, .variants = {&heavier_.simulation}};
    Rollout rollout_{car_.car(), readers(vehicle_), options_};
};
INSTANTIATE_TEST_SUITE_P(Fleet, RolloutOf, testing::ValuesIn(kinds()), [](const auto& test) { return test.param; });

TEST_P(RolloutOf, HasTheBitsOfABatch) {
    constexpr std::size_t rows = 5;
    const RolloutNumbers runs = runs_of(rollout_, car_, 1, rows);
    const RolloutResults found = rollout_.run(std::array{car_.car()}, runs, rows);
    Batch batch({&car_.simulation}, {.threads = 1});
    const std::size_t m = car_.controls.list().size();
    for (std::size_t row = 0; row <= rows; ++row) {
        batch.change_inputs(0, [&](Schedule& schedule, Driver* driver) {
            for (std::size_t i = 0; i < m; ++i) {
                const double target = runs.controls[row * m + i];
                if (row == 0) {
                    car_.controls.hold(i, target, 0, schedule, driver);
                } else {
                    car_.controls.move(i, target, {batch.time(0), options_.steps, 1e-3}, schedule, driver);
                }
            }
        });
        if (row == 0) continue;
        batch.advance(options_.steps);
        batch.change_inputs(0, [&](Schedule& schedule, Driver* driver) {
            for (std::size_t i = 0; i < m; ++i) {
                car_.controls.hold(i, runs.controls[row * m + i], batch.time(0), schedule, driver);
            }
        });
    }
    for (std::size_t k = 0; k < rollout_.state_size(); ++k) {
        EXPECT_EQ(std::bit_cast<std::uint64_t>(found.states[k]), std::bit_cast<std::uint64_t>(batch.state(0).values[k]))
            << k;
    }
}

struct AsDual {
    Dual<double, 1> number(double value) { return Dual<double, 1>(value); }
    int whole(int value) { return value; }
};

// Column by column, by a number of two: value and derivative.
TEST_P(RolloutOf, TangentsOfTheRightHandSideAreThoseOfDualNumbers) {
    using D = Dual<double, 1>;
    Simulation moved(vehicle_, test::everything_moves(vehicle_));
    for (int i = 0; i < 800; ++i) ASSERT_FALSE(moved.advance());
    Input<double> input = moved.schedule()(moved.time());
    input.rack.rate += 0.01, input.brake = 0.1;
    const Model<double>* plain = &car_.simulation.model();
    RolloutPrograms programs(std::span(&plain, 1), {}, engine("portable"));
    const auto lanes = static_cast<std::size_t>(programs.lanes());
    const std::size_t size = rollout_.state_size(), columns = size + RhsInput::drive_torque + 2;
    Model<D> model;
    transcribe_model(model, *plain, AsDual{});
    model.chart = plain->chart, model.constraints = plain->constraints;
    model.energy_balance = false;
    for (std::size_t column = 0; column < columns; ++column) {
        State<D> state, rate;
        for (std::size_t i = 0; i < size; ++i) {
            state.values[i] = i == column ? D::variable(moved.state().values[i], 0) : D(moved.state().values[i]);
        }
        const auto seeded = [&](double value, std::size_t index) {
            return column == size + index ? D::variable(value, 0) : D(value);
        };
        Input<D> inputs;
        inputs.rack = {seeded(input.rack.displacement, 0), seeded(input.rack.rate, 1),
                       seeded(input.rack.acceleration, 2)};
        inputs.drive_torque = seeded(input.drive_torque, 3), inputs.brake = seeded(input.brake, 4);
        const auto evaluation = std::make_unique<Evaluation<D>>();
        evaluate_rhs(model, inputs, state, rate, *evaluation);

        LaneNumbers<double> states(2 * size * lanes), given(std::size_t{2} * RhsInput::size * lanes),
            rates(2 * size * lanes), report(2 * programs.report_size() * lanes);
        const std::array<double, 5> values{input.rack.displacement, input.rack.rate, input.rack.acceleration,
                                           input.drive_torque, input.brake};
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            for (std::size_t i = 0; i < size; ++i) {
                states.values[i * lanes + lane] = moved.state().values[i];
                states.values[(size + i) * lanes + lane] = i == column;
            }
            for (std::size_t i = 0; i < values.size(); ++i) {
                given.values[i * lanes + lane] = values[i];
                given.values[(RhsInput::size + i) * lanes + lane] = column == size + i;
            }
        }
        program::Frame frame{.functions = rhs_functions(Precision::double_precision)};
        frame.arrays[rhs_state] = states.data(), frame.arrays[rhs_input] = given.data();
        frame.arrays[rhs_rate] = rates.data(), frame.arrays[rhs_report] = report.data();
        programs.with_tangents().rhs->run(frame);
        double largest = 0;
        for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(rate.values[i].partial(0)));
        for (std::size_t i = 0; i < size; ++i) {
            EXPECT_NEAR(rates.values[(size + i) * lanes], rate.values[i].partial(0), 1e-11 * (1 + largest))
                << "rate " << i << " by " << column;
        }
    }
}

// Along a direction of all controls.
TEST_P(RolloutOf, TangentsAreThoseOfDifferences) {
    constexpr std::size_t rows = 6;
    RolloutNumbers runs = runs_of(rollout_, car_, 1, rows);
    RolloutNumbers along{.controls = runs.controls,
                         .states = std::vector<double>(rollout_.state_size()),
                         .parameters = std::vector<double>(rollout_.parameter_count())};
    for (std::size_t i = 0; i < along.controls.size(); ++i) along.controls[i] *= 0.5 + 0.1 * static_cast<double>(i % 7);
    RolloutResults changes;
    const RolloutResults here = rollout_.tangents(std::array{car_.car()}, runs, along, rows, changes);
    const RolloutResults again = rollout_.run(std::array{car_.car()}, runs, rows);
    EXPECT_THAT(here.channels, testing::ElementsAreArray(again.channels));
    const auto shifted = [&](double by) {
        RolloutNumbers other = runs;
        for (std::size_t i = 0; i < other.controls.size(); ++i) other.controls[i] += by * along.controls[i];
        return rollout_.run(std::array{car_.car()}, other, rows).channels;
    };
    constexpr double h = 1e-4;
    const auto after = shifted(h), before = shifted(-h);
    for (std::size_t i = 0; i < after.size(); ++i) {
        const double expected = (after[i] - before[i]) / (2 * h);
        EXPECT_NEAR(changes.channels[i], expected, 1e-6 * (0.01 + std::abs(expected))) << i;
    }
}

TEST_P(RolloutOf, GradientsAreThoseOfTangents) {
    constexpr std::size_t rows = 4, count = 9;  // more than one group of lanes
    const RolloutNumbers runs = runs_of(rollout_, car_, count, rows);
    std::vector<RolloutCar> cars(count, car_.car());
    cars[4] = heavier_.car();
    const auto numbers = [](std::size_t size, double phase) {
        std::vector<double> out(size);
        for (std::size_t i = 0; i < size; ++i) out[i] = std::sin(phase + 1.7 * static_cast<double>(i));
        return out;
    };
    const RolloutResults weights{numbers(count * rows * rollout_.channel_count(), 0.3),
                                 numbers(count * rollout_.state_size(), 0.8)};
    RolloutNumbers along{.controls = numbers(runs.controls.size(), 1),
                         .states = numbers(runs.states.size(), 2),
                         .parameters = numbers(count * rollout_.parameter_count(), 3)};
    for (double& one : along.states) one *= 1e-3;
    RolloutResults changes;
    rollout_.tangents(cars, runs, along, rows, changes);
    const RolloutNumbers gradient = rollout_.gradient(cars, runs, weights, rows);
    for (std::size_t run = 0; run < count; ++run) {
        double size = 0;
        const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
            double sum = 0;
            const std::size_t each = a.size() / count;
            for (std::size_t i = run * each; i < (run + 1) * each; ++i)
                sum += a[i] * b[i], size += std::abs(a[i] * b[i]);
            return sum;
        };
        const double forward = product(weights.channels, changes.channels) + product(weights.states, changes.states);
        const double backward = product(gradient.controls, along.controls) + product(gradient.states, along.states) +
                                product(gradient.parameters, along.parameters);
        EXPECT_NEAR(forward, backward, 1e-11 * size) << "run " << run;
        EXPECT_GT(std::abs(forward), 1e-9 * size);
    }
}

}  // namespace
}  // namespace hamilcar
