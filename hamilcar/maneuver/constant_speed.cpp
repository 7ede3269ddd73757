// ISO 4138, constant speed: the steering wheel is turned so slowly that all is nearly steady, until the vehicle cannot hold
// its speed or rolls too far. What lags behind lags evenly, which leaves slopes as they are.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steady_turn.hpp"

namespace hamilcar {

namespace {

constexpr double onset = 1;             // of the turning [s]
constexpr double interval = 0.02;       // between rows [s]
constexpr double window = 0.5;          // of a mean [s]
constexpr double slow_share = 0.97;     // of the speed, below which a state is none: ISO 4138's 3 percent
constexpr double lost_share = 0.9;      // of the speed, below which the test is over
constexpr double fallen = 30 * degree;  // roll
constexpr double nearly = 0.95;         // of a lateral acceleration, from which it counts as reached
constexpr double settling = 3;          // after which all lags evenly [s]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {speed_setting(vehicle, 100, 60),
            {"rate", "m/s^3", "of lateral acceleration, by linear theory", heavy ? 0.05 : 0.2, 0.02, 2},
            {"largest_lateral_acceleration", "m/s^2", "by linear theory, up to which the steering wheel turns",
             heavy ? 8.0 : 16.0, 1, 60},
            {"small_lateral_acceleration", "m/s^2", "up to which gradients are fitted", heavy ? 1.0 : 3.0, 0.3, 10}};
}

SignalDescription slow_turn(double rate, double largest) {
    const double turning = largest / rate;
    return {.time = {0, straight_ahead, straight_ahead + onset, straight_ahead + onset + turning},
            .value = {0, 0, 0.5 * rate * onset, 0.5 * rate * onset + largest},
            .interpolation = Interpolation::linear};
}

std::vector<SteadyTurn> states_of(const History& history, double speed) {
    std::vector<SteadyTurn> out;
    for (double from = straight_ahead + onset + settling; from + window <= history.time.back(); from += window) {
        const SteadyTurn state = steady_turn(history, from, from + window);
        if (state.speed < slow_share * speed || !state.settled()) break;
        out.push_back(state);
    }
    return out;
}

Verdict held(const std::vector<SteadyTurn>& states, double speed, double small) {
    double farthest = 0, reached = 0;
    for (const SteadyTurn& state : states) {
        reached = std::max(reached, state.lateral_acceleration());
        if (reached > small) break;
        farthest = std::max(farthest, std::abs(state.speed / speed - 1));
    }
    const bool there = reached >= nearly * small;
    return {fmt::format("speed within 3 percent up to {:g} m/s^2", small), there && farthest <= 1 - slow_share,
            there ? fmt::format("{:.2g} percent", 100 * farthest)
                  : fmt::format("not reached: {:.2g} percent up to {:.2f} m/s^2", 100 * farthest, reached)};
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double speed = chosen.at("speed") * kilometer_per_hour, small = chosen.at("small_lateral_acceleration");
    const double per_acceleration = angle_for(vehicle, speed, 1);
    const double wanted = per_acceleration * chosen.at("largest_lateral_acceleration");
    const double rate = per_acceleration * chosen.at("rate"), lock = steering_lock(vehicle);
    if (std::abs(wanted) > lock) outcome.notes.push_back("the steering wheel turns to its lock");
    const double turned = std::min(std::abs(wanted), lock - std::abs(rate) * onset);
    ScenarioDescription scenario = steered_at(vehicle, options, speed, slow_turn(std::abs(rate), turned));
    scenario.name = "constant_speed";
    scenario.driver.ending = {.speed_below = lost_share * speed, .roll = fallen};
    Trial trial = drive_share(vehicle, scenario, options, interval);
    const History& history = trial.history;
    const std::vector<SteadyTurn> states = states_of(history, speed);
    evaluate({.geometry = turning_geometry(vehicle), .small = small, .fixed_wheel = false, .half_width = 0.5}, states,
             outcome);
    const auto fast = [&](std::size_t row) { return history.speed[row] >= slow_share * speed; };
    outcome.figures.push_back({"largest lateral acceleration", "m/s^2",
                               "over a second, at no less than 97 percent of the speed",
                               largest_lateral_acceleration(history, fast)});
    outcome.verdicts.push_back(held(states, speed, small));
    finish_steady(outcome, std::move(trial), states.size());
    return outcome;
}

}  // namespace

Maneuver constant_speed() {
    return {.name = "constant_speed",
            .title = "Steady-state circular driving, constant speed",
            .standard = "ISO 4138",
            .summary = "At one speed the steering wheel is turned very slowly until the vehicle turns no sharper.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
