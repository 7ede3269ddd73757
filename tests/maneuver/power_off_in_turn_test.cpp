// ISO 9816 beside ISO 7975: the same circle and the same steering, without and with the brake.
#include <cmath>

#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

using test::figure;

TEST(PowerOffInTurn, SlowsDownLessThanWithTheLightestBraking) {
    const Settings circle{{"lateral_acceleration", 4}};
    Settings braked = circle;
    braked["least_deceleration"] = braked["deceleration"] = braked["reference"] = 1;
    const Outcome off = test::driven(power_off_in_turn(), test::shipped_car(), circle);
    const Outcome braking = test::driven(braking_in_turn(), test::shipped_car(), braked);
    ASSERT_FALSE(off.failed) << *off.failed;
    EXPECT_EQ(figure(off, "radius"), figure(braking, "radius")) << "one circle";
    EXPECT_EQ(figure(off, "steering wheel angle"), figure(braking, "steering wheel angle"));
    EXPECT_GT(figure(off, "deceleration after 1 s"), 0.1) << "the engine's drag";
    EXPECT_LT(figure(off, "deceleration after 1 s"), figure(braking, "largest deceleration"));
}

// On a driven rear axle the engine's drag and the load that moves forward both turn the car in.
TEST(PowerOffInTurn, ARearDrivenCarTurnsInMoreTheLonger) {
    const Outcome outcome = test::driven(power_off_in_turn(), test::shipped_car(), {{"lateral_acceleration", 5}});
    EXPECT_GT(figure(outcome, "yaw rate ratio after 1 s"), 1);
    EXPECT_GT(figure(outcome, "path deviation after 1 s"), 0);
    EXPECT_GT(figure(outcome, "path deviation after 2 s"), 2 * figure(outcome, "path deviation after 1 s"));
}

// A deviation d from a circle grows as the second integral of the lateral acceleration beyond v^2 / R, to the first order.
TEST(PowerOffInTurn, ThePathDeviatesAsTheLateralAccelerationSays) {
    const Outcome outcome = test::driven(power_off_in_turn(), test::shipped_car(), {{"lateral_acceleration", 3}});
    const double ratio = figure(outcome, "lateral acceleration ratio after 1 s");
    const double beyond = (ratio - 1) * figure(outcome, "lateral acceleration");  // at the end of the second [m/s^2]
    const double deviation = figure(outcome, "path deviation after 1 s");
    EXPECT_GT(deviation * beyond, 0) << "the same way";
    EXPECT_LT(std::abs(deviation), std::abs(beyond) / 2) << "as if it had acted throughout";
}

TEST(PowerOffInTurn, MindsItsSettings) {
    test::expect_settings_checked(power_off_in_turn(), "radius", 1);
    test::expect_obstacles(power_off_in_turn());
    test::expect_interruptible(power_off_in_turn(), {});
}

}  // namespace
}  // namespace hamilcar
