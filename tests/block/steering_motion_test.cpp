// A free rack's motion by theory: what is conserved, the prescribed rack as the limit of a stiff column, and the vibrations of steering
// wheel and rack against each other by the closed forms of two masses on a spring.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <complex>
#include <numbers>

#include "hamilcar/analysis/acceleration.hpp"
#include "hamilcar/analysis/rack_force.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

constexpr double turn = 2 * std::numbers::pi;

// Steps with inputs as a function of time; look(time, state) after each.
template <class Driver, class Look>
void drive(const Model<double>& model, State<double>& state, const char* method, double step, double duration,
           const Driver& driver, const Look& look) {
    Integrator<State<double>> integrator(*find_method(method), step, model.vehicle.state_size);
    const long steps = std::lround(duration / step);
    for (long i = 0; i < steps; ++i) {
        integration_block(model, integrator, driver, static_cast<double>(i) * step, state);
        look(static_cast<double>(i + 1) * step, state);
    }
}

Input<double> hands_off(double) {
    Input<double> input;
    input.hands_hold = 0;
    return input;
}

class SteeringMotion : public testing::TestWithParam<std::string> {
protected:
    // Without dissipation, thrown up and spinning, with a torsion bar that is twisted.
    static double energy_error(double step) {
        VehicleDescription car =
            test::with_mechanics(test::made_conservative(test::shipped(GetParam())), test::bare_mechanics());
        ScenarioDescription s = test::set_free(test::scenario(1));
        s.initial.velocity = {8, 0.5, 0.1}, s.initial.angular_velocity = {0.1, 0.08, 0.3};
        const Simulation start(car, s);
        const Model<double>& model = start.model();
        State<double> state = start.state();
        const auto steering = model.vehicle.steering.state(state.values.data());
        steering.wheel += 0.3, steering.wheel_momentum = 0.04 * 2;
        const double before = test::energy_of(model, state, hands_off(0)).balance();
        double worst = 0, moved = 0;
        drive(model, state, "rk4", step, 0.4, hands_off, [&](double, const State<double>& at) {
            worst = std::max(worst, std::abs(test::energy_of(model, at, hands_off(0)).balance() - before));
            moved = std::max(moved, std::abs(test::steering_state(model, at).rack));
        });
        EXPECT_GT(moved, 1e-3);
        EXPECT_LT(moved, car.steering.rack_travel);
        EXPECT_EQ(state.work(), 0) << "nothing dissipates";
        return worst;
    }
};
INSTANTIATE_TEST_SUITE_P(Cars, SteeringMotion,
                         testing::Values("bmw_323i", "hatchback", "formula", "offroader", "truck_semitrailer"),
                         [](const auto& test) { return test.param; });

TEST_P(SteeringMotion, LosesEnergyAtTheMethodsOrderAlone) {
    const double coarse = energy_error(2e-3), middle = energy_error(1e-3), fine = energy_error(5e-4);
    std::printf("%s: rk4 worst |dE| %.2e, %.2e, %.2e J at 2, 1, 0.5 ms\n", GetParam().c_str(), coarse, middle, fine);
    EXPECT_GE(coarse / middle, 16);
    EXPECT_GE(middle / fine, 16);
}

// Whatever hands, assist and friction do to the rack: they are inside the car.
TEST_P(SteeringMotion, LeavesTheMomentumOfTheCarAlone) {
    VehicleDescription car = test::with_mechanics(test::shipped(GetParam()), test::full_mechanics());
    car.gravity = 0, car.aerodynamics = {};
    car.steering.is_free = true;
    const Model<double> model = test::make_model(car);
    State<double> state = design_state(model, Vec3<double>(10, 5, 30), Mat3<double>::Identity());
    ASSERT_TRUE(assemble(model, {}, state).assembled);
    Spatial<double> v;
    v << 3, -2, 1, 0.3, 0.2, 0.6;
    set_velocities(model, {}, v, state);
    const auto invariants = [&] {
        const Spatial<double> momentum =
            QuaternionChart<double>{}.momentum(Vector<double, 4>(state.orientation()), state.momentum());
        const Vec3<double> p = momentum.head<3>();
        Vector<double, 6> out;
        out << p, Vec3<double>(momentum.tail<3>()) + Vec3<double>(state.position()).cross(p);
        return out;
    };
    const Vector<double, 6> before = invariants();
    double fastest = 0;
    const auto driver = [](double time) {
        Input<double> input;
        input.rack = {0.01 * std::sin(8 * time), 0.08 * std::cos(8 * time), -0.64 * std::sin(8 * time)};
        input.hands_hold = 0.7, input.hands_torque = 3 * std::sin(13 * time);
        return input;
    };
    drive(model, state, "ab3", 5e-4, 0.5, driver, [&](double time, const State<double>& at) {
        fastest = std::max(fastest, std::abs(velocity_block(model, at, driver(time)).rack.rate));
    });
    const Vector<double, 6> change = invariants() - before;
    EXPECT_LT(change.norm(), 1e-13 * before.norm());
    EXPECT_GT(fastest, 0.02);
}

// Column and hands ever stiffer, without friction: the rack goes where it is asked for, by an error of the first order in 1 / k.
TEST(StiffColumn, LeadsTheRackAsThePrescribedOneGoes) {
    const VehicleDescription car = test::shipped("bmw_323i");
    ScenarioDescription s = test::everything_moves(car, 2);
    s.solver.integrator = "rk4", s.solver.step = 5e-4;
    Simulation prescribed(car, s);
    std::vector<double> rack;
    while (!prescribed.finished()) {
        ASSERT_FALSE(prescribed.advance());
        rack.push_back(prescribed.schedule()(prescribed.time()).rack.displacement);
    }
    double coarser = 0, coarser_way = 0;
    for (const double stiff : {1.0, 2.0, 4.0}) {
        SteeringMechanicsDescription d = test::bare_mechanics();
        d.bar_stiffness = 1000 * stiff, d.bar_damping = 1;
        d.hands_stiffness = 2000 * stiff, d.hands_damping = 2 * 0.7 * std::sqrt(d.hands_stiffness * d.wheel_inertia);
        Simulation free(test::with_mechanics(car, d), test::set_free(s));
        double worst = 0;
        for (std::size_t i = 0; !free.finished(); ++i) {
            ASSERT_FALSE(free.advance());
            worst = std::max(worst, std::abs(test::steering_state(free.model(), free.state()).rack - rack[i]));
        }
        const double way = (free.state().position() - prescribed.state().position()).norm();
        std::printf("k = %.0f N m/rad: rack off by %.2e m, place in the end by %.2e m\n", d.bar_stiffness, worst, way);
        if (coarser > 0) {
            EXPECT_NEAR(coarser / worst, 2, 0.1);
            EXPECT_NEAR(coarser_way / way, 2, 0.1);
        }
        coarser = worst, coarser_way = way;
    }
}

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
        drive(model(), state, "rk4", 5e-4, duration, hands_off, [&](double time, const State<double>& at) {
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
            Input<double> input = hands_off(time);
            input.hands_torque = 2 * std::sin(w * time);
            return input;
        };
        // Sine and cosine over the last periods, beside what still drifts.
        const double end = 3, begin = end - std::floor(1.5 * hertz) / hertz;
        Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
        Eigen::Matrix<double, 5, 2> right = Eigen::Matrix<double, 5, 2>::Zero();
        drive(model(), state, "rk4", 1e-3, end, driver, [&](double time, const State<double>& at) {
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
