// The frequency response of ISO 7401 against that of the exact linearization.
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

TEST(PulseSteer, IsLinearTheorysInTheSmall) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(pulse_steer(), car, {{"lateral_acceleration", 0.2}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    EXPECT_TRUE(outcome.passed());
    test::expect_linear_response(outcome, 0.2, 3, 0.02);
    const SteadyHandling handling = steady_handling(car, 80 * kilometer_per_hour);
    test::expect_share(test::figure(outcome, "yaw rate gain"), handling.yaw_rate_gain * handling.rack_per_angle, 0.02,
                       "steady gain");
}

// At 200 km/h the yawing is not over after two seconds.
TEST(PulseSteer, FailsWhereTheEndIsCutOff) {
    EXPECT_FALSE(test::driven(pulse_steer(), test::shipped_car(), {{"speed", 200}, {"duration", 2}}).passed());
    EXPECT_TRUE(test::driven(pulse_steer(), test::shipped_car(), {}).passed());
}

TEST(PulseSteer, MindsItsSettings) {
    test::expect_settings_checked(pulse_steer(), "width", -1);
    test::expect_obstacles(pulse_steer());
    test::expect_interruptible(pulse_steer(), {});
}

}  // namespace
}  // namespace hamilcar
