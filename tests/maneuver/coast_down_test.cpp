#include "hamilcar/maneuver/test_run.hpp"
#include "maneuver/straight_support.hpp"

namespace hamilcar::test {
namespace {

TEST(CoastDown, FindsTheFilesDragAndRollingResistance) {
    VehicleDescription car = shipped_car();
    const Outcome outcome = driven_straight(coast_down(), car);
    EXPECT_NEAR(figure_named(outcome, "drag area"), 0.38 * 1.85, 0.005 * 0.703);
    // QSY1 times the unloaded radius at the wheel, so over the loaded one at the ground; toe and camber drag a little too.
    EXPECT_NEAR(figure_named(outcome, "rolling resistance"), 100 * 0.01 * 0.2948 / 0.28, 0.03);
    EXPECT_LT(figure_named(outcome, "largest difference of these"), 0.5);
    EXPECT_LT(std::abs(outcome.energy.residual()), 1e-6 * outcome.energy.exchanged);

    car.aerodynamics.drag_area *= 2;
    const Outcome blunt = driven_straight(coast_down(), car);
    EXPECT_NEAR(figure_named(blunt, "drag area"), 2 * figure_named(outcome, "drag area"), 0.01);
    EXPECT_NEAR(figure_named(blunt, "rolling resistance"), figure_named(outcome, "rolling resistance"), 0.02);
}

// The time from v1 to v0 under F0 + F2 v^2: m_r / sqrt(F0 F2) (atan(v1 sqrt(F2/F0)) - atan(v0 sqrt(F2/F0))).
TEST(CoastDown, TakesTheTimeOfTheClosedForm) {
    const Outcome outcome = driven_straight(coast_down(), shipped_car(), {{"from", 100}, {"to", 40}});
    const double rolling = 0.0105 * 1150 * standard_gravity, air = 0.5 * 1.2 * 0.703, root = std::sqrt(air / rolling);
    const double mass = 1150 + 4 * 0.85 / (0.288 * 0.288);
    const double expected = mass / std::sqrt(rolling * air) *
                            (std::atan(100 * kilometer_per_hour * root) - std::atan(40 * kilometer_per_hour * root));
    EXPECT_NEAR(figure_named(outcome, "coast-down time"), expected, 0.01 * expected);
}

// A racing car with its wings loses 10 km/h in a second: all the same it is timed from the speed that was asked for.
TEST(CoastDown, TimesAllSpeedsOfACarThatSlowsDownFast) {
    VehicleDescription car = shipped_car();
    car.aerodynamics.drag_area *= 8;
    const Outcome outcome = driven_straight(coast_down(), car);
    EXPECT_FALSE(std::isnan(figure_named(outcome, "resistance at 117.5 km/h")));
    const io::Curve& speed = outcome.charts.at(0).curves.at(0);
    const double lost = speed.y.front() - 120;  // before it is timed
    EXPECT_GT(lost, 10);
    EXPECT_LT(lost, 25);
    const double time = figure_named(outcome, "coast-down time");
    const auto at = [&](double level) {
        std::size_t i = 1;
        while (speed.y[i] > level) ++i;
        return speed.x[i - 1] +
               (speed.y[i - 1] - level) / (speed.y[i - 1] - speed.y[i]) * (speed.x[i] - speed.x[i - 1]);
    };
    EXPECT_NEAR(time, at(20) - at(120), 0.05);
    EXPECT_TRUE(outcome.notes.empty());
}

TEST(CoastDown, RefusesAndStops) {
    expect_bad_settings(coast_down(), {{"from", 60}, {"to", 50}});
    expect_bad_settings(coast_down(), {{"to", 500}});
    expect_interruptible(coast_down());
}

}  // namespace
}  // namespace hamilcar::test
