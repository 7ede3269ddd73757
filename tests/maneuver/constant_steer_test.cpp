// ISO 4138 with the steering wheel held: gradients against the exact linearization, and the curvature against the theory of
// understeer.
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

TEST(ConstantSteer, HasTheGradientsOfLinearTheory) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(constant_steer(), car, {{"radius", 100}, {"largest_speed", 66}, {"rest", 5}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    constexpr double crawl = 4, quick = 28;  // where the circle asks for nothing, and where it is wide [m/s]
    test::expect_share(test::figure(outcome, "understeer gradient"), constant_radius_gradient(car, 100, crawl) / degree,
                       0.02, "understeer gradient");
    test::expect_share(test::figure(outcome, "roll gradient"), steady_handling(car, quick).roll_gradient / degree, 0.02,
                       "roll gradient");
}

TEST(ConstantSteer, FailsWithoutStates) {
    const Outcome outcome = test::driven(constant_steer(), test::shipped_car(), {{"largest_speed", 25}});
    EXPECT_TRUE(outcome.failed);
    EXPECT_FALSE(outcome.passed());
}

TEST(ConstantSteer, MindsItsSettings) {
    test::expect_settings_checked(constant_steer(), "rest", 0);
    test::expect_obstacles(constant_steer());
    test::expect_interruptible(constant_steer(), {});
}

}  // namespace
}  // namespace hamilcar
