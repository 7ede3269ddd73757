// ISO 4138 on a circle: gradients against the exact linearization about such circles, and limits against friction.
#include <fmt/format.h>

#include "hamilcar/maneuver/steady_turn.hpp"
#include "lateral_tests.hpp"

namespace hamilcar {
namespace {

const Settings small{{"largest_lateral_acceleration", 3}, {"rest", 5}};

TEST(ConstantRadius, HasTheGradientsOfLinearTheory) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(constant_radius(), car, small);
    ASSERT_FALSE(outcome.failed) << *outcome.failed;
    EXPECT_TRUE(outcome.passed());
    constexpr double crawl = 4, quick = 28;  // where the circle asks for nothing, and where it is wide [m/s]
    test::expect_share(test::figure(outcome, "understeer gradient"), constant_radius_gradient(car, 100, crawl) / degree,
                       0.02, "understeer gradient");
    test::expect_share(test::figure(outcome, "roll gradient"), steady_handling(car, quick).roll_gradient / degree, 0.02,
                       "roll gradient");
}

// Far from small: where the tires' curves bend, the car goes round at its speed by the same linearization.
TEST(ConstantRadius, HasTheGradientsOfLinearTheoryFartherOut) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome =
        test::driven(constant_radius(), car, {{"largest_lateral_acceleration", 5.2}, {"rest", 5}, {"step", 0.4}});
    const double ratio = turning_geometry(car).steering_ratio;
    for (const double a : {2.0, 4.0}) {
        const std::string at_a = fmt::format("at {:g} m/s^2", a);
        const double theory = constant_radius_gradient(car, 100, std::sqrt(100 * a)) / degree;
        test::expect_share(test::figure(outcome, "understeer gradient " + at_a), theory, 0.02, at_a);
        test::expect_share(test::figure(outcome, "understeer gradient of the wheels " + at_a), theory / ratio, 0.02,
                           "wheels " + at_a);
    }
    EXPECT_TRUE(std::isnan(test::figure(outcome, "understeer gradient at 6 m/s^2"))) << "not driven";
}

TEST(ConstantRadius, TellsGradientsPerGToo) {
    const std::optional<Figure> other = per_g({"roll gradient", "deg/(m/s^2)", "", 0.5});
    ASSERT_TRUE(other);
    EXPECT_EQ(other->unit, "deg/g");
    EXPECT_DOUBLE_EQ(other->value, 4.903325);
    EXPECT_FALSE(per_g({"largest lateral acceleration", "m/s^2", "", 9}));
}

// With every state found by Newton's method instead of driven.
TEST(ConstantRadius, GoesThroughTheSteadyMotions) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = test::driven(constant_radius(), car, small);
    const Linearizer linearizer(car);
    const io::Curve& angle = test::curve(outcome, "steering wheel angle");
    ASSERT_GE(angle.x.size(), 5u);
    for (const std::size_t i : {1u, 4u}) {
        const OperatingPoint at = linearizer.operating_point({std::sqrt(100 * angle.x[i]), angle.x[i]});
        ASSERT_TRUE(at.found) << at.problem;
        const double wanted = at.input.rack.displacement * 2 * std::numbers::pi / car.steering.rack_per_revolution;
        test::expect_share(angle.y[i], wanted / degree, 3e-3, "angle");
    }
}

TEST(ConstantRadius, EndsWhereTheRoadIsTooSlippery) {
    const Outcome outcome =
        test::driven(constant_radius(), test::shipped_car(), {{"largest_lateral_acceleration", 8}}, 0.3);
    EXPECT_LT(test::figure(outcome, "largest lateral acceleration"), 3.2);
    EXPECT_GT(test::figure(outcome, "largest lateral acceleration"), 1.8);
    EXPECT_FALSE(outcome.passed());
}

// On a road so slippery that the limit comes soon.
TEST(ConstantRadius, FindsTheSameLimitAndGradientWhateverTheStep) {
    const VehicleDescription car = test::shipped_car();
    const auto with = [&](double step) {
        return test::driven(constant_radius(), car,
                            {{"largest_lateral_acceleration", 8},
                             {"small_lateral_acceleration", 1.5},
                             {"step", step},
                             {"radius", 40},
                             {"rest", 3}},
                            0.4);
    };
    const Outcome coarse = with(0.5), fine = with(0.3);
    const std::string limit = "largest lateral acceleration", gradient = "understeer gradient";
    EXPECT_NEAR(test::figure(coarse, limit), test::figure(fine, limit), 0.02);
    EXPECT_NEAR(test::figure(coarse, gradient), test::figure(fine, gradient), 1e-9);
    for (const Outcome* outcome : {&coarse, &fine}) {
        const std::vector<double>& a = test::curve(*outcome, "roll angle").x;
        EXPECT_EQ(test::figure(*outcome, limit), a.back()) << "the diagram ends there";
        EXPECT_TRUE(std::ranges::is_sorted(a));
    }
}

// One that is told to stop early has shown nothing about the circle further on.
TEST(ConstantRadius, GivesNoVerdictAboutWhatWasNotReached) {
    const VehicleDescription car = test::shipped_car();
    Settings chosen = small;
    chosen["largest_lateral_acceleration"] = 8, chosen["radius"] = 40, chosen["rest"] = 3;
    const Outcome outcome = test::driven(constant_radius(), car, chosen, 0.2);
    ASSERT_EQ(outcome.verdicts.size(), 1u);
    EXPECT_FALSE(outcome.verdicts[0].passed);
    EXPECT_NE(outcome.verdicts[0].found.find("not reached"), std::string::npos) << outcome.verdicts[0].found;
}

TEST(ConstantRadius, MindsItsSettings) {
    test::expect_settings_checked(constant_radius(), "radius", 1);
    test::expect_obstacles(constant_radius());
    test::expect_interruptible(constant_radius(), {});
}

}  // namespace
}  // namespace hamilcar
