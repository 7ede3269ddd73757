#include "hamilcar/maneuver/braking.hpp"
#include "maneuver/straight_support.hpp"

namespace hamilcar::test {
namespace {

TEST(StraightBraking, MeanFullyDevelopedDecelerationOfAConstantOneIsItself) {
    constexpr double deceleration = 7, initial = 30, rate = 100;  // [m/s^2], [m/s], [Hz]
    std::vector<double> speed, way;
    for (double t = 0; t <= initial / deceleration; t += 1 / rate) {
        speed.push_back(initial - deceleration * t), way.push_back(initial * t - deceleration * t * t / 2);
    }
    EXPECT_NEAR(braking::mean_fully_developed({speed, rate}, {way, rate}, initial), deceleration, 1e-3);
}

VehicleDescription without_valves(VehicleDescription car) {
    for (SuspensionDescription& corner : car.suspensions)
        corner.wheels[0].brake.valve_command = corner.wheels[0].brake.valve_slope = 1;
    return car;
}

// The paper's tire has one friction, sliding or not: locked on all wheels the car slows down with a = mu g + k v^2, and stops
// within log(1 + k v^2 / (mu g)) / (2 k). Over distance the mean of v^2 is that of its ends.
TEST(StraightBraking, LockedWheelsSlowDownWithTheFriction) {
    const VehicleDescription car = without_valves(paper_car());
    const double drag = 0.5 * 1.2 * 0.703 / 1150;  // k [1/m]
    for (const double friction : {1.0, 0.4}) {
        const Outcome outcome = driven_straight(straight_braking(), car, {{"friction", friction}});
        const double locked = friction * car.gravity;
        const double v = figure_named(outcome, "initial speed") * kilometer_per_hour;
        const double developed = locked + drag * v * v * (0.64 + 0.01) / 2;
        EXPECT_NEAR(figure_named(outcome, "MFDD"), developed, 0.01 * developed);
        const double way = std::log(1 + drag * v * v / locked) / (2 * drag);
        EXPECT_NEAR(figure_named(outcome, "stopping distance"), way, 1.5) << "with the pedal's way";
        EXPECT_LT(std::abs(outcome.energy.residual()), 1e-5 * outcome.energy.exchanged);
    }
}

TEST(StraightBraking, ALightFootFailsTheRegulation) {
    const Outcome hard = driven_straight(straight_braking(), shipped_car());
    const Outcome light = driven_straight(straight_braking(), shipped_car(), {{"pedal", 25}});
    ASSERT_TRUE(verdict_about(hard, "fully developed") && verdict_about(light, "fully developed"));
    EXPECT_TRUE(verdict_about(hard, "fully developed")->passed);
    EXPECT_TRUE(verdict_about(hard, "stopping distance")->passed);
    EXPECT_FALSE(verdict_about(light, "fully developed")->passed);
    EXPECT_FALSE(verdict_about(light, "stopping distance")->passed);
    EXPECT_FALSE(light.passed());
    // Brakes alone, no wheel locked: their torque over the rolling mass, and 0.3 m/s^2 at the most by air and tires.
    double torque = 0;
    for (const SuspensionDescription& corner : shipped_car().suspensions)
        torque += 0.25 * corner.wheels[0].brake.max_torque;
    const double expected = torque / 0.288 / 1190;  // rolling radius [m], mass with turning wheels [kg]
    EXPECT_NEAR(figure_named(light, "MFDD"), expected + 0.25, 0.15);
}

// Rear wheels lock first where their share of the brakes' force is above that of the load, which moves to the front.
TEST(StraightBraking, TheBalanceOfTheBrakesDecidesWhichAxleLocksFirst) {
    const auto rear_first = [](const VehicleDescription& car) {
        const Outcome outcome = driven_straight(straight_braking(), car);
        const Verdict* verdict = verdict_about(outcome, "slow pedal");
        EXPECT_TRUE(verdict);
        return verdict && !verdict->passed;
    };
    EXPECT_FALSE(rear_first(shipped_car())) << "behind their valve";
    VehicleDescription car = without_valves(shipped_car());  // 34 percent behind, where 24 of the load are at 1 g
    EXPECT_TRUE(rear_first(car));
    for (SuspensionDescription& corner : car.suspensions)
        corner.wheels[0].brake.max_torque = corner.wheels[0].wheel.center[0] > -1 ? 2050 : 450;
    EXPECT_FALSE(rear_first(car));  // 18 percent
}

// An axle counts with its second wheel, and what comes within a tenth of a second comes at once.
TEST(StraightBraking, OneLockedRearWheelIsNotALockedAxle) {
    const auto verdict_of = [](double front, double rear_left, double rear_right) {
        VehicleDescription car = without_valves(shipped_car());
        for (SuspensionDescription& corner : car.suspensions) {
            const Point& at = corner.wheels[0].wheel.center;
            corner.wheels[0].brake.max_torque = at[0] > -1 ? front : at[1] > 0 ? rear_left : rear_right;
        }
        const Outcome outcome = driven_straight(straight_braking(), car);
        const double difference = figure_named(outcome, "lock of the rear axles, slow pedal") -
                                  figure_named(outcome, "lock of the front axle, slow pedal");
        const Verdict* verdict = verdict_about(outcome, "slow pedal");
        return std::pair(difference, verdict && verdict->passed);
    };
    const auto [behind, passes] = verdict_of(2050, 1200, 450);
    EXPECT_TRUE(std::isnan(behind) || behind > 0);
    EXPECT_TRUE(passes);
    // Ever more torque behind: a little before the front axle is as good as at once, much before is not.
    int at_once = 0, before = 0;
    for (const double rear : {600, 650, 700, 750, 800, 900, 1000, 1200}) {
        const auto [difference, passed] = verdict_of(2050, rear, rear);
        EXPECT_EQ(passed, std::isnan(difference) || difference >= -0.1) << rear;
        at_once += passed && difference < 0, before += !passed;
    }
    EXPECT_GT(at_once, 0);
    EXPECT_GT(before, 0);
}

TEST(StraightBraking, RefusesAndStops) {
    VehicleDescription car = shipped_car();
    EXPECT_TRUE(straight_braking().unsupported_reason(car).empty());
    for (SuspensionDescription& corner : car.suspensions) corner.wheels[0].brake.max_torque = 0;
    EXPECT_FALSE(straight_braking().unsupported_reason(car).empty());
    expect_bad_settings(straight_braking(), {{"pedal", 150}});
    expect_bad_settings(straight_braking(), {{"peddle", 50}});
    expect_interruptible(straight_braking());
}

}  // namespace
}  // namespace hamilcar::test
