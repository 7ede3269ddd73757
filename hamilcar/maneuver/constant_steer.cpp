// ISO 4138, constant steering wheel angle: the wheel is held where it leads round a circle at a crawl, and the vehicle goes
// faster in steps with a rest on each. An understeering one runs wider, an oversteering one tighter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steady_turn.hpp"

namespace hamilcar {

namespace {

constexpr double gentle = 0.5;          // acceleration from rest to rest [m/s^2]
constexpr double shortest_ramp = 1;     // [s]
constexpr double window = 1;            // of a mean at the end of a rest [s]
constexpr double slow_share = 0.97;     // of the wanted speed; below it a rest is none: ISO 4138's 3 percent
constexpr double interval = 0.02;       // between rows [s]
constexpr double turning = 2;           // time for the steering wheel to its angle [s]
constexpr double fallen = 30 * degree;  // roll

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {{"radius", "m", "at a crawl, by linear theory", heavy ? 60.0 : 50.0, 10, 500},
            {"step", "m/s^2", "of lateral acceleration on that circle from one rest to the next", heavy ? 0.15 : 0.4,
             0.05, 2},
            {"rest", "s", "at each speed; its last second counts", 6, 2, 30},
            {"largest_speed", "km/h", "up to which it is tried", heavy ? 70.0 : 100.0, 20, 250},
            {"small_lateral_acceleration", "m/s^2", "up to which gradients are fitted", heavy ? 1.0 : 3.0, 0.3, 10}};
}

std::vector<double> speeds_of(const Settings& chosen) {
    std::vector<double> out;
    const double radius = chosen.at("radius"), step = chosen.at("step");
    const double fastest = chosen.at("largest_speed") * kilometer_per_hour;
    for (double a = step; std::sqrt(radius * a) <= fastest; a += step) out.push_back(std::sqrt(radius * a));
    return out;
}

// The first rest is longer: the steering wheel has to be turned before, and a trailer to find its angle within a quarter of the
// circle.
Stairs plan(const std::vector<double>& speeds, double radius, double rest) {
    const auto ramp = [&](std::size_t i) { return std::max(shortest_ramp, (speeds[i + 1] - speeds[i]) / gentle); };
    Stairs out = stairs(speeds, ramp, rest);
    delay(out, turning + std::numbers::pi / 2 * radius / speeds.front());
    return out;
}

std::vector<SteadyTurn> rests_of(const History& history, const std::vector<double>& speeds, const Stairs& planned) {
    std::vector<SteadyTurn> out;
    for (std::size_t i = 0; i < speeds.size() && planned.rests[i] <= history.time.back(); ++i) {
        const SteadyTurn rest = steady_turn(history, planned.rests[i] - window, planned.rests[i]);
        if (rest.speed < slow_share * speeds[i] || !rest.settled()) break;
        out.push_back(rest);
    }
    return out;
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double small = chosen.at("small_lateral_acceleration"), lock = steering_lock(vehicle);
    const TurningGeometry geometry = turning_geometry(vehicle);
    double angle = geometry.angle_per_curvature() / chosen.at("radius");
    if (angle > lock) {
        outcome.notes.push_back(fmt::format("the steering wheel stands at its lock: the circle is one of {:.1f} m",
                                            geometry.angle_per_curvature() / lock));
        angle = lock;
    }
    const std::vector<double> speeds = speeds_of(chosen);
    if (speeds.empty()) {
        outcome.failed = "the largest speed is below that of the first step";
        return outcome;
    }
    const Stairs planned = plan(speeds, chosen.at("radius"), chosen.at("rest"));
    ScenarioDescription scenario = driving_at(vehicle, options, speeds.front(), planned.rests.back());
    scenario.name = "constant_steer";
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = {.time = {0, turning}, .value = {0, angle}};
    scenario.driver.speed->speed = planned.signal;
    if (scenario.driver.shifting) scenario.driver.shifting->gear = steady_gear(vehicle, chosen.at("radius"));
    scenario.driver.ending.roll = fallen;
    Trial trial = drive_share(vehicle, scenario, options, interval);
    const std::vector<SteadyTurn> rests = rests_of(trial.history, speeds, planned);
    evaluate({.geometry = geometry, .small = small, .fixed_wheel = true, .half_width = 1.2 * chosen.at("step")}, rests,
             outcome);
    const double until = rests.empty() ? 0 : rests.back().time + window / 2;
    outcome.figures.push_back({"largest lateral acceleration", "m/s^2", "over a second, up to the last steady state",
                               largest_lateral_acceleration(
                                   trial.history, [&](std::size_t row) { return trial.history.time[row] <= until; })});
    outcome.figures.push_back({"steering wheel angle", "deg", "that was held", angle / degree});
    finish_steady(outcome, std::move(trial), rests.size());
    return outcome;
}

}  // namespace

Maneuver constant_steer() {
    return {.name = "constant_steer",
            .title = "Steady-state circular driving, constant steering wheel angle",
            .standard = "ISO 4138",
            .summary = "The steering wheel is held and the vehicle goes faster in steps: it runs wider or tighter.",
            .settings = settings,
            .obstacle = needs_steering_and_drive,
            .drive = drive_it,
            .course = [](const VehicleDescription&, const Settings&) { return Course{}; }};
}

}  // namespace hamilcar
