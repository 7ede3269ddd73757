// The anti-lock system at a made-up car: what it does with the valves when which wheel slips.
#include "control/made_up_car.hpp"

namespace hamilcar {
namespace {

using namespace test;

constexpr double initial_speed = 25, deceleration = 8,
                 steady = 0.3;  // [m/s], [m/s^2], time before anything happens [s]

// Braking at 8 m/s^2 with the pedal all the way down, wheels 3 percent slower than the ground.
Doing braking(double t) {
    const double speed = initial_speed - deceleration * t, slip = -0.03 * speed;
    return {.speed = speed, .acceleration = -deceleration, .brake = 1, .slip = {slip, slip, slip, slip}};
}
// Before the pedal, so that the speed is known.
MadeUpCar rolling(const std::vector<std::pair<std::string, double>>& settings = {}) {
    MadeUpCar car("abs", settings);
    car.go(0.5, {.speed = initial_speed});
    return car;
}
// A wheel that loses 60 m/s^2 from an instant on, as one does that locks.
double locking(double t, double from) {
    return t > from ? std::max(-60 * (t - from), -0.9 * initial_speed) : 0;
}
Doing with_slip(double t, std::size_t wheel, double slip) {
    Doing out = braking(t);
    out.slip[wheel] += slip;
    return out;
}

TEST(AntiLock, LeavesWheelsAloneThatRoll) {
    MadeUpCar car = rolling();
    for (int i = 0; i < 20; ++i) {
        car.go(0.1, [&](double t) { return braking(0.1 * i + t); });
        EXPECT_TRUE(car.rests()) << i;
        EXPECT_EQ(car.activity(), 0);
    }
    EXPECT_NEAR(car.pressure(front_left), 1e7, 1e4) << "all that the pedal asks for";
}

TEST(AntiLock, ReleasesAFrontWheelThatIsAboutToLock) {
    MadeUpCar car = rolling();
    car.go(steady + 0.08, [](double t) { return with_slip(t, front_left, locking(t, steady)); });
    EXPECT_EQ(car.valves(front_left).inlet, 0);
    EXPECT_GT(car.valves(front_left).outlet, 0.5);
    EXPECT_TRUE(car.rests(rear_left));
    EXPECT_TRUE(car.rests(rear_right));
    EXPECT_GE(car.activity(), 0.25);
    EXPECT_LT(car.pressure(front_left), 0.6e7);
}

TEST(AntiLock, BuildsUpAgainWhenTheWheelRolls) {
    MadeUpCar car = rolling();
    car.go(0.4, [](double t) { return with_slip(t, front_left, locking(t, steady)); });
    const double low = car.pressure(front_left);
    EXPECT_LT(low, 0.5e7);
    car.go(0.05, [](double t) { return braking(0.4 + t); });
    EXPECT_GT(car.pressure(front_left), low + 0.2e7) << "most comes back at once";
    car.go(1.5, [](double t) { return braking(0.45 + t); });
    EXPECT_TRUE(car.rests()) << "friction has risen for good";
    EXPECT_NEAR(car.pressure(front_left), 1e7, 1e5);
}

TEST(AntiLock, BrakesARearAxleAsItsWorseWheelNeedsIt) {
    for (const bool select_low : {true, false}) {
        MadeUpCar car = rolling({{"select_low", select_low ? 1 : 0}});
        car.go(steady + 0.08, [](double t) { return with_slip(t, rear_right, locking(t, steady)); });
        EXPECT_GT(car.valves(rear_right).outlet, 0.5);
        EXPECT_EQ(car.valves(rear_left).outlet > 0, select_low);
        EXPECT_EQ(car.rests(rear_left), !select_low);
    }
}

// On split friction, so that the driver has time to steer against it.
TEST(AntiLock, LetsTheOtherFrontWheelsPressureRiseSlowly) {
    const auto other_pressure = [](double rise) {
        MadeUpCar car = rolling({{"yaw_moment_rise_s", rise}});
        car.go(0.5, [](double t) {  // the pressure is still low where the wheel on ice slips
            Doing out = with_slip(t, front_left, locking(t, 0.06));
            out.brake = std::min(2.5 * t, 1.0);
            return out;
        });
        return car.pressure(front_right);
    };
    EXPECT_NEAR(other_pressure(0), 1e7, 2e5) << "at once";
    const double slow = other_pressure(2), faster = other_pressure(0.7);
    EXPECT_LT(slow, 0.8 * faster);
    EXPECT_LT(faster, 0.9e7);
}

TEST(AntiLock, RestsAtWalkingSpeedAndWithoutTheBrake) {
    MadeUpCar slow("abs");
    slow.go(0.3, {.speed = 1.2});
    slow.go(0.3, {.speed = 1.2, .brake = 1, .slip = {-1.2, -1.2, -1.2, -1.2}});
    EXPECT_TRUE(slow.rests());
    MadeUpCar free = rolling();
    free.go(0.5, {.speed = initial_speed, .slip = {0, 0, -5, -5}});  // an engine that drags
    EXPECT_TRUE(free.rests());
}

TEST(AntiLock, LetsGoWhenTheDriverDoes) {
    MadeUpCar car = rolling();
    car.go(steady + 0.1, [](double t) { return with_slip(t, front_left, locking(t, steady)); });
    ASSERT_FALSE(car.rests());
    car.go(0.2, {.speed = initial_speed - 3});
    EXPECT_TRUE(car.rests());
    EXPECT_EQ(car.activity(), 0);
}

TEST(AntiLock, DoesOnTheLeftWhatItDoesOnTheRight) {
    expect_mirrored("abs", {}, 1, [](double t) {
        if (t < 0.3) return Doing{.speed = initial_speed};
        Doing out = with_slip(t - 0.3, front_left, locking(t, 0.6));
        out.slip[rear_right] += t > 0.8 ? -3 : 0;
        out.steering_wheel = 0.4, out.yaw_rate = 0.1;
        return out;
    });
}

}  // namespace
}  // namespace hamilcar
