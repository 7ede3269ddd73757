// Rates and ride frequencies of the shipped car against the wheel rates published for its sister (VDANL in
// vehicles/bmw_323i.toml), which its springs were chosen for, and against what follows from them by hand.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "hamilcar/block/equilibrium.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

// Natural frequencies [Hz] of the oscillating modes at rest, ascending. Without slip and damping, so that the lateral
// force of a standing tire does not stiffen the suspension: the reference values are for vertical motion alone.
std::vector<double> natural_frequencies() {
    const Model<double> model = test::make_model(test::conservative_car());
    const Input<double> input;
    State<double> rest = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    assemble(model, input.rack, rest);
    EXPECT_TRUE(settle(model, input, rest).found);
    set_velocities(model, input, Spatial<double>::Zero(), rest);
    const int n = model.vehicle.state_size;
    Eigen::MatrixXd A(n, n);
    for (int j = 0; j < n; ++j) {
        const double step = 1e-5;
        State<double> above = rest, below = rest, rate_above, rate_below;
        above.values[static_cast<std::size_t>(j)] += step;
        below.values[static_cast<std::size_t>(j)] -= step;
        close_loops(model, input.rack, above, 3);
        close_loops(model, input.rack, below, 3);
        evaluate_rhs(model, input, above, rate_above);
        evaluate_rhs(model, input, below, rate_below);
        for (int i = 0; i < n; ++i) {
            const auto k = static_cast<std::size_t>(i);
            A(i, j) = (rate_above.values[k] - rate_below.values[k]) / (2 * step);
        }
    }
    std::vector<double> frequencies;
    for (const auto& eigenvalue : A.eigenvalues()) {
        if (eigenvalue.imag() > 1) frequencies.push_back(std::abs(eigenvalue) / (2 * std::numbers::pi));
    }
    std::sort(frequencies.begin(), frequencies.end());
    return frequencies;
}

// Wheel rate [N/m]: how the vertical force at the wheel center that balances the spring grows with the center's height,
// the chassis held. Weightless and without a tire, so that P_V' is the spring's alone.
double wheel_rate(std::size_t number) {
    VehicleDescription car = test::conservative_car();
    car.gravity = 0;
    car.anti_roll_bars.clear();
    for (auto& c : car.suspensions) c.wheels[0].tire = SpringTireDescription{0.3, 0.3, 0};
    const Model<double> model = test::make_model(car);
    const Input<double> input;
    State<double> state = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    assemble(model, input.rack, state);
    struct Point {
        double height, force;
    };
    const auto at = [&](double V) {
        State<double> moved = state;
        const Suspension<double>& suspension = model.vehicle.suspensions[number];
        *suspension.state(moved.values.data()).independent += V;
        close_loops(model, input.rack, moved, 5);
        const auto velocity = velocity_block(model, moved, input);
        const auto momenta = momenta_block(model, moved, input, velocity);
        const SuspensionVelocity<double>& v = velocity.suspensions[number];
        const auto frame = static_cast<std::size_t>(suspension.wheels[0].frame);
        const double lever = velocity_at<double>(Spatial<double>(v.at.motion.J[frame].col(0)), v.center[0])[2];
        return Point{v.center[0][2], -momenta.suspensions[number].momentum_rate[0] / lever};
    };
    const Point above = at(1e-4), below = at(-1e-4);
    return (above.force - below.force) / (above.height - below.height);
}

// VDANL: wheel rates 24453 and 19636 N/m; derived, with sprung corners of 276.9 and 224.1 kg on 180 kN/m tires: ride rates
// 21.5 and 17.7 kN/m and ride frequencies 1.40 and 1.41 Hz.
TEST(Ride, WheelRatesAreThePublishedOnesAndFrequenciesFollow) {
    struct Row {
        std::size_t suspension;
        double wheel_rate, ride_rate, sprung_mass, frequency;
    };
    for (const Row& row : {Row{0, 24453, 21.5e3, 276.9, 1.40}, Row{2, 19636, 17.7e3, 224.1, 1.41}}) {
        constexpr double tire = 180e3;
        const double wheel = wheel_rate(row.suspension), ride = wheel * tire / (wheel + tire);
        const double frequency = std::sqrt(ride / row.sprung_mass) / (2 * std::numbers::pi);
        std::printf("suspension %zu: wheel rate %.0f N/m, ride rate %.0f N/m, %.3f Hz\n", row.suspension, wheel, ride,
                    frequency);
        EXPECT_NEAR(wheel, row.wheel_rate, 0.005 * row.wheel_rate);  // the spring rate is printed to half a percent
        EXPECT_NEAR(ride, row.ride_rate, 100);                       // printed to 100 N/m
        EXPECT_NEAR(frequency, row.frequency, 0.01);                 // printed to 0.01 Hz
    }
}

// The whole car's modes lie near those of its corners; the weight above the axles softens pitch, camber
// change softens the rear, the arms' own mass and leverage shift the wheels' modes by up to a tenth.
TEST(Ride, ModesOfTheWholeCarLieNearThoseOfItsCorners) {
    const std::vector<double> frequencies = natural_frequencies();
    ASSERT_EQ(frequencies.size(), 7u) << "heave, pitch, roll and four wheels";
    EXPECT_NEAR(frequencies[0], 1.40, 0.05);
    EXPECT_NEAR(frequencies[1], 1.41, 0.05);
    for (std::size_t i = 3; i < 7; ++i) EXPECT_NEAR(frequencies[i], 12, 1.2);
}

}  // namespace
}  // namespace hamilcar
