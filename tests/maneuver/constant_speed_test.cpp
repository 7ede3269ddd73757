// ISO 4138 at one speed: gradients against the exact linearization straight ahead at that speed.
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

TEST(ConstantSpeed, HasTheGradientsOfLinearTheory) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(constant_speed(), car, {{"largest_lateral_acceleration", 3.5}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    EXPECT_TRUE(outcome.passed());
    const SteadyHandling linear = steady_handling(car, 100 * kilometer_per_hour);
    const auto expect = [&](const std::string& name, double wanted) {
        test::expect_share(test::figure(outcome, name), wanted / degree, 0.02, name);
    };
    expect("understeer gradient", linear.understeer_gradient);
    expect("roll gradient", linear.roll_gradient);
    expect("sideslip gradient", linear.sideslip_gradient);
}

TEST(ConstantSpeed, GoesToTheLimitOfFriction) {
    const Outcome outcome = test::driven(constant_speed(), test::shipped_car(),
                                         {{"speed", 60}, {"rate", 0.5}, {"largest_lateral_acceleration", 10}}, 0.4);
    EXPECT_LT(test::figure(outcome, "largest lateral acceleration"), 0.4 * 11);
    EXPECT_GT(test::figure(outcome, "largest lateral acceleration"), 0.4 * 7);
}

// Up an eighth there is not the power to hold 180 km/h.
TEST(ConstantSpeed, FailsWhereTheSpeedCannotBeHeld) {
    const VehicleDescription car = test::shipped_car();
    ManeuverOptions options;
    options.keep_runs = false;
    options.road.grade = 0.125;
    const Settings chosen{{"speed", 180}, {"rate", 0.5}, {"largest_lateral_acceleration", 3}};
    EXPECT_FALSE(constant_speed().drive(car, complete_settings(constant_speed(), car, chosen), options).passed());
}

TEST(ConstantSpeed, MindsItsSettings) {
    test::expect_settings_checked(constant_speed(), "speed", 1e3);
    test::expect_obstacles(constant_speed());
    test::expect_interruptible(constant_speed(), {});
}

}  // namespace
}  // namespace hamilcar
