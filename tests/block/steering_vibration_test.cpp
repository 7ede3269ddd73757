// Steering wheel and rack against each other on the torsion bar, by the closed forms of two masses on a spring.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <complex>
#include <numbers>

#include "hamilcar/analysis/rack_force.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// A car that stands on springs in the place of tires, so that nothing but the rack's own motion holds the wheels.
class OnAStand : public testing::Test {
protected:
    void stand(const SteeringMechanicsDescription& mechanics) {
        const VehicleDescription car = test::made_conservative(test::shipped("bmw_323i"));
        ratio_ = turn / car.steering.rack_per_revolution;
        start_.emplace(test::with_mechanics(car, mechanics), test::set_free(test::scenario(1)));
        const Simulation prescribed(car, test::scenario(1));
        // All that the rack moves, per its own rate: of the linkages alone.
        const Velocity<double> at =
            velocity_block(prescribed.model(), prescribed.state(), Input<double>{.rack = {0, 1, 0}});
        mass_ = mechanics.rack_mass;
        for (std::size_t s = 0; s < at.suspensions.size(); ++s) {
            const Suspension<double>& suspension = prescribed.model().vehicle.suspensions[s];
            for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
                const Spatial<double>& x =
                    at.suspensions[s].at.motion.x[static_cast<std::size_t>(suspension.bodies[i].frame)];
                mass_ += x.dot(at.suspensions[s].inertia[i] * x);
            }
        }
        // The weight's own tendency to the middle or away from it.
        const auto force = [&](double displacement) {
            const Input<double> input{.rack = {displacement, 0, 0}};
            State<double> state = prescribed.state();
            EXPECT_TRUE(settle(prescribed.model(), input, state).found);
            const Velocity<double> velocity = velocity_block(prescribed.model(), state, input);
            return rack_force(prescribed.model(), state, input, velocity,
                              momenta_block(prescribed.model(), state, input, velocity));
        };
        weight_stiffness_ = (force(0.004) - force(-0.004)) / 0.008;
    }
    const Model<double>& model() const { return start_->model(); }

    // Of the torsion bar's twist after the wheel is turned, from its passages through zero [rad/s].
    double frequency(double duration) const {
        State<double> state = start_->state();
        model().vehicle.steering.state(state.values.data()).wheel = 0.1;
        double last = 0.1, last_time = 0;
        std::vector<double> passages;
        test::drive(model(), state, "rk4", 5e-4, duration, test::hands_off, [&](double time, const State<double>& at) {
            const auto steering = test::steering_state(model(), at);
            const double twist = steering.wheel - ratio_ * steering.rack;
            if (last * twist < 0) passages.push_back(last_time + (time - last_time) * last / (last - twist));
            last = twist, last_time = time;
        });
        EXPECT_GT(passages.size(), 8u);
        return std::numbers::pi * static_cast<double>(passages.size() - 1) / (passages.back() - passages.front());
    }

    std::optional<Simulation> start_;
    double ratio_ = 0, mass_ = 0, weight_stiffness_ = 0;
};

TEST_F(OnAStand, TheWheelSwingsOnTheTorsionBarWhereTheRackIsHeavy) {
    SteeringMechanicsDescription d = test::bare_mechanics();
    d.rack_mass = 1e7;
    stand(d);
    const double expected = std::sqrt(115 / 0.04);
    EXPECT_NEAR(frequency(1), expected, 1e-3 * expected);
}

TEST_F(OnAStand, WheelAndRackSwingAgainstEachOtherAsTwoMasses) {
    for (const double rack_mass : {3.0, 500.0}) {
        SteeringMechanicsDescription d = test::bare_mechanics();
        d.rack_mass = rack_mass;
        stand(d);
        const double expected = std::sqrt(115 * (1 / 0.04 + ratio_ * ratio_ / mass_)), found = frequency(0.5);
        std::printf("rack %.0f kg, in all %.1f kg, weight %.0f N/m: %.3f Hz, two masses %.3f Hz\n", rack_mass, mass_,
                    weight_stiffness_, found / turn, expected / turn);
        EXPECT_NEAR(found, expected, 0.01 * expected);
    }
}

// To a torque of the hands: (I s^2 + d s) a + (k + c s) (a - S r) = torque, (M s^2 + D s + K) r = S (k + c s) (a - S r).
TEST_F(OnAStand, AnswersToTheHandsAsALinearSystemOfTwoFreedoms) {
    SteeringMechanicsDescription d = test::bare_mechanics();
    d.rack_mass = 500;  // so that what chassis and suspensions give way counts less
    d.rack_damping = 2000, d.wheel_damping = 0.5, d.bar_damping = 0.4;
    stand(d);
    for (const double hertz : {3.0, 8.0, 16.0, 25.0}) {
        const double w = turn * hertz;
        const std::complex<double> s(0, w), bar = 115.0 + 0.4 * s;
        const std::complex<double> wheel = 0.04 * s * s + 0.5 * s,
                                   rack = mass_ * s * s + 2000.0 * s + weight_stiffness_;
        const std::complex<double> r_per_a = ratio_ * bar / (rack + ratio_ * ratio_ * bar);
        const std::complex<double> a_per_torque = 1.0 / (wheel + bar * (1.0 - ratio_ * r_per_a));

        State<double> state = start_->state();
        const auto driver = [&](double time) {
            Input<double> input = test::hands_off(time);
            input.hands_torque = 2 * std::sin(w * time);
            return input;
        };
        // Sine and cosine over the last periods, beside what still drifts.
        const double end = 3, begin = end - std::floor(1.5 * hertz) / hertz;
        Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
        Eigen::Matrix<double, 5, 2> right = Eigen::Matrix<double, 5, 2>::Zero();
        test::drive(model(), state, "rk4", 1e-3, end, driver, [&](double time, const State<double>& at) {
            if (time < begin) return;
            const double t = time - begin;
            Eigen::Matrix<double, 5, 1> basis;
            basis << std::sin(w * time), std::cos(w * time), 1, t, t * t;
            const auto steering = test::steering_state(model(), at);
            normal += basis * basis.transpose();
            right.col(0) += basis * steering.wheel, right.col(1) += basis * steering.rack;
        });
        const Eigen::Matrix<double, 5, 2> fit = normal.ldlt().solve(right);
        const std::complex<double> a(fit(0, 0) / 2, fit(1, 0) / 2), r(fit(0, 1) / 2, fit(1, 1) / 2);
        const std::complex<double> r_expected = r_per_a * a_per_torque;
        std::printf("%.0f Hz: wheel %.4e rad/N m, off by %.1e of it; rack %.4e m/N m, off by %.1e\n", hertz,
                    std::abs(a), std::abs(a - a_per_torque) / std::abs(a_per_torque), std::abs(r),
                    std::abs(r - r_expected) / std::abs(r_expected));
        EXPECT_LT(std::abs(a - a_per_torque), 0.01 * std::abs(a_per_torque));
        EXPECT_LT(std::abs(r - r_expected), 0.01 * std::abs(r_expected));
    }
}

}  // namespace
}  // namespace hamilcar
