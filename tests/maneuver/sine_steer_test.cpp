// The frequency response of ISO 7401 against that of the exact linearization.
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

TEST(SineSteer, IsLinearTheorysInTheSmall) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(sine_steer(), car, {{"sweep_lateral_acceleration", 0.2}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    EXPECT_TRUE(outcome.passed());
    test::expect_linear_response(outcome, 0.2, 3, 0.02);
    const SteadyHandling handling = steady_handling(car, 80 * kilometer_per_hour);
    test::expect_share(test::figure(outcome, "yaw rate gain"), handling.yaw_rate_gain * handling.rack_per_angle, 0.02,
                       "steady gain");
}

// The motor vehicle's own acceleration, which a trailer pulls at, in the drive and in theory.
TEST(SineSteer, IsLinearTheorysWithATrailerToo) {
    const Outcome outcome =
        test::driven(sine_steer(), test::shipped("truck_semitrailer"), {{"sweep_lateral_acceleration", 0.1}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    test::expect_linear_response(outcome, 0.2, 1, 0.03);
}

// Up an eighth there is not the power to hold 180 km/h.
TEST(SineSteer, FailsWhereTheSpeedCannotBeHeld) {
    const VehicleDescription car = test::shipped_car();
    ManeuverOptions options;
    options.keep_runs = false;
    options.road.grade = 0.125;
    const Settings chosen{{"speed", 180}, {"lateral_acceleration", 1}};
    EXPECT_FALSE(sine_steer().drive(car, complete_settings(sine_steer(), car, chosen), options).passed());
}

// The single period at small amplitude: its peaks' gain lies below that of the lasting sine of its frequency, and the peaks lag.
TEST(SineSteer, DrivesAPeriod) {
    const Outcome outcome = test::driven(sine_steer(), test::shipped_car(), {{"lateral_acceleration", 0.2}});
    const double gain = test::curve(outcome, "yaw rate gain").y.at(3);  // at 0.5 Hz
    test::expect_share(test::figure(outcome, "yaw rate peak gain"), gain, 0.1, "gain");
    test::expect_share(test::figure(outcome, "yaw rate second lag"), test::figure(outcome, "yaw rate lag at 0.5 Hz"),
                       0.1, "lag");
}

TEST(SineSteer, MindsItsSettings) {
    test::expect_settings_checked(sine_steer(), "frequency", 0);
    test::expect_obstacles(sine_steer());
    test::expect_interruptible(sine_steer(), {});
}

}  // namespace
}  // namespace hamilcar
