#include "hamilcar/analysis/pull.hpp"
#include "hamilcar/maneuver/test_run.hpp"
#include "maneuver/straight_support.hpp"

namespace hamilcar::test {
namespace {

constexpr double mile = 1609.344, radius = 0.288;  // [m]; rolling, of the driven wheels

// The car as one mass behind its gearbox, by hand: the engine's full load over its speed, a launch at the clutch's slip, a
// pause for each change of gear, at which the rotor hands the car the momentum that it loses.
struct LumpedCar {
    VehicleDescription car = shipped_car();
    const PowerUnitDescription& unit = car.power_units.front();
    const TorqueCurve& curve = std::get<EngineDescription>(unit.source).torque.back();
    double axle = car.differentials.front().ratio;

    double torque(double speed) const {
        for (std::size_t i = 1; i < curve.speed.size(); ++i) {
            if (speed > curve.speed[i]) continue;
            const double share = (speed - curve.speed[i - 1]) / (curve.speed[i] - curve.speed[i - 1]);
            return curve.torque[i - 1] + share * (curve.torque[i] - curve.torque[i - 1]);
        }
        return 0;
    }
    // Seconds to a speed or a distance, whichever comes first.
    double time_to(double speed, double distance) const {
        constexpr double launch = 3400 * std::numbers::pi / 30, step = 1e-3;  // of the rotor [rad/s]; [s]
        double v = 0, x = 0, t = 0, pause = 0;
        std::size_t gear = 0;
        while (v < speed && x < distance && t < 60) {
            const double wheels = 4 * 0.85 / (radius * radius);  // [kg]
            double ratio = unit.gearbox.ratios[gear] * axle, turns = v / radius * ratio;
            if (turns > unit.gearbox.upshift_speed && gear + 1 < unit.gearbox.ratios.size()) {
                ++gear, pause = unit.gearbox.shift_time;
                const double before = turns;
                ratio = unit.gearbox.ratios[gear] * axle, turns = v / radius * ratio;
                v += unit.inertia * (before - turns) * ratio * unit.gearbox.efficiency / radius / (1150 + wheels);
            }
            const bool slips = turns < launch;
            const double rotor = slips ? 0 : unit.inertia * std::pow(ratio / radius, 2);
            const double pull =
                pause > 0 ? 0 : torque(std::max(turns, launch)) * ratio * unit.gearbox.efficiency / radius;
            const double against = 0.0105 * 1150 * car.gravity + 0.5 * 1.2 * 0.703 * v * v;  // [N]
            v += step * (pull - against) / (1150 + wheels + (pause > 0 ? 0 : rotor));
            x += step * v, t += step, pause -= step;
        }
        return t;
    }
};

// What the lumped car has not is how the clutch takes hold at a launch and tires slip: a quarter of a second. From there on the two
// agree within two percent.
TEST(Acceleration, AgreesWithTheCarAsOneMass) {
    const Outcome outcome = driven_straight(acceleration(), shipped_car(), {{"elasticity_gear", 0}});
    const LumpedCar lumped;
    const auto to = [&](double speed) { return lumped.time_to(speed * kilometer_per_hour, 1e4); };
    const double launched = figure_named(outcome, "0 to 80 km/h"), later = figure_named(outcome, "0 to 140 km/h");
    EXPECT_GT(launched - to(80), 0);
    EXPECT_LT(launched - to(80), 0.25);
    EXPECT_NEAR(later - launched, to(140) - to(80), 0.02 * (to(140) - to(80)));
    EXPECT_NEAR(figure_named(outcome, "quarter mile"), lumped.time_to(1e3, mile / 4), 0.3);
    const double top = figure_named(outcome, "top speed");
    EXPECT_NEAR(top, figure_named(outcome, "top speed by the balance of forces"), 0.02 * top);
    EXPECT_LT(std::abs(outcome.energy.residual()), 1e-6 * outcome.energy.exchanged);
    EXPECT_LT(figure_named(outcome, "0 to 50 km/h"), figure_named(outcome, "0 to 60 mph"));
}

struct Times {
    double to_60_mph, to_100, quarter_mile;  // [s]
};
Times times_with(double load) {  // [kg]
    const Outcome outcome =
        driven_straight(acceleration(), shipped_car(), {{"load", load}, {"elasticity_gear", 0}, {"top_speed", 0}});
    return {figure_named(outcome, "0 to 60 mph"), figure_named(outcome, "0 to 100 km/h"),
            figure_named(outcome, "quarter mile")};
}

// Published for the 323i (W13, W14, W16 in vehicles/bmw_323i.toml): 8.1 s to 60 mph, 9.0 s to 100 km/h, about 16.5 s over the
// quarter mile. At the file's mass, curb weight and a driver, the car is faster than that: by 7, 11 and 5 percent.
TEST(Acceleration, IsFasterThanPublishedByTwelvePercentAtMost) {
    const Times times = times_with(0);
    EXPECT_LT(times.to_60_mph, 8.1);
    EXPECT_LT(times.to_100, 9.0);
    EXPECT_LT(times.quarter_mile, 16.5);
    EXPECT_GT(times.to_60_mph, 0.92 * 8.1);
    EXPECT_GT(times.to_100, 0.88 * 9.0);
    EXPECT_GT(times.quarter_mile, 0.95 * 16.5);
}

// How much a load matters; no evidence for the car, since it is not said what the published ones carried. 98 kg are an example:
// UN R140, a regulation of electronic stability control, loads its test cars with 168 kg, and the file has a driver of 70 kg.
TEST(Acceleration, TakesHalfASecondMoreWith98Kilograms) {
    const Times empty = times_with(0), loaded = times_with(98);
    EXPECT_NEAR(loaded.to_60_mph - empty.to_60_mph, 0.5, 0.05);
    EXPECT_NEAR(loaded.to_100 - empty.to_100, 0.54, 0.05);
    EXPECT_NEAR(loaded.quarter_mile - empty.quarter_mile, 0.4, 0.05);
    EXPECT_NEAR(loaded.to_60_mph, 8.1, 0.05 * 8.1);
    EXPECT_NEAR(loaded.to_100, 9.0, 0.05 * 9.0);
    EXPECT_NEAR(loaded.quarter_mile, 16.5, 0.05 * 16.5);
}

// From the balance in a gear: time = integral of m dv over pull less resistance.
TEST(Acceleration, ElasticityIsTheIntegralOverTheBalance) {
    const VehicleDescription car = shipped_car();
    const Outcome outcome = driven_straight(acceleration(), car, {{"distance", 50}, {"top_speed", 0}});
    const LumpedCar lumped;
    const double ratio = car.power_units[0].gearbox.ratios[3] * lumped.axle;
    const double mass = 1150 + 4 * 0.85 / (radius * radius) + 0.18 * std::pow(ratio / radius, 2);
    double time = 0;
    constexpr double step = 0.01;
    for (double v = 80 * kilometer_per_hour; v < 120 * kilometer_per_hour; v += step) {
        const double pull = lumped.torque(v / radius * ratio) * ratio * 0.9 / radius;
        time += step * mass / (pull - 0.0105 * 1150 * car.gravity - 0.5 * 1.2 * 0.703 * v * v);
    }
    EXPECT_NEAR(figure_named(outcome, "80 to 120 km/h in gear 4"), time, 0.02 * time);
}

TEST(Acceleration, SaysWhatItCouldNotReach) {
    const Outcome outcome =
        driven_straight(acceleration(), shipped_car(), {{"distance", 50}, {"top_speed", 0}, {"elasticity_to", 300}});
    EXPECT_TRUE(std::isnan(figure_named(outcome, "0 to 200 km/h")));
    ASSERT_FALSE(outcome.notes.empty());
    EXPECT_NE(outcome.notes.front().find("does not pull"), std::string::npos);
}

TEST(Acceleration, RefusesAndStops) {
    EXPECT_FALSE(acceleration().unsupported_reason(paper_car()).empty());
    expect_bad_settings(acceleration(), {{"elasticity_gear", 6}});
    expect_interruptible(acceleration());
}

}  // namespace
}  // namespace hamilcar::test
