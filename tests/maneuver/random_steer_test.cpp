// The frequency response of ISO 7401 against that of the exact linearization.
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

TEST(RandomSteer, IsLinearTheorysInTheSmall) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(random_steer(), car, {{"lateral_acceleration", 0.2}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    EXPECT_TRUE(outcome.passed());
    test::expect_linear_response(outcome, 0.2, 3, 0.02);
    const SteadyHandling handling = steady_handling(car, 80 * kilometer_per_hour);
    test::expect_share(test::figure(outcome, "yaw rate gain"), handling.yaw_rate_gain * handling.rack_per_angle, 0.02,
                       "steady gain");
}

// Hardly any of what the car does on ice is in proportion to its steering.
TEST(RandomSteer, FailsOnIce) {
    EXPECT_FALSE(test::driven(random_steer(), test::shipped_car(), {{"duration", 60}}, 0.05).passed());
    EXPECT_TRUE(test::driven(random_steer(), test::shipped_car(), {{"duration", 60}}).passed());
}

TEST(RandomSteer, MindsItsSettings) {
    test::expect_settings_checked(random_steer(), "duration", 1);
    test::expect_obstacles(random_steer());
    test::expect_interruptible(random_steer(), {});
}

}  // namespace
}  // namespace hamilcar
