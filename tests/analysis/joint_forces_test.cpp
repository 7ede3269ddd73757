// Forces in links and joints by other routes: the independent coordinates' own equations, which were not used; the rack, whose force
// comes from energy; the carrier at rest as a free body.
#include "hamilcar/analysis/joint_forces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/rack_force.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using Vec = Vec3<double>;

// A car at one instant of a drive.
struct Driven {
    Driven(const std::string& name, const ScenarioDescription& scenario, double until)
        : Driven(test::shipped(name), scenario, until) {}
    Driven(const VehicleDescription& vehicle, const ScenarioDescription& scenario, double until)
        : car(vehicle), simulation(advanced(vehicle, scenario, until)) {}
    static Simulation advanced(const VehicleDescription& car, const ScenarioDescription& scenario, double until) {
        Simulation simulation(car, scenario);
        while (simulation.time() < until - 1e-9) {
            if (const auto end = simulation.advance()) ADD_FAILURE() << end->message;
        }
        return simulation;
    }
    VehicleDescription car;
    Simulation simulation;
    Sample sample = simulation.sample();
    Unbalanced unbalanced{sample.model, sample.state, sample.input, sample.velocity, sample.momenta};
    VehicleJointForces forces() const {
        VehicleJointForces out;
        joint_forces(unbalanced, car, out);
        return out;
    }
};

ScenarioDescription everything_moves(const std::string& name) {
    VehicleDescription car = test::shipped(name);
    ScenarioDescription scenario = test::everything_moves(car, 3);
    return scenario;
}

class JointForcesOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, JointForcesOf, testing::ValuesIn(test::fleet()),
                         [](const auto& run) { return run.param; });

// One equation of each wheel is not used to find the forces: driven, steered and braked, it holds to the difference's error.
TEST_P(JointForcesOf, HoldWhatTheIndependentCoordinatesSay) {
    for (const double time : {0.7, 1.5, 2.8}) {
        const Driven now(GetParam(), everything_moves(GetParam()), time);
        double largest = 0;
        const VehicleJointForces all = now.forces();
        for (std::size_t s = 0; s < all.size(); ++s) {
            const JointForces& f = all[s];
            for (std::size_t i = 0; i < f.joints.size(); ++i) largest = std::max(largest, f.joints[i].norm());
            for (std::size_t i = 0; i < f.cuts.size(); ++i) largest = std::max(largest, f.cuts[i].norm());
            EXPECT_LT(f.unbalanced, 1e-4) << "at " << time << " s [N or N m]";
        }
        EXPECT_GT(largest, 1000);
    }
}

// An engine in a low gear, whose shaft turns a live axle against the chassis.
TEST(JointForces, HoldWhatTheIndependentCoordinatesSayUnderPower) {
    for (const char* name : {"pickup", "offroader", "bmw_323i"}) {
        ScenarioDescription scenario = test::scenario(1.5, 5);
        scenario.throttle = test::table({0.2, 0.6}, {0, 0.5});
        scenario.gear = {{0}, {1}, Interpolation::steps};
        const Driven now(name, scenario, 1.2);
        EXPECT_GT(std::abs(now.sample.momenta.powertrain.inputs[0]), 50) << name;
        const VehicleJointForces all = now.forces();
        for (std::size_t s = 0; s < all.size(); ++s) {
            EXPECT_LT(all[s].unbalanced, 1e-3) << name << ", " << now.car.suspensions[s].name << " [N or N m]";
        }
    }
}

// With a bar's arms, links that are parts, and a spring on one.
TEST(JointForces, HoldWhatTheIndependentCoordinatesSayWithAttachments) {
    const std::string keys =
        "anti_roll_bar = {rate_N_m_per_rad = 1500, pivot_m = [-0.3, 0.45, 0.2], arm_end_m = [0.0, 0.56, 0.2], link_m = "
        "[0.0, 0.56, "
        "0.5]}\n[[axle]]\nname = \"rear\"\nspring = {on = \"link_2\", at_m = [-2.72, 0.59, 0.19], rate_N_per_m = 25e3, "
        "force_at_design_N = \"carry\"}\nlink_3 = {mass_kg = 1.5, center_of_mass_m = [-2.68, 0.55, 0.38], "
        "inertia_kg_m2 = [0.004, "
        "0.003, 0.005]}\n";
    const VehicleDescription car = test::shipped_with("bmw_e90_330i", "front", keys);
    for (const double time : {0.7, 1.1}) {
        const Driven now(car, test::everything_moves(car, 3), time);
        const VehicleJointForces all = now.forces();
        for (std::size_t s = 0; s < all.size(); ++s)
            EXPECT_LT(all[s].unbalanced, 1e-4) << "at " << time << " s [N or N m]";
        // The drop link's tension turns the arm against the bar: no mass is on it.
        const LinkageDescription& d = car.suspensions[0].linkage;
        const auto link = static_cast<std::size_t>(std::ranges::find(d.cuts, "drop link", &CutJointDescription::name) -
                                                   d.cuts.begin());
        const LinkagePosition<double> at = now.unbalanced.position(0, 0);
        const auto arm = static_cast<std::size_t>(frame_of_part(d, d.cuts[link].base));
        const Vec bush = vec3(d.joints[d.cuts[link].base - 1].point), end = at.pose[arm].point(vec3(d.cuts[link].foot));
        const double moment = (end - bush).cross(-all[0].cuts[link])[1],
                     bar = now.sample.momenta.suspensions[0].wheels[0].bar;
        EXPECT_NEAR(moment, -bar, 1e-4) << "[N m]";
        EXPECT_GT(std::abs(bar), 5);
    }
}

// What the rods that the rack moves give to the carriers is what holds the rack: the same sum in another order.
TEST_P(JointForcesOf, OfTheTieRodsHoldTheRack) {
    double largest = 0;
    for (const double time : {0.7, 1.5, 2.8}) {
        const Driven now(GetParam(), everything_moves(GetParam()), time);
        const double wanted =
            rack_force(now.sample.model, now.sample.state, now.sample.input, now.sample.velocity, now.sample.momenta);
        double force = 0;
        const VehicleJointForces all = now.forces();
        for (std::size_t s = 0; s < all.size(); ++s) {
            const std::vector<CutJointDescription>& cuts = now.car.suspensions[s].linkage.cuts;
            for (std::size_t i = 0; i < cuts.size(); ++i) force += all[s].cuts[i].dot(vec3(cuts[i].drive));
        }
        EXPECT_NEAR(force, wanted, 1e-4) << "at " << time << " s [N]";
        largest = std::max(largest, std::abs(wanted));
    }
    EXPECT_GT(largest, 100) << "[N]";
}

// A pickup's front left carrier at rest: road, weight, two ball joints and the tie rod, forces and moments.
TEST(JointForces, HoldTheCarrierAtRest) {
    const Driven now("pickup", test::scenario(1, 0), 0);
    const Suspension<double>& s = now.sample.model.vehicle.suspensions[0];
    const JointForces f = now.forces()[0];
    const LinkagePosition<double> at = now.unbalanced.position(0, 0);
    const Vec gravity = now.sample.velocity.R_GC.row(2).transpose() * -now.sample.model.vehicle.gravity;
    const auto at_point = [](const Vec& force, const Vec& point) { return force_at<double>(point, force); };
    const auto frame = static_cast<std::size_t>(s.wheels[0].frame);
    Spatial<double> sum = Spatial<double>::Zero();
    for (std::size_t i = 0; i < s.bodies.size(); ++i) {
        const auto& body = now.sample.velocity.suspensions[0].inertia[i];
        if (static_cast<std::size_t>(s.bodies[i].frame) != frame) continue;
        sum += spatial<double>(gravity * body.mass, body.first_moment.cross(gravity));
    }
    const TireForces<double>& tire = now.sample.momenta.suspensions[0].wheels[0].tires[0];
    const Vec axis = now.sample.velocity.suspensions[0].axis[0];
    dispatch(s.wheels[0].tire, [&](const auto& model) { sum += carrier_wrench(model, tire, axis); });
    const LinkageDescription& d = now.car.suspensions[0].linkage;
    ASSERT_EQ(d.joints[1].part, "carrier");
    sum += at_point(f.joints[1], at.pose[1].point(vec3(d.joints[1].point)));
    for (std::size_t i = 0; i < d.cuts.size(); ++i)
        sum += at_point(f.cuts[i], at.pose[frame].point(vec3(d.cuts[i].tip)));
    EXPECT_LT(linear(sum).norm(), 1e-4) << "[N]";
    EXPECT_LT(angular(sum).norm(), 1e-4) << "[N m]";
    EXPECT_GT(f.joints[1].norm(), 0.5 * tire.tire.Fz) << "the spring sits on the lower arm";
}

// A trailing arm at rest: road, weight, spring, damper and its two bushes, forces and moments.
TEST(JointForces, HoldAnArmInItsBushes) {
    const Driven now("bmw_323i", test::scenario(1, 0), 0);
    const std::size_t arm = 2;
    const Suspension<double>& s = now.sample.model.vehicle.suspensions[arm];
    const LinkageDescription& d = now.car.suspensions[arm].linkage;
    ASSERT_TRUE(d.joints[0].other_bush);
    const BushForces f = now.forces()[arm].joint_bushes[0];
    const Vec gravity = now.sample.velocity.R_GC.row(2).transpose() * -now.sample.model.vehicle.gravity;
    const auto& body = now.sample.velocity.suspensions[arm].inertia[0];
    Spatial<double> sum = spatial<double>(gravity * body.mass, body.first_moment.cross(gravity));
    const auto& momenta = now.sample.momenta.suspensions[arm];
    dispatch(s.wheels[0].tire, [&](const auto& model) {
        sum += carrier_wrench(model, momenta.wheels[0].tires[0], now.sample.velocity.suspensions[arm].axis[0]);
    });
    const auto pose = now.unbalanced.position(arm, 0).pose[1];
    const auto push = [&](const Vec& point, const Vec& force) { sum += force_at<double>(point, force); };
    const auto press = [&](const LineDescription& line, double force) {
        const Vec at = pose.point(vec3(line.on_part));
        push(at, (at - vec3(line.on_base)).normalized() * force);
    };
    press(now.car.suspensions[arm].springs[0].line, momenta.springs[0].force);
    press(now.car.suspensions[arm].dampers[0].line, momenta.dampers[0].force);
    push(vec3(d.joints[0].point), f.first), push(vec3(*d.joints[0].other_bush), f.second);
    const Vec bar(0, 0, momenta.wheels[0].bar + momenta.wheels[0].stop);
    push(now.sample.velocity.suspensions[arm].center[0], bar);
    EXPECT_LT(linear(sum).norm(), 1e-4) << "[N]";
    EXPECT_LT(angular(sum).norm(), 1e-4) << "[N m]";
    EXPECT_GT(f.first.norm(), 200);
    EXPECT_GT(f.second.norm(), 200);
}

// The bushes of a massless upper arm give what the arm gives to its ball, without a moment about it.
TEST_P(JointForcesOf, OfAnArmsBushesAreTheBalls) {
    const Driven now(GetParam(), everything_moves(GetParam()), 1.1);
    for (std::size_t s = 0; s < now.car.suspensions.size(); ++s) {
        const LinkageDescription& d = now.car.suspensions[s].linkage;
        const JointForces f = now.forces()[s];
        const LinkagePosition<double> at = now.unbalanced.position(s, 0);
        for (std::size_t i = 0; i < d.cuts.size(); ++i) {
            if (!d.cuts[i].other_bush) continue;
            const Vec ball =
                at.pose[static_cast<std::size_t>(frame_of_part(d, d.cuts[i].part))].point(vec3(d.cuts[i].tip));
            const Vec first = vec3(d.cuts[i].foot) - ball, second = vec3(*d.cuts[i].other_bush) - ball;
            const Vec moment = first.cross(f.cut_bushes[i].first) + second.cross(f.cut_bushes[i].second);
            EXPECT_LT((f.cut_bushes[i].first + f.cut_bushes[i].second - f.cuts[i]).norm(), 1e-9);
            EXPECT_LT(moment.norm(), 1e-6) << d.cuts[i].name;
        }
    }
}

}  // namespace
}  // namespace hamilcar
