// Stability control at a made-up car: which wheel it brakes when the car turns more or less than its driver asks for.
#include "control/made_up_car.hpp"

namespace hamilcar {
namespace {

using namespace test;

constexpr double speed = 25;                   // [m/s]
constexpr double characteristic_speed = 30;    // the setting's default [m/s]
constexpr double wheels_per_angle = 1 / 16.0;  // of the made-up car
constexpr double wheelbase = 2.7;              // likewise [m]

// A steady turn as a single track with that characteristic speed turns; the yaw rate times `share`.
Doing turning(double steering_wheel, double share = 1) {
    const double relative = speed / characteristic_speed,
                 rate = speed * steering_wheel * wheels_per_angle / (wheelbase * (1 + relative * relative));
    return {.speed = speed, .yaw_rate = share * rate, .lateral = speed * rate, .steering_wheel = steering_wheel};
}
MadeUpCar rolling(const std::vector<std::pair<std::string, double>>& settings = {}) {
    MadeUpCar car("esc", settings, 100);
    car.go(0.5, {.speed = speed});
    return car;
}
constexpr std::size_t all_wheels[] = {front_left, front_right, rear_left, rear_right};

TEST(StabilityControl, LeavesACarAloneThatTurnsAsItIsSteered) {
    for (const double angle : {0.0, 0.2, -0.5}) {
        MadeUpCar car = rolling();
        car.go(2, turning(angle));
        EXPECT_TRUE(car.rests()) << angle;
        EXPECT_EQ(car.activity(), 0);
    }
}

TEST(StabilityControl, BrakesTheOuterFrontWheelOfACarThatTurnsTooMuch) {
    MadeUpCar car = rolling();
    car.go(0.5, turning(0.4));
    car.go(0.2, turning(0.4, 2.5));  // to the left: the right wheels are outside
    EXPECT_EQ(car.valves(front_right).inlet, 0);
    EXPECT_GT(car.pressure(front_right), 0.1e7);
    for (const std::size_t wheel : {front_left, rear_left}) EXPECT_LT(car.pressure(wheel), 0.02e7) << wheel;
    EXPECT_GT(car.activity(), 0.2);
    EXPECT_LT(car.max_throttle(), 1) << "the engine gives way";
    car.go(4, turning(0.4));
    EXPECT_TRUE(car.rests()) << "it turns as it is steered again";
    EXPECT_EQ(car.activity(), 0);
}

TEST(StabilityControl, BrakesTheInnerRearWheelOfACarThatTurnsTooLittle) {
    MadeUpCar car = rolling();
    Doing pushing = turning(1.2, 0.2);
    pushing.lateral = speed * pushing.yaw_rate;
    car.go(1.2, pushing);
    EXPECT_GT(car.pressure(rear_left), 0.02e7);
    for (const std::size_t wheel : {front_right, rear_right}) EXPECT_LT(car.pressure(wheel), 0.02e7) << wheel;
    EXPECT_LT(car.max_throttle(), 1);
}

TEST(StabilityControl, DoesNothingSlowlyAndBackward) {
    MadeUpCar slow("esc", {}, 100);
    slow.go(0.5, {.speed = 3});
    slow.go(0.5, {.speed = 3, .yaw_rate = 1, .lateral = 3});
    EXPECT_TRUE(slow.rests());
    MadeUpCar backward = rolling();
    Doing reversing = turning(0.4, 3);
    reversing.gear = -1;
    backward.go(0.5, reversing);
    EXPECT_TRUE(backward.rests());
}

TEST(StabilityControl, BrakesAllWheelsWhereTheCarMightTurnOver) {
    const auto pressures = [](double limit) {
        MadeUpCar car = rolling({{"rollover_acceleration_m_per_s2", limit}});
        Doing hard = turning(0.8);
        hard.lateral = 7, hard.yaw_rate = 7 / speed, hard.throttle = 1;
        car.go(0.5, hard);
        std::array<double, 4> out{};
        for (const std::size_t wheel : all_wheels) out[wheel] = car.pressure(wheel);
        return out;
    };
    for (const double pressure : pressures(5)) EXPECT_GT(pressure, 0.1e7);
    for (const double pressure : pressures(0)) EXPECT_LT(pressure, 0.02e7) << "none";
}

TEST(StabilityControl, DoesOnTheLeftWhatItDoesOnTheRight) {
    expect_mirrored("esc", {{"rollover_acceleration_m_per_s2", 8}}, 3, [](double t) {
        Doing out = turning(0.6 * std::sin(4 * t), t > 1 ? 1 + std::sin(3 * t) : 1);
        out.brake = t > 2 ? 0.3 : 0;
        return out;
    });
}

}  // namespace
}  // namespace hamilcar
