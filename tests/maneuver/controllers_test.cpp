// Each controller does what it is for, on whole cars, and its test fails without it: the standards' maneuvers with what the vehicle's
// file says, and with `controllers_off`.
#include <filesystem>
#include <set>

#include "hamilcar/maneuver/braking.hpp"
#include "maneuver/straight_support.hpp"
#include "support/fleet.hpp"
#include "support/tires.hpp"

namespace hamilcar::test {
namespace {

Outcome outcome_of(const Maneuver& maneuver, const VehicleDescription& car, const Settings& chosen,
                   const std::vector<std::string>& off = {}) {
    ManeuverOptions options;
    options.keep_runs = false;
    options.controllers_off = off;
    return maneuver.drive(car, complete_settings(maneuver, car, chosen), options);
}

bool has(const VehicleDescription& car, const std::string& kind) {
    return std::ranges::find(car.controllers, kind, &ControllerDescription::kind) != car.controllers.end();
}

// On tires whose friction falls beyond a peak, as those of the shipped cars do not.
VehicleDescription on_magic_tires(VehicleDescription car) {
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionWheelDescription& wheel : suspension.wheels) wheel.tire = magic_tire();
    }
    return car;
}

// stability control
const std::vector<std::string> stable_cars{"bmw_e90_330i", "electric_hatchback", "hatchback", "offroader", "pickup"};

class StabilityControl : public testing::TestWithParam<std::string> {
protected:
    VehicleDescription car_ = shipped(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Shipped, StabilityControl, testing::ValuesIn(stable_cars),
                         [](const auto& vehicle) { return vehicle.param; });

TEST_P(StabilityControl, PassesFmvss126) {
    const Outcome outcome = outcome_of(sine_with_dwell(), car_, {});
    ASSERT_EQ(outcome.verdicts.size(), 3u);
    for (const Verdict& verdict : outcome.verdicts) EXPECT_TRUE(verdict.passed) << verdict.criterion << verdict.found;
    EXPECT_TRUE(outcome.passed()) << outcome.failed.value_or("");
}

TEST_P(StabilityControl, IsWhatPassesFmvss126) {
    const Outcome outcome = outcome_of(sine_with_dwell(), car_, {{"amplitudes", 3}}, {"esc"});
    ASSERT_EQ(outcome.verdicts.size(), 3u);
    EXPECT_FALSE(outcome.verdicts[0].passed) << outcome.verdicts[0].found;
    EXPECT_FALSE(outcome.verdicts[1].passed) << outcome.verdicts[1].found;
    EXPECT_TRUE(outcome.verdicts[2].passed) << outcome.verdicts[2].found;
}

// Heavier ones are beyond the standard's scope: they turn over in it, with the controller and without.
TEST(StabilityControl, IsTestedOnEveryCarOfTheStandardsScope) {
    constexpr double heaviest = 4536;  // [kg]
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(source_path("vehicles"))) {
        if (entry.path().extension() != ".toml") continue;
        const VehicleDescription car = io::read_vehicle(entry.path().string());
        if (has(car, "esc") && total_mass(car) < heaviest) found.insert(entry.path().stem().string());
    }
    EXPECT_EQ(found, std::set<std::string>(stable_cars.begin(), stable_cars.end()));
}

// anti-lock system
constexpr double largest_heading = 15;  // that UN R13 and R13-H let a vehicle turn while it brakes [deg]

class AntiLock : public testing::TestWithParam<std::string> {
protected:
    VehicleDescription car_ = shipped(GetParam());
    Outcome panic(const std::vector<std::string>& off) const {
        return outcome_of(split_braking(), car_, {{"pedal", 100}}, off);
    }
};
INSTANTIATE_TEST_SUITE_P(Shipped, AntiLock,
                         testing::Values("bmw_e90_330i", "electric_hatchback", "hatchback", "offroader", "pickup",
                                         "truck_semitrailer"),
                         [](const auto& vehicle) { return vehicle.param; });

TEST_P(AntiLock, HoldsTheLaneOnSplitFriction) {
    const Outcome outcome = panic({});
    EXPECT_TRUE(outcome.passed());
    for (const char* words : {"steering at most 120 deg", "steering at most 240 deg", "within a lane 3.5 m"}) {
        const Verdict* verdict = verdict_about(outcome, words);
        ASSERT_TRUE(verdict) << words;
        EXPECT_TRUE(verdict->passed) << words << ": " << verdict->found;
    }
    EXPECT_LT(std::abs(figure_named(outcome, "largest change of heading")), largest_heading);
}

TEST_P(AntiLock, IsWhatHoldsTheLane) {
    const Outcome outcome = panic({"all"});
    EXPECT_FALSE(outcome.passed());
    EXPECT_GT(std::abs(figure_named(outcome, "largest change of heading")), 2 * largest_heading);
}

TEST_P(AntiLock, StopsAsTheRegulationAsks) {
    const Outcome outcome = outcome_of(straight_braking(), car_, {});
    for (const Verdict& verdict : outcome.verdicts) EXPECT_TRUE(verdict.passed) << verdict.criterion << verdict.found;
}

// The way to standstill from 80 km/h on a road so slippery [m].
double stopping_distance(const VehicleDescription& car, double friction, const std::vector<std::string>& off) {
    const Outcome outcome = outcome_of(straight_braking(), car, {{"speed", 80}, {"friction", friction}}, off);
    EXPECT_FALSE(outcome.failed) << *outcome.failed;
    return figure_named(outcome, "stopping distance from the nominal speed");
}

TEST(AntiLock, StopsShorterThanLockedWheels) {
    const VehicleDescription car = on_magic_tires(shipped("bmw_e90_330i"));
    for (const double friction : {0.3, 1.0}) {
        const double held = stopping_distance(car, friction, {}), locked = stopping_distance(car, friction, {"all"});
        // Locked, these tires hold 0.61 (0.3) and 0.76 (1.0) of their peak.
        EXPECT_LT(held, 0.85 * locked) << "friction " << friction;
    }
}

// At 80 km/h the brake, then the steering wheel: the way to the left in 1.5 s of that [m].
double way_to_the_left(const VehicleDescription& car, const std::vector<std::string>& off) {
    ManeuverOptions options;
    options.keep_runs = false;
    options.controllers_off = off;
    ScenarioDescription scenario = driving_at(car, options, 80 * kilometer_per_hour, 4);
    scenario.driver.speed.reset();
    scenario.brake = {{1, 1.1}, {0, 1}, Interpolation::linear};
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = turned({{1.5, 0}, {1.7, 90 * degree}});
    scenario.duration = 3;
    const Drive made = drive(car, scenario, {.replay = false}, options);
    EXPECT_EQ(made.stopped, Stopped::no) << made.trouble;
    const Series y = made.recording[channel::y];
    return y.values.back() - interpolated(y, 1.5);
}

TEST(AntiLock, LetsTheDriverSteerWhileHeBrakes) {
    const VehicleDescription car = shipped("bmw_e90_330i");
    const double steered = way_to_the_left(car, {}), locked = way_to_the_left(car, {"all"});
    EXPECT_GT(steered, 2) << "past something as wide as a car";
    EXPECT_LT(std::abs(locked), 0.3) << "locked wheels slide straight on";
}

// traction control
struct Launch {
    double time;     // to 10 m/s [s]
    double slip;     // largest, of a driven wheel's tread over the car [m/s]
    double heading;  // largest change of it [deg]
};

// Full throttle in second gear from 2 m/s, on a road with that friction on the left and on the right.
Launch launched(const VehicleDescription& car, double left, double right, const std::vector<std::string>& off) {
    ManeuverOptions options;
    options.keep_runs = false;
    options.controllers_off = off;
    options.road.friction = left;
    if (right != left) {
        FrictionPatchDescription patch;
        patch.friction = right / left;
        patch.left = 0;
        options.road.patches.push_back(patch);
    }
    ScenarioDescription scenario = driving_at(car, options, 2, 60);
    scenario.driver.speed.reset();
    scenario.driver.shifting.reset();
    scenario.gear = {{0}, {2}, Interpolation::steps};
    scenario.throttle = {{0.5, 0.6}, {0, 1}, Interpolation::linear};
    scenario.driver.ending.speed_above = 10.2;
    scenario.steering_input = SteeringInput::none;
    follow_straight_line(scenario, car, 700);
    const Drive made = drive(car, scenario, {.replay = false}, options);
    EXPECT_EQ(made.stopped, Stopped::no) << made.trouble;
    const Recording& recording = made.recording;
    const Series speed = recording[channel::speed];
    const Series left_wheel = recording[channel::wheel_spin("rear_left")],
                 right_wheel = recording[channel::wheel_spin("rear_right")];
    constexpr double radius = 0.314;  // rolling, of this car [m]
    Launch out{.time = first_crossing(speed, 10, Crossing::rising).value_or(not_shown)};
    for (std::size_t i = 0; i < speed.values.size(); ++i) {
        const double faster = std::max(left_wheel.values[i], right_wheel.values[i]);
        out.slip = std::max(out.slip, faster * units::rpm * radius - speed.values[i]);
    }
    const auto turn = peak(recording[channel::heading], Extreme::largest);
    out.heading = turn ? std::abs(turn->value) : 0;
    return out;
}

TEST(TractionControl, AcceleratesOnIce) {
    const VehicleDescription car = on_magic_tires(shipped("bmw_e90_330i"));
    const Launch held = launched(car, 0.15, 0.15, {}), spinning = launched(car, 0.15, 0.15, {"all"});
    EXPECT_LT(held.time, 0.95 * spinning.time);
    EXPECT_LT(held.slip, 0.25 * spinning.slip);
    EXPECT_LT(held.heading, 5);
}

TEST(TractionControl, PassesTorqueToTheWheelThatHolds) {
    const VehicleDescription car = on_magic_tires(shipped("bmw_e90_330i"));
    const Launch held = launched(car, 1, 0.1, {}), spinning = launched(car, 1, 0.1, {"all"});
    EXPECT_LT(held.time, 0.7 * spinning.time);
    EXPECT_LT(held.slip, 0.25 * spinning.slip);
}

}  // namespace
}  // namespace hamilcar::test
