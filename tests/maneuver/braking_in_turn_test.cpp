// ISO 7975: the values against closed forms for motions put together by hand, and the car against its linear theory.

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/maneuver/circle_braking.hpp"
#include "hamilcar/steering/column.hpp"
#include "lateral_tests.hpp"
#include "support/recording.hpp"

namespace hamilcar {
namespace {

const Maneuver maneuver = braking_in_turn();

using test::figure;

Outcome outcome_of(const VehicleDescription& car, const Settings& chosen) {
    return test::driven(maneuver, car, chosen);
}

// A point that brakes with `deceleration` from the settled circle on and turns `sharper` times as fast as the circle asks.
// Its only wheel locks at an instant [s].
Recording made(double radius, double speed, double deceleration, double sharper, double locks = 1e9) {
    const std::vector<std::string> channels{channel::x,
                                            channel::y,
                                            channel::heading,
                                            channel::speed,
                                            channel::sideslip,
                                            channel::lateral_speed,
                                            channel::yaw_rate,
                                            channel::lateral_acceleration,
                                            channel::wheel_spin("wheel")};
    const double rate = 1000;
    double x = 0, y = 0, yaw = 0;
    const int rows = static_cast<int>((circle_braking::settling + 1.5) * rate) + 1;
    return test::recorded(channels, test::instants(rate, rows), [&](double time) {
        const double braked = std::max(time - circle_braking::settling, 0.0), v = speed - deceleration * braked;
        const double turn = v / radius * (braked > 0 ? sharper : 1.0), spin = time > locks ? 0 : v / 0.3;
        const std::vector<double> row{x, y, yaw / degree, v, 0, 0, turn / degree, v * turn, spin};
        x += std::cos(yaw + 0.5 * turn / rate) * v / rate, y += std::sin(yaw + 0.5 * turn / rate) * v / rate;
        yaw += turn / rate;
        return row;
    });
}

circle_braking::Run evaluated(const Recording& recording) {
    return circle_braking::evaluated(recording, {"wheel"});
}

TEST(CircleBraking, APointThatKeepsToItsCircleHasRatiosOfOne) {
    const auto run = evaluated(made(100, 22, 4, 1));
    EXPECT_NEAR(run.deceleration, 4, 1e-9);
    EXPECT_NEAR(run.yaw_rate_ratio, 1, 1e-9);
    EXPECT_NEAR(run.acceleration_ratio, 1, 1e-9);
    EXPECT_NEAR(run.deviation, 0, 1e-3);
    EXPECT_EQ(run.locked, 0);
}

// Sharper by a share s, a point leaves the circle by s (d/R) d / 2, d the way driven, to the first order.
TEST(CircleBraking, APointThatTurnsInComesInside) {
    const auto run = evaluated(made(100, 22, 4, 1.1));
    const double way = 22 - 2;
    EXPECT_NEAR(run.yaw_rate_ratio, 1.1, 1e-9);
    EXPECT_NEAR(run.acceleration_ratio, 1.1, 1e-9);
    EXPECT_NEAR(run.deviation, 0.1 * way * way / 200, 0.01);
    EXPECT_LT(evaluated(made(100, 22, 4, 0.9)).deviation, -0.1);
}

TEST(CircleBraking, SeesALockedWheel) {
    EXPECT_EQ(evaluated(made(100, 22, 4, 1, 10.5)).locked, 1);
}

TEST(BrakingInTurn, TheSteadyCircleIsThatOfTheOperatingPoint) {
    const VehicleDescription car = test::shipped_car();
    const Outcome outcome = outcome_of(car, {{"deceleration", 2}});
    EXPECT_NEAR(figure(outcome, "radius"), 100, 1);
    EXPECT_NEAR(figure(outcome, "lateral acceleration"), 5, 0.1);
    VehicleDescription alone = car;
    alone.power_units.clear(), alone.differentials.clear();
    const OperatingPoint at = Linearizer(alone).operating_point({.speed = std::sqrt(500.0), .lateral_acceleration = 5});
    ASSERT_TRUE(at.found) << at.problem;
    const double angle = Column(car.steering).angle(at.input.rack.displacement) * 180 / std::numbers::pi;
    EXPECT_NEAR(figure(outcome, "steering wheel angle"), angle, 0.03 * angle);
}

// Load goes from the rear axle to the front, and the engine brakes the rear wheels besides: the car turns in.
TEST(BrakingInTurn, TurnsInUntilWheelsLock) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"deceleration", 12}, {"step", 2}});
    EXPECT_FALSE(outcome.failed);
    EXPECT_GT(figure(outcome, "yaw rate ratio"), 1);
    EXPECT_GT(figure(outcome, "path deviation"), 0);
    EXPECT_GT(figure(outcome, "deceleration with locked wheels"), 4);
    EXPECT_LT(std::abs(outcome.energy.residual()), 1e-3 * outcome.energy.exchanged);
}

// On a slippery circle the car runs wide: the farthest deviation is the most negative one.
TEST(BrakingInTurn, TheLargestDeviationIsTheFarthestEitherWay) {
    ManeuverOptions options;
    options.keep_runs = false, options.road.friction = 0.5;
    const VehicleDescription car = test::shipped_car();
    const Settings chosen{{"lateral_acceleration", 4}, {"least_deceleration", 4}};
    const Outcome outcome = maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
    const auto values = [&](const std::string& title) {
        return std::ranges::find(outcome.charts, title, &io::Chart::title)->curves.at(0).y;
    };
    const std::vector<double> deviation = values("Path deviation after 1 s"),
                              ratio = values("Yaw rate ratio after 1 s");
    ASSERT_GE(deviation.size(), 2u);
    EXPECT_LT(std::ranges::max(deviation), 0);
    EXPECT_EQ(figure(outcome, "largest path deviation"), std::ranges::min(deviation));
    for (const double one : ratio) {
        EXPECT_LE(std::abs(one - 1), std::abs(figure(outcome, "extreme yaw rate ratio") - 1));
    }
    EXPECT_TRUE(std::ranges::count(ratio, figure(outcome, "extreme yaw rate ratio")));
}

TEST(BrakingInTurn, SaysWhatCannotBeDriven) {
    const Outcome outcome = outcome_of(test::shipped_car(), {{"lateral_acceleration", 12}, {"deceleration", 2}});
    EXPECT_TRUE(outcome.failed || !outcome.notes.empty());
    EXPECT_THROW(outcome_of(test::shipped_car(), {{"least_deceleration", 5}, {"deceleration", 3}}), io::Error);
    EXPECT_THROW(outcome_of(test::shipped_car(), {{"radius", 1}}), io::Error);
}

}  // namespace
}  // namespace hamilcar
