// On-center handling against the ellipse that linear theory draws.
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

// angle A sin(wt), output |H| A sin(wt + phi): slope |H| / cos(phi) and width 2 A sin|phi| at no output.
TEST(Weave, IsAnEllipseInTheSmall) {
    const VehicleDescription car = test::shipped_car();
    constexpr double speed = 100 * kilometer_per_hour, frequency = 0.2;
    const Outcome outcome = test::driven(weave(), car, {{"lateral_acceleration", 0.2}, {"periods", 1}});
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    const Linearizer linearizer(car);
    const LinearModel model = linearizer.linearize(linearizer.operating_point({.speed = speed}));
    const SteadyHandling handling = steady_handling(car, speed);
    const double w = 2 * std::numbers::pi * frequency;
    const std::complex<double> response =
        steering_response(model, handling.rack_per_angle, output_lateral_acceleration, {w})[0];
    const double phase = std::arg(response), amplitude = test::figure(outcome, "steering wheel angle");
    test::expect_share(test::figure(outcome, "steering sensitivity"), std::abs(response) * degree / std::cos(phase),
                       0.02, "sensitivity");
    test::expect_share(test::figure(outcome, "angle dead band"), 2 * amplitude * std::sin(std::abs(phase)), 0.02,
                       "angle dead band");
    test::expect_share(test::figure(outcome, "lateral acceleration dead band"),
                       2 * amplitude * degree * std::abs(response) * std::sin(std::abs(phase)), 0.02, "dead band");
    test::expect_share(test::figure(outcome, "lateral acceleration lag"), -phase / w, 0.02, "lag");
}

// Norman's returnability is one intercept of the loop of torque over lateral acceleration, read here off the diagram.
TEST(Weave, ReturnabilityIsTheLateralAccelerationLeftAtNoTorque) {
    const Outcome outcome = test::driven(weave(), test::shipped_car(), {{"periods", 1}});
    const io::Curve& loop = test::curve(outcome, "steering torque");
    double sum = 0, count = 0;
    for (std::size_t i = 1; i < loop.x.size(); ++i) {
        if ((loop.y[i - 1] < 0) == (loop.y[i] < 0)) continue;
        const double share = loop.y[i - 1] / (loop.y[i - 1] - loop.y[i]);
        sum += std::abs(loop.x[i - 1] + share * (loop.x[i] - loop.x[i - 1])), ++count;
    }
    ASSERT_GE(count, 2);
    EXPECT_GT(sum / count, 0.01);
    test::expect_share(test::figure(outcome, "returnability"), sum / count, 0.01, "returnability");
}

TEST(Weave, FailsOnIce) {
    const Settings chosen{{"periods", 1}};
    EXPECT_FALSE(test::driven(weave(), test::shipped_car(), chosen, 0.1).passed());
    EXPECT_TRUE(test::driven(weave(), test::shipped_car(), chosen).passed());
}

TEST(Weave, MindsItsSettings) {
    test::expect_settings_checked(weave(), "periods", 0);
    test::expect_obstacles(weave());
    test::expect_interruptible(weave(), {});
}

}  // namespace
}  // namespace hamilcar
