// From rest with the pedal down, the driver shifting: times to speeds and over distances as road tests quote them, without
// a rollout: the clock starts when the vehicle begins to move. Then the pull in one gear, and how fast it goes at last
// (DIN 70020-3).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/pull.hpp"
#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar {

namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
constexpr double waiting = 0.5, pressing = 0.05;  // before the pedal goes down, and while it does [s]
constexpr double held = 0.5;                      // of the brake's pedal until then: a converter would creep [1]
constexpr double moving = 0.1;                    // the clock starts [m/s]
constexpr double mile = 1609.344;                 // [m]
constexpr double rpm = std::numbers::pi / 30;     // [rad/s]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = straight::is_heavy(vehicle);
    const int gears = straight::highest_gear(vehicle);
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
        {"top_speed", "", "1: also find out how fast it goes; 0: left out", 1, 0, 1, SettingKind::toggle},
    };
}

// Straight on with the pedal down after a moment, in a gear or shifting.
ScenarioDescription full_throttle(const VehicleDescription& vehicle, const ManeuverOptions& options,
                                  const Settings& chosen, double speed, double duration) {
    ScenarioDescription scenario = driving_at(vehicle, options, speed, duration);
    scenario.road.friction *= chosen.at("friction");
    scenario.driver.speed.reset();
    scenario.driver.shifting = ShiftingDescription{};
    const double begins = speed > 0 ? 0 : waiting;
    scenario.throttle = {{begins, begins + pressing}, {0, chosen.at("pedal") / 100}, Interpolation::linear};
    if (speed == 0) scenario.brake = {{begins, begins + pressing}, {held, 0}, Interpolation::linear};
    constexpr double fastest = 100;  // [m/s]
    straight::follow_straight_line(scenario, vehicle, std::max(fastest * duration, chosen.at("distance")));
    return scenario;
}

struct Clock {
    const History& history;
    std::vector<double> way = straight::distance(history);
    Series speed = straight::series(history, history.speed), driven = straight::series(history, way);
    double start = first_crossing(speed, moving, Crossing::rising).value_or(nowhere);

    double to_speed(double wanted) const {
        const auto at = first_crossing(speed, wanted, Crossing::rising);
        return at ? *at - start : nowhere;
    }
    double to_distance(double wanted) const {
        const auto at = first_crossing(driven, wanted + interpolated(driven, start), Crossing::rising);
        return at ? *at - start : nowhere;
    }
    double speed_at(double elapsed) const {
        return std::isnan(elapsed) ? nowhere : interpolated(speed, start + elapsed);
    }
};

void add_start_figures(Outcome& outcome, const Clock& clock) {
    const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning, double value) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    const std::string from = "from the first movement";
    for (const double speed : {50.0, 80.0, 100.0, 120.0, 140.0, 160.0, 180.0, 200.0}) {
        add(fmt::format("0 to {:.0f} km/h", speed), "s", from, clock.to_speed(speed * kilometer_per_hour));
        if (speed == 50.0) add("0 to 60 mph", "s", from, clock.to_speed(60 * mile / 3600));
    }
    const double quarter = clock.to_distance(mile / 4), kilometer = clock.to_distance(1000);
    add("quarter mile", "s", from + ", 402.3 m", quarter);
    add("speed after the quarter mile", "km/h", "", clock.speed_at(quarter) / kilometer_per_hour);
    add("kilometer", "s", from, kilometer);
    add("speed after the kilometer", "km/h", "", clock.speed_at(kilometer) / kilometer_per_hour);
    const auto most = peak(straight::series(clock.history, clock.history.longitudinal_acceleration), Extreme::highest);
    add("largest acceleration", "m/s^2", "", most ? most->value : nowhere);
    add("from the pedal to the movement", "s", "not in the times above", clock.start - waiting);
}

void add_start_charts(Outcome& outcome, const Clock& clock) {
    const History& history = clock.history;
    const auto thinned = [](const std::vector<double>& values) { return straight::thinned(values); };
    std::vector<double> time(history.time);
    for (double& t : time) t -= clock.start;
    const std::vector<double> speed = straight::scaled(history.speed, 1 / kilometer_per_hour);
    io::Chart speeds{"Speed from rest", "time [s]", "speed [km/h]", {{"", thinned(time), thinned(speed)}}};
    io::Chart ways{"Distance from rest", "time [s]", "distance [m]", {{"", thinned(time), thinned(clock.way)}}};
    io::Chart pull{"Acceleration",
                   "speed [km/h]",
                   "acceleration [m/s^2]",
                   {{"", thinned(speed), thinned(history.longitudinal_acceleration)}}};
    io::Chart unit{"First power unit",
                   "speed [km/h]",
                   "rotor [1/min]",
                   {{"", thinned(speed), thinned(straight::scaled(history.unit_speed, 1 / rpm))}}};
    io::Chart gears{"Gear", "time [s]", "gear", {{"", thinned(time), thinned(history.gear)}}};
    for (auto* chart : {&speeds, &ways, &pull, &unit, &gears}) outcome.charts.push_back(std::move(*chart));
}

bool drive_from_rest(Outcome& outcome, const VehicleDescription& vehicle, const Settings& chosen,
                     const ManeuverOptions& options, double share) {
    constexpr double slowest = 4, reserve = 30;  // mean speed, and what a launch takes at most [m/s], [s]
    const double way = chosen.at("distance");
    ScenarioDescription scenario = full_throttle(vehicle, options, chosen, 0, reserve + way / slowest);
    scenario.name = "from rest";
    constexpr double beyond = 1;  // so that the last distance is passed [m]
    scenario.driver.ending.distance = way + beyond;
    Trial trial = straight::drive_again_finely(vehicle, scenario, straight::trial_options(options, 0, share));
    const bool whole = take_whole(outcome, trial);
    const Clock clock{trial.history};
    if (std::isnan(clock.start)) {
        if (whole) outcome.failed = "it did not move";
        return false;
    }
    add_start_figures(outcome, clock);
    add_start_charts(outcome, clock);
    if (whole && clock.way.back() < way) {
        outcome.notes.push_back(
            fmt::format("after {:.0f} s it had come {:.0f} m far", scenario.duration, clock.way.back()));
    }
    return whole;
}

bool drive_elastically(Outcome& outcome, const VehicleDescription& vehicle, const Settings& chosen,
                       const ManeuverOptions& options, double begin, double end) {
    const int gear = static_cast<int>(std::lround(chosen.at("elasticity_gear")));
    const double from = chosen.at("elasticity_from"), to = chosen.at("elasticity_to");
    constexpr double run_up = 0.95, longest = 90;  // share of the first speed that it starts at; [s]
    ScenarioDescription scenario = full_throttle(vehicle, options, chosen, run_up * from * kilometer_per_hour, longest);
    scenario.name = fmt::format("{:g} to {:g} km/h in gear {}", from, to, gear);
    scenario.driver.shifting->gear = gear;
    constexpr double beyond = 0.2;  // so that the last speed is passed [m/s]
    scenario.driver.ending.speed_above = to * kilometer_per_hour + beyond;
    Trial trial = straight::drive_again_finely(vehicle, scenario, straight::trial_options(options, begin, end));
    if (!take_whole(outcome, trial)) return false;
    const Series speed = straight::series(trial.history, trial.history.speed);
    const auto first = first_crossing(speed, from * kilometer_per_hour, Crossing::rising);
    const auto last = first_crossing(speed, to * kilometer_per_hour, Crossing::rising);
    const double time = first && last ? *last - *first : nowhere;
    outcome.figures.push_back(
        {fmt::format("{:.0f} to {:.0f} km/h in gear {}", from, to, gear), "s", "with the pedal down", time});
    if (std::isnan(time)) {
        outcome.notes.push_back(
            fmt::format("in gear {} it does not pull from {:.0f} to {:.0f} km/h: it came to {:.0f} km/h", gear, from,
                        to, trial.history.speed.back() / kilometer_per_hour));
    }
    return true;
}

// Near the end the acceleration is a straight line over the speed, and the top speed where it is none.
double limit_of(const History& history) {
    constexpr double spell = 10, apart = 0.5;  // of the run's end; between two speeds [s]
    const Series speed = straight::series(history, history.speed);
    std::vector<double> v, a;
    for (double t = history.time.back() - spell; t < history.time.back() - apart; t += apart) {
        const double v0 = interpolated(speed, t), v1 = interpolated(speed, t + apart);
        v.push_back((v0 + v1) / 2), a.push_back((v1 - v0) / apart);
    }
    constexpr double settled = 0.005;  // [m/s^2]
    if (std::abs(a.back()) < settled) return v.back();
    const FittedLine line = fitted_line(v, a);
    return line.slope < 0 ? -line.intercept / line.slope : nowhere;
}

bool drive_fast(Outcome& outcome, const VehicleDescription& vehicle, const Settings& chosen,
                const ManeuverOptions& options, double begin) {
    const auto balance = straight::fastest(vehicle);
    if (!balance) return true;
    constexpr double long_enough = 30;  // [s]
    constexpr double below = 0.98;      // of the balance, that it starts at
    ScenarioDescription scenario = full_throttle(vehicle, options, chosen, below * balance->speed, long_enough);
    scenario.name = "top speed";
    scenario.driver.shifting->gear = balance->gear;
    Trial trial = straight::drive_again_finely(vehicle, scenario, straight::trial_options(options, begin, 1));
    if (!take_whole(outcome, trial)) return false;
    outcome.figures.push_back(
        {"top speed", "km/h", fmt::format("in gear {}", balance->gear), limit_of(trial.history) / kilometer_per_hour});
    outcome.figures.push_back({"top speed by the balance of forces", "km/h",
                               "pull against resistance, without tire slip", balance->speed / kilometer_per_hour});
    return true;
}

Outcome drive_it(const VehicleDescription& described, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    VehicleDescription vehicle = described;
    vehicle.chassis.mass += chosen.at("load");
    constexpr double from_rest = 0.6, elastic = 0.75;  // of the progress, at their ends
    const bool pulls = chosen.at("elasticity_gear") >= 1, fast = chosen.at("top_speed") == 1;
    if (!drive_from_rest(outcome, vehicle, chosen, options, pulls || fast ? from_rest : 1)) return outcome;
    if (pulls && !drive_elastically(outcome, vehicle, chosen, options, from_rest, fast ? elastic : 1)) return outcome;
    if (fast && !drive_fast(outcome, vehicle, chosen, options, pulls ? elastic : from_rest)) return outcome;
    // The last run counts for film and plots: the start from rest.
    if (!outcome.runs.empty()) std::rotate(outcome.runs.begin(), outcome.runs.begin() + 1, outcome.runs.end());
    return outcome;
}

}  // namespace

Maneuver acceleration() {
    return {.name = "acceleration",
            .title = "Acceleration",
            .standard = "DIN 70020-3",
            .summary = "From rest with the pedal down, the pull in one gear, and the top speed.",
            .settings = settings,
            .obstacle = needs_power_units,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
