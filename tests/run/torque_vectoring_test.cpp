// Torque vectoring with a motor at every rear wheel: the sum of the torques stays the driver's, and the car turns as it is steered.
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/control/kinds.hpp"
#include "support/electric.hpp"

namespace hamilcar {
namespace {

VehicleDescription vectored(bool with) {
    const VehicleDescription car = test::with_wheel_motors(test::electric_car(), false);
    if (!with) return test::controlled_by(car, {});
    return test::controlled_by(car, {test::controller("torque_vectoring", 100)});
}

ScenarioDescription steered(double speed, double angle, double duration) {
    ScenarioDescription s = test::pedal(duration, speed, test::table({0, 1}, {0.3, 0.3}));
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0.5, 0.9}, {0, angle});
    return s;
}

struct Turn {
    double yaw_rate, speed, left, right;  // [rad/s], [m/s], torques of the rear wheels [N m]
};
Turn turn(bool with, double speed, double angle, double duration) {
    Simulation run(vectored(with), steered(speed, angle, duration));
    test::run_to_end(run);
    const Sample s = run.sample();
    return {angular(s.velocity.chassis)[2], linear(s.velocity.chassis)[0],
            s.momenta.suspensions[2].wheels[0].drive_torque, s.momenta.suspensions[2].wheels[1].drive_torque};
}

TEST(TorqueVectoring, TurnsTheCarIntoTheCurve) {
    const Turn without = turn(false, 25, 0.35, 3), with = turn(true, 25, 0.35, 3);
    EXPECT_NEAR(without.left, without.right, 0.02 * std::abs(without.left) + 1);
    EXPECT_GT(with.right, with.left + 50) << "to the left: the right wheel pulls";
    EXPECT_NEAR(with.left + with.right, without.left + without.right, 0.05 * (without.left + without.right))
        << "the driver's torque stays";
    EXPECT_GT(with.yaw_rate, 1.04 * without.yaw_rate) << "this car understeers by itself";
    const Turn mirrored = turn(true, 25, -0.35, 3);
    EXPECT_NEAR(mirrored.yaw_rate, -with.yaw_rate, 1e-6);
    EXPECT_NEAR(mirrored.left, with.right, 1e-3);
}

TEST(TorqueVectoring, RestsOnAStraightRoad) {
    const Turn straight = turn(true, 25, 0, 2);
    EXPECT_NEAR(straight.left, straight.right, 0.5);
    EXPECT_NEAR(straight.yaw_rate, 0, 1e-5);
}

TEST(TorqueVectoring, RestsInNeutral) {
    ScenarioDescription s = steered(15, 1, 2);
    s.gear = {{0}, {0}, Interpolation::steps};
    Simulation run(vectored(true), s);
    const auto place = static_cast<std::size_t>(run.control()->layout().find("rear_left_motor.added_torque"));
    while (!run.finished()) {
        ASSERT_FALSE(run.advance());
        ASSERT_EQ(run.schedule().commands()[place], 0);
    }
}

TEST(TorqueVectoring, IsRefusedWithoutAMotorAtEachWheel) {
    const ControllerKind* kind = find_controller_kind("torque_vectoring");
    ASSERT_TRUE(kind);
    EXPECT_EQ(kind->lacks(vectored(true)), "");
    EXPECT_EQ(kind->lacks(test::electric_car()), "an axle each of whose wheels has a motor of its own");
}

}  // namespace
}  // namespace hamilcar
