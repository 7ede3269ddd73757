// Links as parts, springs on them and anti-roll bars with arms, by other routes: the motion without them, energy, virtual work on the
// points' own velocities. Every recipe with such parts also runs beside an independent engine (tests/oracle/simbody_recipes_test.cpp).
#include "hamilcar/suspension/attachments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "hamilcar/analysis/energy.hpp"
#include "hamilcar/analysis/kinematics.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "linkage/samples.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using testing::Contains;
using Vec = Vec3<double>;

TEST(LinkKeys, AreThoseOfAllMasslessLinksThatNothingDrives) {
    const auto keys = [](const std::string& keyword, const Hardpoints& points) {
        return link_keys(find_recipe(keyword)->compose(points));
    };
    EXPECT_EQ(keys("five_link", test::five_link_points()),
              (std::vector<std::string>{"link_2", "link_3", "link_4", "link_5"}));
    EXPECT_EQ(keys("macpherson", test::strut_points()), (std::vector<std::string>{"control_arm"}));
    EXPECT_EQ(keys("double_wishbone", test::wishbone_points()), (std::vector<std::string>{"upper_arm"}));
    EXPECT_THAT(keys("panhard_axle", test::solid_axle_points()), Contains("lower_link"));
    EXPECT_THAT(keys("panhard_axle", test::solid_axle_points()), Contains("panhard_rod"));
    EXPECT_THAT(keys("leaf_axle", test::solid_axle_points()), testing::IsEmpty())
        << "nothing can be mounted on equivalent links";
}

// The same car, its links parts without a mass.
TEST(LinksAsParts, WithoutAMassMoveAsLinks) {
    const VehicleDescription plain = test::shipped("bmw_e90_330i");
    VehicleDescription parts = plain;
    for (const std::size_t s : {2, 3}) {
        Composition made;
        made.linkage = parts.suspensions[s].linkage;
        for (const char* link : {"link_2", "link_4"}) make_part(made, link);
        parts.suspensions[s].linkage = made.linkage;
    }
    ASSERT_EQ(Vehicle<double>(parts).state_size, Vehicle<double>(plain).state_size + 8);
    Simulation one(plain, test::everything_moves(plain)), other(parts, test::everything_moves(plain));
    while (!one.finished()) ASSERT_FALSE(one.advance() || other.advance());
    EXPECT_LT((Vec(one.state().position()) - Vec(other.state().position())).norm(), 1e-8) << "[m] after 3 s";
    EXPECT_GT(one.state().position()[0], 20);
}

// A bar with arms on struts, another with its drop links on the links of the rear axle, springs on links: left to swing.
TEST(Attachments, KeepTheEnergyOfAConservativeCar) {
    const std::string front =
        "anti_roll_bar = {rate_N_m_per_rad = 1500, pivot_m = [-0.3, 0.45, 0.2], arm_end_m = [0.0, 0.56, 0.2], link_m = "
        "[0.0, 0.56, 0.5]}\n"
        "[[axle]]\nname = \"rear\"\nspring = {on = \"link_1\", at_m = [-2.83, 0.52, 0.20], rate_N_per_m = 40e3, "
        "force_at_design_N = \"carry\"}\n"
        "link_3 = {mass_kg = 1.5, center_of_mass_m = [-2.68, 0.55, 0.38], inertia_kg_m2 = [0.004, 0.003, 0.005]}\n"
        "anti_roll_bar = {rate_N_m_per_rad = 600, pivot_m = [-2.6, 0.4, 0.25], arm_end_m = [-2.75, 0.5, 0.25], link_m "
        "= [-2.75, 0.5, "
        "0.20], on = \"link_2\"}\n";
    const VehicleDescription car = test::made_conservative(test::shipped_with("bmw_e90_330i", "front", front));
    ScenarioDescription scenario = test::scenario(1, 10);
    scenario.solver.integrator = "rk4", scenario.solver.step = 5e-4;
    scenario.initial.angular_velocity = {0.5, 0.1, 0};
    Simulation simulation(car, scenario);
    const auto twist = [&](const Sample& s) { return s.momenta.suspensions[0].wheels[0].bar; };
    const double before = simulation.sample().energy.balance();
    double bar = 0, potential = 0;
    const double at_first = simulation.sample().energy.potential;
    while (!simulation.finished()) {
        ASSERT_FALSE(simulation.advance());
        const Sample now = simulation.sample();
        bar = std::max(bar, std::abs(twist(now))),
        potential = std::max(potential, std::abs(now.energy.potential - at_first));
    }
    EXPECT_LT(std::abs(simulation.sample().energy.balance() - before), 1e-7 * potential)
        << "[J], of " << potential << " J that swung";
    EXPECT_GT(bar, 10) << "the bar did twist [N m]";
}

// The arm's end moves along the drop link as the link's other end on the carrier does.
TEST(BarArm, TurnsAsItsDropLinkPulls) {
    const VehicleDescription car =
        test::shipped_with("bmw_323i", "front",
                           "anti_roll_bar = {rate_N_m_per_rad = 900, pivot_m = [-0.3, 0.45, 0.2], arm_end_m = [0.0, "
                           "0.56, 0.21], link_m = [0.02, 0.58, 0.5]}\n");
    const Model<double> model = test::make_model(car);
    const Suspension<double>& s = model.vehicle.suspensions[0];
    const std::array<double, max_coordinates> design{};
    LinkagePosition<double> at;
    s.linkage.find_position(design.data(), design.data(), {}, 0.0, at);
    const Vec pivot(-0.3, 0.45, 0.2), end(0.0, 0.56, 0.21), link(0.02, 0.58, 0.5), along = (link - end).normalized();
    const Spatial<double> carrier = at.motion.J[static_cast<std::size_t>(s.wheels[0].frame)].col(0);
    const double arm = along.dot(Vec::UnitY().cross(end - pivot));
    const double wanted = along.dot(velocity_at<double>(carrier, link)) / arm;
    EXPECT_NEAR(at.Y[static_cast<std::size_t>(s.wheels[0].bar_arm)][0], wanted, 1e-12);
    // Both arms, and what a bar adds to the roll stiffness.
    const double lift = velocity_at<double>(carrier, vec3(car.suspensions[0].wheels[0].wheel.center))[2];
    for (const AxleReport& report : kinematics(car, {.steps = 2})) {
        if (report.name == "front") EXPECT_NEAR(report.design.bar_twist, wanted / lift, 1e-9);
    }
}

}  // namespace
}  // namespace hamilcar
