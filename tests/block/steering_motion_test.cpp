// A free rack's motion by theory: what is conserved, and the prescribed rack as the limit of a stiff column.
#include <gtest/gtest.h>

#include <cmath>

#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

class SteeringMotion : public testing::TestWithParam<std::string> {
protected:
    static VehicleDescription chassis() {
        return GetParam() == "knuckle" ? test::sprung_at_the_knuckle() : test::shipped(GetParam());
    }
    // Without dissipation, thrown up and spinning, with a torsion bar that is twisted.
    static double energy_error(double step) {
        VehicleDescription car = test::with_mechanics(test::made_conservative(chassis()), test::bare_mechanics());
        ScenarioDescription s = test::set_free(test::scenario(1));
        s.initial.velocity = {8, 0.5, 0.1}, s.initial.angular_velocity = {0.1, 0.08, 0.3};
        const Simulation start(car, s);
        const Model<double>& model = start.model();
        State<double> state = start.state();
        const auto steering = model.vehicle.steering.state(state.values.data());
        steering.wheel += 0.3, steering.wheel_momentum = 0.04 * 2;
        const double before = test::energy_of(model, state, test::hands_off(0)).balance();
        double worst = 0, moved = 0;
        test::drive(model, state, "rk4", step, 0.4, test::hands_off, [&](double, const State<double>& at) {
            worst = std::max(worst, std::abs(test::energy_of(model, at, test::hands_off(0)).balance() - before));
            moved = std::max(moved, std::abs(test::steering_state(model, at).rack));
        });
        EXPECT_GT(moved, 1e-3);
        EXPECT_LT(moved, car.steering.rack_travel);
        EXPECT_EQ(state.work(), 0) << "nothing dissipates";
        return worst;
    }
};
INSTANTIATE_TEST_SUITE_P(Cars, SteeringMotion,
                         testing::Values("bmw_323i", "hatchback", "formula", "offroader", "truck_semitrailer",
                                         "knuckle"),
                         [](const auto& test) { return test.param; });

TEST_P(SteeringMotion, LosesEnergyAtTheMethodsOrderAlone) {
    const double coarse = energy_error(2e-3), middle = energy_error(1e-3), fine = energy_error(5e-4);
    std::printf("%s: rk4 worst |dE| %.2e, %.2e, %.2e J at 2, 1, 0.5 ms\n", GetParam().c_str(), coarse, middle, fine);
    EXPECT_GE(coarse / middle, 16);
    EXPECT_GE(middle / fine, 16);
}

// Whatever hands, assist and friction do to the rack: they are inside the car.
TEST_P(SteeringMotion, LeavesTheMomentumOfTheCarAlone) {
    VehicleDescription car = test::with_mechanics(chassis(), test::full_mechanics());
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
    test::drive(model, state, "ab3", 5e-4, 0.5, driver, [&](double time, const State<double>& at) {
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

}  // namespace
}  // namespace hamilcar
