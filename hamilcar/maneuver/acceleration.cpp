// From rest with the pedal down, the driver shifting: times to speeds and over distances as road tests quote them, without
// a rollout: the clock starts when the vehicle begins to move. Then the pull in one gear, and how fast it goes at last
// (DIN 70020-3).
#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/pull.hpp"
#include "hamilcar/maneuver/braking.hpp"
#include "hamilcar/maneuver/catalog.hpp"

namespace hamilcar {

namespace {

constexpr double waiting = 0.5, pressing = 0.05;  // before the pedal goes down, and while it does [s]
constexpr double held = 0.5;                      // of the brake's pedal until then: a converter would creep [1]
constexpr double moving = 0.1;                    // the clock starts [m/s]
constexpr double mile = 1609.344;                 // [m]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    const int gears = highest_gear(vehicle);
    const double elastic = gears >= 3 && !heavy ? gears - 1 : 0;
    return {
        {"distance", "m", "from rest", 1000, 50, 10e3},
        {"load", "kg", "beyond the file's, at the center of mass: a passenger, instruments", 0, 0,
         heavy ? 20e3 : 1000.0},
        {"pedal", "%", "of its full travel", 100, 10, 100},
        {"friction", "", "of the road, times the tires' own", 1, 0.05, 1.5},
        {"elasticity_gear", "", "in which it pulls from one speed to another; 0: left out", elastic, 0,
         static_cast<double>(std::max(gears, 1)), SettingKind::whole},
        {"elasticity_from", "km/h", "that it pulls from", 80, 10, 250},
        {"elasticity_to", "km/h", "that it pulls to", 120, 20, 300},
        flag_setting("top_speed", "also find out how fast it goes", true),
    };
}

// Straight on with the pedal down after a moment, in a gear or shifting.
ScenarioDescription full_throttle(const TestRun& test, double speed, double duration) {
    ScenarioDescription scenario = driving_at(test, speed, duration);
    scenario.road.friction *= test["friction"];
    scenario.driver.speed.reset();
    scenario.driver.shifting = ShiftingDescription{};
    const double begins = speed > 0 ? 0 : waiting;
    scenario.throttle = {{begins, begins + pressing}, {0, test["pedal"]}, Interpolation::linear};
    if (speed == 0) scenario.brake = {{begins, begins + pressing}, {held, 0}, Interpolation::linear};
    constexpr double fastest = 100;  // [m/s]
    follow_straight_line(scenario, test.vehicle, std::max(fastest * duration, test["distance"]));
    return scenario;
}

// Drive torques make some axles stiffer than the default step stands.
Drive drive_as(const TestRun& test, ScenarioDescription scenario, std::string name, Share share) {
    scenario.name = std::move(name);
    return test.drive(scenario, {.share = share, .retry_with_finer_step = true});
}

struct Clock {
    const Recording& recording;
    std::vector<double> way = braking::distance(recording);
    Series speed = recording[channel::speed], driven = {way, recording.rate()};
    double start = first_crossing(speed, moving, Crossing::rising).value_or(not_shown);

    double to_speed(double wanted) const {
        return first_crossing(speed, wanted, Crossing::rising).value_or(not_shown) - start;
    }
    double to_distance(double wanted) const {
        const double from = interpolated(driven, start);
        return first_crossing(driven, wanted + from, Crossing::rising).value_or(not_shown) - start;
    }
    double speed_at(double elapsed) const {
        return std::isnan(elapsed) ? not_shown : interpolated(speed, start + elapsed) / kilometer_per_hour;
    }
};

void add_start_figures(TestRun& test, const Clock& clock) {
    const std::string from = "from the first movement";
    for (const double speed : {50.0, 80.0, 100.0, 120.0, 140.0, 160.0, 180.0, 200.0}) {
        test.figure(fmt::format("0 to {:.0f} km/h", speed), "s", clock.to_speed(speed * kilometer_per_hour), from);
        if (speed == 50.0) test.figure("0 to 60 mph", "s", clock.to_speed(60 * mile / 3600), from);
    }
    const double quarter = clock.to_distance(mile / 4), kilometer = clock.to_distance(1000);
    test.figure("quarter mile", "s", quarter, from + ", 402.3 m");
    test.figure("speed after the quarter mile", "km/h", clock.speed_at(quarter));
    test.figure("kilometer", "s", kilometer, from);
    test.figure("speed after the kilometer", "km/h", clock.speed_at(kilometer));
    const auto largest = peak(clock.recording[channel::longitudinal_acceleration], Extreme::highest);
    test.figure("largest acceleration", "m/s^2", largest ? largest->value : not_shown);
    test.figure("from the pedal to the movement", "s", clock.start - waiting, "not in the times above");
}

void add_start_charts(TestRun& test, const Clock& clock) {
    const Recording& recording = clock.recording;
    const std::vector<double> time = shifted(recording.time(), -clock.start);
    const std::vector<double> speed = scaled(clock.speed.values, 1 / kilometer_per_hour);
    const auto acceleration = recording[channel::longitudinal_acceleration].values;
    const auto rotor = recording[channel::rotor_speed(test.vehicle)].values;
    test.chart("Speed from rest", "time [s]", "speed [km/h]", {curve("", time, speed)});
    test.chart("Distance from rest", "time [s]", "distance [m]", {curve("", time, clock.way)});
    test.chart("Acceleration", "speed [km/h]", "acceleration [m/s^2]", {curve("", speed, acceleration)});
    test.chart("First power unit", "speed [km/h]", "rotor [1/min]", {curve("", speed, rotor)});
    test.chart("Gear", "time [s]", "gear", {curve("", time, recording[channel::gear].values)});
}

bool drive_from_rest(TestRun& test, Share share) {
    constexpr double slowest = 4, reserve = 30;  // mean speed, and what a launch takes at most [m/s], [s]
    const double way = test["distance"];
    ScenarioDescription scenario = full_throttle(test, 0, reserve + way / slowest);
    constexpr double beyond = 1;  // so that the last distance is passed [m]
    scenario.driver.ending.distance = way + beyond;
    Drive drive = drive_as(test, scenario, "from rest", share);
    const bool whole = test.take_whole(drive);
    const Clock clock{drive.recording};
    if (std::isnan(clock.start)) {
        if (whole) test.fail("it did not move");
        return false;
    }
    add_start_figures(test, clock);
    add_start_charts(test, clock);
    if (whole && clock.way.back() < way) {
        test.note("after {:.0f} s it had come {:.0f} m far", scenario.duration, clock.way.back());
    }
    return whole;
}

bool drive_elastically(TestRun& test, Share share) {
    const int gear = static_cast<int>(std::lround(test["elasticity_gear"]));
    const double from = test["elasticity_from"], to = test["elasticity_to"];
    constexpr double run_up = 0.95, longest = 90;  // share of the first speed that it starts at; [s]
    ScenarioDescription scenario = full_throttle(test, run_up * from, longest);
    scenario.driver.shifting->gear = gear;
    constexpr double beyond = 0.2;  // so that the last speed is passed [m/s]
    scenario.driver.ending.speed_above = to + beyond;
    const double typed_from = test.typed("elasticity_from"), typed_to = test.typed("elasticity_to");
    Drive drive =
        drive_as(test, scenario, fmt::format("{:g} to {:g} km/h in gear {}", typed_from, typed_to, gear), share);
    if (!test.take_whole(drive)) return false;
    const Series speed = drive.recording[channel::speed];
    const auto pulled = between_levels(speed, from, to, Crossing::rising);
    test.figure(fmt::format("{:.0f} to {:.0f} km/h in gear {}", typed_from, typed_to, gear), "s",
                pulled ? pulled->length() : not_shown, "with the pedal down");
    if (!pulled) {
        test.note("in gear {} it does not pull from {:.0f} to {:.0f} km/h: it came to {:.0f} km/h", gear, typed_from,
                  typed_to, speed.values.back() / kilometer_per_hour);
    }
    return true;
}

// Near the end the acceleration is a straight line over the speed, and the top speed where it is none.
double limit_of(const Series& speed, double end) {
    constexpr double spell = 10, apart = 0.5;  // of the run's end; between two speeds [s]
    std::vector<double> v, a;
    for (double t = end - spell; t < end - apart; t += apart) {
        const double v0 = interpolated(speed, t), v1 = interpolated(speed, t + apart);
        v.push_back((v0 + v1) / 2), a.push_back((v1 - v0) / apart);
    }
    constexpr double settled = 0.005;  // [m/s^2]
    if (std::abs(a.back()) < settled) return v.back();
    const FittedLine line = fitted_line(v, a);
    return line.slope < 0 ? -line.intercept / line.slope : not_shown;
}

void drive_fast(TestRun& test, Share share) {
    const auto balance = fastest(test.vehicle);
    if (!balance) return;
    constexpr double long_enough = 30;  // [s]
    constexpr double below = 0.98;      // of the balance, that it starts at
    ScenarioDescription scenario = full_throttle(test, below * balance->speed, long_enough);
    scenario.driver.shifting->gear = balance->gear;
    Drive drive = drive_as(test, scenario, "top speed", share);
    if (!test.take_whole(drive)) return;
    const double limit = limit_of(drive.recording[channel::speed], drive.recording.end());
    test.figure("top speed", "km/h", limit / kilometer_per_hour, fmt::format("in gear {}", balance->gear));
    test.figure("top speed by the balance of forces", "km/h", balance->speed / kilometer_per_hour,
                "pull against resistance, without tire slip");
}

void run(TestRun& test) {
    test.vehicle.chassis.mass += test["load"];
    constexpr double from_rest = 0.6, elastic = 0.75;  // of the progress, at their ends
    const bool pulls = test["elasticity_gear"] >= 1, fast = test.is_on("top_speed");
    bool go_on = drive_from_rest(test, {0, pulls || fast ? from_rest : 1});
    if (go_on && pulls) go_on = drive_elastically(test, {from_rest, fast ? elastic : 1});
    if (go_on && fast) drive_fast(test, {pulls ? elastic : from_rest, 1});
    // The last run counts for replay and plots: the start from rest.
    auto& runs = test.outcome.runs;
    if (go_on && !test.outcome.failed && !runs.empty()) std::rotate(runs.begin(), runs.begin() + 1, runs.end());
}

}  // namespace

Maneuver acceleration() {
    return {.name = "acceleration",
            .title = "Acceleration",
            .standard = "DIN 70020-3",
            .summary = "From rest with the pedal down, the pull in one gear, and the top speed.",
            .settings = settings,
            .unsupported_reason = needs_power_units,
            .run = run};
}

}  // namespace hamilcar
