// Traction control at a made-up car: what it does with the throttle and the brakes when driven wheels spin.
#include "control/made_up_car.hpp"

namespace hamilcar {
namespace {

using namespace test;

// Full throttle; driven wheels turn faster than the ground by so much [m/s].
Doing driving(double speed, double left, double right) {
    return {.speed = speed, .acceleration = 1, .throttle = 1, .slip = {0, 0, left, right}};
}
// Rolls along first, so that the speed is known.
MadeUpCar rolling(double speed, const std::vector<std::pair<std::string, double>>& settings = {}) {
    MadeUpCar car("traction_control", settings, 100);
    car.go(0.5, {.speed = speed});
    return car;
}

TEST(TractionControl, LeavesAloneWheelsThatHold) {
    MadeUpCar car = rolling(10);
    car.go(2, driving(10, 0.3, 0.3));
    EXPECT_TRUE(car.rests());
    EXPECT_EQ(car.activity(), 0);
}

TEST(TractionControl, LimitsTheThrottleOfWheelsThatSpin) {
    MadeUpCar car = rolling(20);  // too fast for brakes
    car.go(0.1, driving(20, 4, 4));
    const double soon = car.max_throttle();
    EXPECT_LT(soon, 0.95);
    car.go(0.5, driving(20, 4, 4));
    EXPECT_LT(car.max_throttle(), soon - 0.1) << "more and more";
    EXPECT_GT(car.activity(), 0.2);
    for (const std::size_t wheel : {front_left, front_right, rear_left, rear_right}) EXPECT_TRUE(car.rests(wheel));
    car.go(4, driving(20, 0.2, 0.2));
    EXPECT_TRUE(car.rests()) << "friction has risen for good";
}

TEST(TractionControl, LimitsNothingThatTheDriverDoesNotAskFor) {
    MadeUpCar car = rolling(20);
    Doing coasting = driving(20, 4, 4);
    coasting.throttle = 0;
    car.go(0.5, coasting);
    EXPECT_TRUE(car.rests());
}

TEST(TractionControl, BrakesTheWheelThatSpinsAloneAtLowSpeed) {
    for (const double speed : {3.0, 20.0}) {
        MadeUpCar car = rolling(speed);
        car.go(0.3, driving(speed, 5, 0));
        if (speed < 11) {
            EXPECT_EQ(car.valves(rear_left).inlet, 0);
            EXPECT_GT(car.pressure(rear_left), 0.05e7);
        } else {
            EXPECT_TRUE(car.rests(rear_left)) << "brakes would be too hot or too sudden";
        }
        EXPECT_TRUE(car.rests(rear_right));
        EXPECT_TRUE(car.rests(front_left));
        car.go(3, driving(speed, 0.2, 0.2));
        EXPECT_TRUE(car.rests());
    }
    MadeUpCar without = rolling(3, {{"brake_speed_m_per_s", 0}});
    without.go(0.3, driving(3, 5, 0));
    EXPECT_TRUE(without.rests(rear_left));
    EXPECT_LT(without.max_throttle(), 1);
}

TEST(TractionControl, GivesWheelsBackWhenTheDriverBrakes) {
    MadeUpCar car = rolling(3);
    car.go(0.3, driving(3, 5, 0));
    ASSERT_FALSE(car.rests(rear_left));
    Doing braking = driving(3, 5, 0);  // lightly, while it still spins
    braking.throttle = 0, braking.brake = 0.02;
    car.go(0.05, braking);
    for (const std::size_t wheel : {front_left, front_right, rear_left, rear_right}) EXPECT_TRUE(car.rests(wheel));
}

TEST(TractionControl, DoesOnTheLeftWhatItDoesOnTheRight) {
    expect_mirrored("traction_control", {}, 1.5, [](double t) {
        Doing out = driving(3 + t, t > 0.3 ? 4 * t : 0, t > 0.8 ? 1.5 : 0);
        out.steering_wheel = 0.5, out.yaw_rate = 0.05;
        return out;
    });
}

}  // namespace
}  // namespace hamilcar
