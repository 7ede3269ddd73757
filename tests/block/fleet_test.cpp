// Every shipped vehicle, trailers too: energy at the method's order, the state's momenta against those of the bodies,
// symmetry, lanes, no allocation.
#include <gtest/gtest.h>

#include <cstring>

#include "hamilcar/analysis/linear_model.hpp"
#include "hamilcar/batch/batch.hpp"
#include "support/allocation_guard.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

class Fleet : public testing::TestWithParam<std::string> {
protected:
    VehicleDescription car() const { return test::shipped(GetParam()); }
};

TEST_P(Fleet, KeepsItsEnergyBalance) {
    Simulation simulation(car(), test::everything_moves(car()));
    test::run_to_end(simulation);
    const Sample sample = simulation.sample();
    EXPECT_LT(sample.violation, 1e-10);
    EXPECT_LT(std::abs(sample.energy.balance() - simulation.initial_energy_balance()), 1e-6 * sample.energy.kinetic);
}

// The conservative vehicle thrown up and spinning, trailers swinging: Runge-Kutta loses energy at its fifth order or better.
double energy_error(const VehicleDescription& car, double step) {
    ScenarioDescription s = test::scenario(0.4);
    s.solver.integrator = "rk4", s.solver.step = step;
    s.controllers_off = {"all"};  // whose rates go with few steps only
    s.initial.velocity = {8, 0.5, 0.1}, s.initial.angular_velocity = {0.1, 0.08, 0.3};
    Simulation simulation(test::made_conservative(car), s);
    double worst = 0;
    while (!simulation.finished()) {
        const auto end = simulation.advance();
        if (end) ADD_FAILURE() << end->message;
        if (end) break;
        worst = std::max(worst, std::abs(simulation.sample().energy.balance() - simulation.initial_energy_balance()));
    }
    return worst;
}

TEST_P(Fleet, LosesEnergyAtTheMethodsOrderAlone) {
    const double coarse = energy_error(car(), 2e-3), fine = energy_error(car(), 1e-3);
    std::printf("%s: rk4 worst |dE| %.2e J at 2 ms, %.2e J at 1 ms\n", GetParam().c_str(), coarse, fine);
    EXPECT_GE(coarse / fine, 16);
}

// The state's momenta, from the velocities that the Velocity block finds: body by body, unit by unit.
TEST_P(Fleet, MomentaAreThoseOfTheBodies) {
    Simulation simulation(car(), test::everything_moves(car(), 1));
    test::run_to_end(simulation);
    const Model<double>& model = simulation.model();
    const Vehicle<double>& vehicle = model.vehicle;
    const State<double>& state = simulation.state();
    const auto velocity = velocity_block(model, state, simulation.schedule()(simulation.time()));
    std::vector<Spatial<double>> unit{vehicle.chassis_inertia * velocity.chassis};
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        unit.push_back(vehicle.trailers[i].chassis_inertia * velocity.trailers[i].motion);
    }
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = vehicle.suspensions[s];
        const SuspensionVelocity<double>& at = velocity.suspensions[s];
        std::array<double, max_freedoms> P{};
        const auto add = [&](int frame, const Spatial<double>& h) {
            unit[static_cast<std::size_t>(suspension.unit)] += h;
            for (int j = 0; j < suspension.linkage.nV(); ++j) P[j] += at.at.motion.J[frame].col(j).dot(h);
        };
        for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
            add(suspension.bodies[i].frame, at.inertia[i] * at.motion[suspension.bodies[i].frame]);
        }
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            add(suspension.wheels[i].frame, spatial<double>(Vec3<double>::Zero(), at.spin_momentum[i]));
        }
        for (int j = 0; j < suspension.linkage.nV(); ++j) {
            EXPECT_NEAR(P[j], suspension.state(state.values.data()).momentum[j], 1e-9 * (1 + std::abs(P[j])));
        }
    }
    for (std::size_t i = vehicle.trailers.size(); i-- > 0;) {
        unit[static_cast<std::size_t>(vehicle.trailers[i].tow)] +=
            force_to_parent(velocity.trailers[i].pose, unit[i + 1]);
    }
    EXPECT_LT((unit[0] - velocity.momentum).norm(), 1e-9 * unit[0].norm());
}

TEST_P(Fleet, AllocatesNothingInAStep) {
    Simulation simulation(car(), test::everything_moves(car()));
    simulation.prepare();
    const test::AllocationGuard guard;
    for (int i = 0; i < 20; ++i) simulation.advance();
    EXPECT_EQ(guard.allocations(), 0);
}

TEST_P(Fleet, GivesTheSameBitsInLanes) {
    const VehicleDescription one = car();
    VehicleDescription other = one;
    other.chassis.mass *= 1.1;
    for (SuspensionDescription& suspension : other.suspensions) suspension.springs[0].spring.rate *= 1.2;
    std::vector<Simulation> cars;
    cars.emplace_back(one, test::everything_moves(one)), cars.emplace_back(other, test::everything_moves(other));
    Batch batch(cars, {});
    batch.advance(400);
    for (std::size_t i = 0; i < cars.size(); ++i) {
        Simulation alone = cars[i];
        for (int k = 0; k < 400; ++k) alone.advance();
        const State<double> lane = batch.state(static_cast<int>(i));
        for (int k = 0; k < alone.model().vehicle.state_size; ++k) {
            ASSERT_EQ(lane.values[static_cast<std::size_t>(k)], alone.state().values[static_cast<std::size_t>(k)]) << k;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Vehicles, Fleet, testing::ValuesIn(test::fleet()), [](const auto& one) { return one.param; });

// Steering the other way takes the mirrored path; not the off-road car, whose Panhard rods have a side.
TEST(Mirror, HoldsForEveryVehicle) {
    for (const char* name : {"hatchback", "formula", "pickup", "bmw_e90_330i"}) {
        const VehicleDescription car = test::shipped(name);
        ScenarioDescription left = test::everything_moves(car), right = left;
        for (double& angle : right.steering.value) angle = -angle;
        Simulation a(car, left), b(car, right);
        test::run_to_end(a), test::run_to_end(b);
        EXPECT_NEAR(a.state().position()[0], b.state().position()[0], 1e-9) << name;
        EXPECT_NEAR(a.state().position()[1], -b.state().position()[1], 1e-9) << name;
        EXPECT_GT(std::abs(a.state().position()[1]), 1e-3) << name;
    }
}

// The rotation of an arm about a mirrored axis is mirrored with the other sign: with preloads of opposite sense a car on
// torsion bars stands upright, and leans where they are equal.
TEST(Mirror, TorsionBarsOfMirroredArmsTurnTheOtherWay) {
    for (const double sense : {-1.0, 1.0}) {
        VehicleDescription car = test::shipped("formula");
        for (SuspensionDescription& suspension : car.suspensions) {
            LineDescription about;
            about.coordinate = 0;
            const bool right = suspension.name.ends_with("_right");
            suspension.springs = {{suspension.name, about, {6000, 150 * (right ? sense : 1.0)}}};
        }
        const Linearizer linearizer(car);
        const OperatingPoint at = linearizer.operating_point({});
        if (sense < 0) {
            ASSERT_TRUE(at.found) << at.problem;
            EXPECT_NEAR(at.z[1], 0, 1e-9);
        } else {
            EXPECT_TRUE(!at.found || std::abs(at.z[1]) > 1e-3);
        }
    }
}

// Neither position nor heading matters.
TEST_P(Fleet, DrivesTheSameElsewhereAndTurned) {
    ScenarioDescription here = test::everything_moves(car(), 1), there = here;
    there.initial.position = {5000, -3000};
    there.initial.yaw = 1;
    Simulation a(car(), here), b(car(), there);
    test::run_to_end(a), test::run_to_end(b);
    const Vec3<double> moved = Vec3<double>(b.state().position()) - Vec3<double>(5000, -3000, 0);
    const Vec3<double> turned = axis_rotation<double>(Vec3<double>::UnitZ(), 1.0) * Vec3<double>(a.state().position());
    EXPECT_LT((moved - turned).norm(), 1e-8);
}

TEST(Trailer, HoldsInTheStabilizedModeAndTheBryantChart) {
    const VehicleDescription car = test::shipped("truck_semitrailer");
    ScenarioDescription exact = test::everything_moves(car), paper = exact;
    paper.solver.constraints = ConstraintMode::stabilized, paper.solver.chart = ChassisChart::bryant;
    Simulation a(car, exact), b(car, paper);
    test::run_to_end(a), test::run_to_end(b);
    EXPECT_LT((a.state().position() - b.state().position()).norm(), 1e-6);
}

TEST(Trailer, LoadsAllWheels) {
    const VehicleDescription car = test::shipped("truck_semitrailer");
    const Simulation simulation(car, test::scenario(1));
    const Sample s = simulation.sample();
    double load = 0;
    for (std::size_t i = 0; i < car.suspensions.size(); ++i) {
        for (std::size_t w = 0; w < car.suspensions[i].wheels.size(); ++w) {
            const auto& f = s.momenta.suspensions[i].wheels[w];
            load += f.tires[0].tire.Fz + (car.suspensions[i].wheels[w].dual_spacing > 0 ? f.tires[1].tire.Fz : 0);
        }
    }
    const double weight = s.model.vehicle.total_mass * s.model.vehicle.gravity;
    EXPECT_NEAR(load, weight, 1e-8 * weight);
}

}  // namespace
}  // namespace hamilcar
