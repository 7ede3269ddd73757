// The mechanics of a steering: what a file says becomes what a description holds, and what it leaves out follows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "steering_sample.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;

constexpr double degree = M_PI / 180;

TEST(SteeringFile, ARatioAloneHasNoMechanics) {
    const SteeringDescription steering = read_steering_of(ratio_alone);
    EXPECT_EQ(steering.rack_per_revolution, 0.0365);
    EXPECT_EQ(steering.rack_travel, 0.073);
    EXPECT_FALSE(steering.mechanics);
    EXPECT_FALSE(steering.moves_on_its_own());
}

TEST(SteeringFile, MechanicsAloneDoNotFreeTheRack) {
    SteeringDescription steering = read_steering_of(whole_steering);
    ASSERT_TRUE(steering.mechanics);
    EXPECT_FALSE(steering.moves_on_its_own()) << "only a scenario does";
    steering.is_free = true;
    EXPECT_TRUE(steering.moves_on_its_own());
    EXPECT_EQ(steering.rack_per_revolution, 0.0365);
    EXPECT_EQ(steering.rack_travel, 0.073);
}

TEST(SteeringFile, RackAndColumnAreAsWritten) {
    const SteeringMechanicsDescription all = read_steering_of(whole_steering).mechanics.value();
    EXPECT_EQ(all.rack_mass, 3.5);
    EXPECT_EQ(all.rack_damping, 700);
    EXPECT_EQ(all.rack_friction, 90);
    EXPECT_EQ(all.rack_stiffness, 2e6);
    EXPECT_EQ(all.stop_stiffness, 3e6);
    EXPECT_EQ(all.wheel_inertia, 0.045);
    EXPECT_EQ(all.wheel_damping, 0.25);
    EXPECT_EQ(all.wheel_friction, 0.3);
    EXPECT_EQ(all.wheel_stiffness, 40);
    EXPECT_EQ(all.bar_stiffness, 95);
    EXPECT_EQ(all.bar_damping, 0.15);
    EXPECT_DOUBLE_EQ(all.joint_error, 1.5 * degree);
    EXPECT_DOUBLE_EQ(all.joint_phase, -30 * degree);
}

TEST(SteeringFile, AssistAndHandsAreAsWritten) {
    const SteeringMechanicsDescription all = read_steering_of(whole_steering).mechanics.value();
    EXPECT_THAT(all.assist.torque, ElementsAre(0, 2, 8));
    EXPECT_THAT(all.assist.force, ElementsAre(0, 100, 4100));
    EXPECT_THAT(all.assist.speed, ElementsAre(0, 10, 40));
    EXPECT_THAT(all.assist.share, ElementsAre(1, 0.6, 0.2));
    EXPECT_EQ(all.assist.response_time, 0.004);
    EXPECT_EQ(all.assist.lead_time, 0.007);
    EXPECT_EQ(all.assist.fastest_rack, 0.11);
    EXPECT_EQ(all.assist.rack_band, 0.05);
    EXPECT_EQ(all.hands_stiffness, 800);
    EXPECT_EQ(all.hands_damping, 6);
}

TEST(SteeringFile, WhatIsLeftOutFollows) {
    const SteeringMechanicsDescription some = read_steering_of(least_steering).mechanics.value();
    EXPECT_EQ(some.rack_damping, 0);
    EXPECT_EQ(some.rack_friction, 0);
    EXPECT_EQ(some.stop_stiffness, 2e6);
    EXPECT_EQ(some.wheel_damping, 0);
    EXPECT_EQ(some.wheel_friction, 0);
    EXPECT_EQ(some.bar_damping, 0);
    EXPECT_EQ(some.joint_error, 0);
    EXPECT_EQ(some.joint_phase, 0);
    EXPECT_TRUE(some.assist.torque.empty());
    EXPECT_EQ(some.hands_stiffness, 1000);
    EXPECT_DOUBLE_EQ(some.hands_damping, 1.4 * std::sqrt(1000 * 0.045)) << "0.7 of critical";
}

TEST(SteeringFile, FrictionThatHoldsGivesWayByATenthOfAMillimeter) {
    const std::string dry = changed(changed(whole_steering, "holding_stiffness_N_per_m = 2e6", ""),
                                    "holding_stiffness_N_m_per_rad = 40", "");
    const SteeringMechanicsDescription all = read_steering_of(dry).mechanics.value();
    EXPECT_DOUBLE_EQ(all.rack_friction / all.rack_stiffness, 1e-4);
    EXPECT_DOUBLE_EQ(all.wheel_friction / all.wheel_stiffness, 0.01);
    const SteeringMechanicsDescription smooth = read_steering_of(least_steering).mechanics.value();
    EXPECT_GT(smooth.rack_stiffness, 0) << "no friction divides nothing by zero";
    EXPECT_GT(smooth.wheel_stiffness, 0);
}

TEST(SteeringFile, AnAssistMayDoWithoutSpeedsAndTimes) {
    const std::string text = std::string(least_steering) + "assist.torque_N_m = [0, 5]\nassist.force_N = [0, 2e3]\n";
    const SteeringAssistDescription assist = read_steering_of(text).mechanics.value().assist;
    EXPECT_THAT(assist.force, ElementsAre(0, 2e3));
    EXPECT_TRUE(assist.speed.empty());
    EXPECT_TRUE(assist.share.empty());
    const SteeringAssistDescription usual;
    EXPECT_EQ(assist.response_time, usual.response_time);
    EXPECT_EQ(assist.lead_time, usual.lead_time);
    EXPECT_EQ(assist.fastest_rack, usual.fastest_rack);
    EXPECT_EQ(assist.rack_band, usual.rack_band);
}

TEST(SteeringFile, HandsAloneMayBeStiffer) {
    const SteeringMechanicsDescription all =
        read_steering_of(std::string(least_steering) + "hands.stiffness_N_m_per_rad = 4000\n").mechanics.value();
    EXPECT_EQ(all.hands_stiffness, 4000);
    EXPECT_DOUBLE_EQ(all.hands_damping, 1.4 * std::sqrt(1000 * 0.045)) << "as without the key";
}

TEST(SteeringFile, MechanicsGoWithARatioThatVaries) {
    const SteeringDescription steering = read_steering_of(changed(
        whole_steering, "rack_m_per_revolution = 0.0365", "angle_deg = [0, 90, 360]\nrack_m = [0, 0.01, 0.045]"));
    EXPECT_THAT(steering.rack, ElementsAre(0, 0.01, 0.045));
    EXPECT_TRUE(steering.mechanics);
}

TEST(SteeringFile, AnotherFileMayChangeOneNumber) {
    const TemporaryFolder folder;
    folder.write("car.toml", car_with_steering(whole_steering));
    const SteeringMechanicsDescription all =
        read_vehicle(
            folder.write("other.toml", "base = \"car.toml\"\nname = \"Other\"\nsteering.column.friction_N_m = 0.5\n"))
            .steering.mechanics.value();
    EXPECT_EQ(all.wheel_friction, 0.5);
    EXPECT_EQ(all.rack_friction, 90);
}

}  // namespace
}  // namespace hamilcar::io
