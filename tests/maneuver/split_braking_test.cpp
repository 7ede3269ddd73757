#include "hamilcar/maneuver/scenarios.hpp"
#include "maneuver/straight_support.hpp"

namespace hamilcar::test {
namespace {

// Nearly so for a car with an engine that turns one way.
TEST(SplitBraking, TheOtherSideTurnsTheOtherWay) {
    const Outcome left = driven_straight(split_braking(), paper_car(), {{"low_side", 1}});
    const Outcome right = driven_straight(split_braking(), paper_car(), {{"low_side", -1}});
    const std::string rate = "yaw rate after 1 s", heading = "change of heading in the first second";
    EXPECT_LT(figure_named(left, rate), 0) << "toward the side that grips";
    EXPECT_NEAR(figure_named(left, rate), -figure_named(right, rate), 0.01);
    EXPECT_NEAR(figure_named(left, heading), -figure_named(right, heading), 0.01);
    EXPECT_NEAR(figure_named(left, "stopping distance"), figure_named(right, "stopping distance"), 0.01);
}

TEST(SplitBraking, TheSameOnBothSidesTurnsNothing) {
    const Outcome outcome = driven_straight(split_braking(), paper_car(), {{"low_friction", 1}});
    EXPECT_NEAR(figure_named(outcome, "yaw rate after 1 s"), 0, 0.01);
    // Half a g was asked for, and drag comes on top.
    EXPECT_NEAR(figure_named(outcome, "MFDD"), 0.5 * standard_gravity, 0.5);
}

// Sliding wheels on the slippery side, holding ones on the other: no more than the brakes' force there turns the car.
TEST(SplitBraking, TheFirstTurnIsThatOfTheBrakesForces) {
    const VehicleDescription car = shipped_car();
    const Outcome outcome = driven_straight(split_braking(), car, {{"steering", 0}});
    const double pedal = complete_settings(split_braking(), car, {}).at("pedal") / 100;
    double moment = 0, inertia = car.chassis.inertia[2];
    for (const SuspensionDescription& corner : car.suspensions) {
        const double x = corner.wheels[0].wheel.center[0] - car.chassis.center_of_mass[0],
                     y = corner.wheels[0].wheel.center[1];
        inertia += corner.bodies[0].body.mass * (x * x + y * y);
        if (y < 0) moment += pedal * corner.wheels[0].brake.max_torque / 0.288 * -y;  // rolling radius [m]
    }
    const double most = moment / inertia / degree;  // after one second, were there nothing against it [deg/s]
    EXPECT_LT(std::abs(figure_named(outcome, "yaw rate after 1 s")), most);
    EXPECT_GT(std::abs(figure_named(outcome, "yaw rate after 1 s")), 0.2 * most);
    EXPECT_EQ(verdict_about(outcome, "steering at most"), nullptr) << "no driver steers";
}

TEST(SplitBraking, ADriverHoldsTheLaneUnlessAllWheelsLock) {
    const Outcome gentle = driven_straight(split_braking(), shipped_car());
    EXPECT_TRUE(gentle.passed());
    const Outcome panic = driven_straight(split_braking(), shipped_car(), {{"pedal", 100}});
    EXPECT_FALSE(panic.passed()) << "locked wheels cannot be steered";
}

TEST(SplitBraking, RefusesAndStops) {
    expect_bad_settings(split_braking(), {{"low_friction", -1}});
    expect_interruptible(split_braking());
}

}  // namespace
}  // namespace hamilcar::test
