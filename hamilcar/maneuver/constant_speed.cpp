// ISO 4138, constant speed: the steering wheel is turned so slowly that all is nearly steady, until the vehicle cannot hold
// its speed or rolls too far. What lags behind lags evenly, which leaves slopes as they are.
#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steady_turn.hpp"

namespace hamilcar {

namespace {

constexpr double onset = 1;         // of the turning [s]
constexpr double window = 0.5;      // of a mean [s]
constexpr double lost_share = 0.9;  // of the speed, below which the test is over
constexpr double nearly = 0.95;     // of a lateral acceleration, from which it counts as reached
constexpr double settling = 3;      // after which all lags evenly [s]

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {speed_setting(vehicle, 100, 60),
            {"rate", "m/s^3", "of lateral acceleration, by linear theory", heavy ? 0.05 : 0.2, 0.02, 2},
            {"largest_lateral_acceleration", "m/s^2", "by linear theory, up to which the steering wheel turns",
             heavy ? 8.0 : 16.0, 1, 60},
            small_setting(vehicle)};
}

SignalDescription slow_turn(double rate, double largest) {
    const double turning = largest / rate;
    return {.time = {0, straight_ahead, straight_ahead + onset, straight_ahead + onset + turning},
            .value = {0, 0, 0.5 * rate * onset, 0.5 * rate * onset + largest},
            .interpolation = Interpolation::linear};
}

std::vector<SteadyTurn> states_of(const Recording& recording, double speed) {
    std::vector<SteadyTurn> out;
    for (double from = straight_ahead + onset + settling; from + window <= recording.end(); from += window) {
        const SteadyTurn state = steady_turn(recording, from, from + window);
        if (state.speed < steady_speed_share * speed || !state.settled()) break;
        out.push_back(state);
    }
    return out;
}

void judge_speed_of(TestRun& test, const std::vector<SteadyTurn>& states) {
    const double speed = test["speed"], small = test["small_lateral_acceleration"];
    double farthest = 0, reached = 0;
    for (const SteadyTurn& state : states) {
        reached = std::max(reached, state.lateral_acceleration());
        if (reached > small) break;
        farthest = std::max(farthest, std::abs(state.speed / speed - 1));
    }
    const bool there = reached >= nearly * small;
    test.verdict(fmt::format("speed within 3 percent up to {:g} m/s^2", small),
                 there && farthest <= 1 - steady_speed_share,
                 there ? fmt::format("{:.2g} percent", 100 * farthest)
                       : fmt::format("not reached: {:.2g} percent up to {:.2f} m/s^2", 100 * farthest, reached));
}

void run(TestRun& test) {
    const double speed = test["speed"], per_acceleration = angle_for(test.vehicle, speed, 1);
    const double wanted = std::abs(per_acceleration * test["largest_lateral_acceleration"]);
    const double rate = std::abs(per_acceleration * test["rate"]), lock = steering_lock(test.vehicle);
    if (wanted > lock) test.note("the steering wheel turns to its lock");
    ScenarioDescription scenario = steered_at(test, speed, slow_turn(rate, std::min(wanted, lock - rate * onset)));
    scenario.driver.ending = {.speed_below = lost_share * speed, .roll = steady_roll_limit};
    Drive drive = test.drive(scenario, {.interval = 0.02});
    const std::vector<SteadyTurn> states = states_of(drive.recording, speed);
    evaluate(test, states, 0.5);
    const auto speeds = drive.recording[channel::speed].values;
    const auto fast = [&](std::size_t row) { return speeds[row] >= steady_speed_share * speed; };
    test.figure("largest lateral acceleration", "m/s^2", largest_lateral_acceleration(drive.recording, fast),
                "over a second, at no less than 97 percent of the speed");
    judge_speed_of(test, states);
    finish_steady(test, drive, states.size());
}

}  // namespace

Maneuver constant_speed() {
    return {.name = "constant_speed",
            .title = "Steady-state circular driving, constant speed",
            .standard = "ISO 4138",
            .summary = "At one speed the steering wheel is turned very slowly until the vehicle turns no sharper.",
            .settings = settings,
            .unsupported_reason = needs_steering_and_drive,
            .run = run};
}

}  // namespace hamilcar
