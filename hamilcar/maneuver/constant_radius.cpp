// ISO 4138, constant radius: round one circle faster and faster, in steps of lateral acceleration with a rest on each, until
// the driver cannot hold the circle or the speed any more.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/steady_turn.hpp"

namespace hamilcar {

namespace {

constexpr double gentle = 0.25;         // acceleration from rest to rest: at the limit more upsets the car [m/s^2]
constexpr double shortest_ramp = 2;     // [s]
constexpr double window = 1;            // of a mean at the end of a rest [s]
constexpr double off_circle = 0.5;      // ISO 4138's tolerance [m]
constexpr double lost = 2;              // off the circle: the driver gives up [m]
constexpr double slow_share = 0.97;     // of the wanted speed; below it a rest is none: ISO 4138's 3 percent
constexpr double other_circle = 0.02;   // share of the curvature: a state so far off is not steady
constexpr double interval = 0.02;       // between rows [s]
constexpr double fallen = 30 * degree;  // roll

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    const bool heavy = is_heavy(vehicle);
    return {{"radius", "m", "of the circle of the center of mass", 100, 20, 1000},
            {"step", "m/s^2", "of lateral acceleration from one rest to the next, at small ones half of it",
             heavy ? 0.2 : 0.5, 0.05, 2},
            {"rest", "s", "at each speed; its last second counts", 6, 2, 30},
            {"largest_lateral_acceleration", "m/s^2", "up to which it is tried", heavy ? 6.0 : 14.0, 1, 60},
            {"small_lateral_acceleration", "m/s^2", "up to which gradients are fitted", heavy ? 1.0 : 3.0, 0.3, 10}};
}

PathDescription circle(double radius) {
    constexpr int points = 180;  // a spline through so many leaves its circle by less than a micrometer
    PathDescription path{.points = {}, .closed = true};
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * std::numbers::pi * i / points;
        path.points.push_back({radius * std::sin(angle), radius - radius * std::cos(angle)});
    }
    return path;
}

struct Plan {
    std::vector<double> speeds;
    Stairs stairs;
    double begun;  // when the driver has found the circle, and a trailer its angle: a quarter of it [s]
};
Plan plan(const Settings& chosen) {
    Plan out;
    const double radius = chosen.at("radius"), step = chosen.at("step");
    const double most = chosen.at("largest_lateral_acceleration");
    const double small = chosen.at("small_lateral_acceleration");
    for (double a = step / 2; a <= most * (1 + 1e-9); a += a < small ? step / 2 : step) {
        out.speeds.push_back(std::sqrt(radius * a));
    }
    const auto ramp = [&](std::size_t i) {
        return std::max(shortest_ramp, (out.speeds[i + 1] - out.speeds[i]) / gentle);
    };
    out.stairs = stairs(out.speeds, ramp, chosen.at("rest"));
    out.begun = std::numbers::pi / 2 * radius / out.speeds.front();
    delay(out.stairs, out.begun);
    return out;
}

ScenarioDescription round_the_circle(const VehicleDescription& vehicle, const Settings& chosen,
                                     const ManeuverOptions& options, const Plan& planned) {
    const double radius = chosen.at("radius"), first = planned.speeds.front();
    ScenarioDescription scenario = driving_at(vehicle, options, first, planned.stairs.rests.back());
    scenario.name = "constant_radius";
    const double ahead = vehicle.chassis.center_of_mass[0];
    scenario.initial.position = {-ahead, 0};
    scenario.initial.angular_velocity = {0, 0, first / radius};
    scenario.driver.steering.emplace();
    scenario.driver.steering->path = circle(radius);
    scenario.driver.speed->speed = planned.stairs.signal;
    if (scenario.driver.shifting) scenario.driver.shifting->gear = steady_gear(vehicle, radius);
    scenario.driver.ending = {.path_offset = lost, .roll = fallen, .earliest = planned.begun};
    return scenario;
}

double off(const History& history, double radius, std::size_t row) {
    return std::abs(std::hypot(history.x[row], history.y[row] - radius) - radius);
}

std::vector<SteadyTurn> rests_of(const History& history, const Plan& planned, double radius) {
    std::vector<SteadyTurn> out;
    for (std::size_t i = 0; i < planned.speeds.size() && planned.stairs.rests[i] <= history.time.back(); ++i) {
        const double end = planned.stairs.rests[i];
        const SteadyTurn rest = steady_turn(history, end - window, end);
        if (rest.speed < slow_share * planned.speeds[i] || off(history, radius, row_at(history, end)) > off_circle)
            break;
        if (std::abs(rest.curvature() * radius - 1) <= other_circle) out.push_back(rest);
    }
    return out;
}

Verdict held(const History& history, const Plan& planned, double radius, double small) {
    double farthest = 0;
    for (std::size_t i = row_at(history, planned.begun); i < history.size(); ++i) {
        if (history.speed[i] * history.speed[i] / radius > small) break;
        farthest = std::max(farthest, off(history, radius, i));
    }
    return {fmt::format("within {:.1f} m of the circle up to {:g} m/s^2", off_circle, small), farthest <= off_circle,
            fmt::format("{:.2f} m", farthest)};
}

Outcome drive_it(const VehicleDescription& vehicle, const Settings& chosen, const ManeuverOptions& options) {
    Outcome outcome;
    const double radius = chosen.at("radius"), small = chosen.at("small_lateral_acceleration");
    const Plan planned = plan(chosen);
    Trial trial = drive_share(vehicle, round_the_circle(vehicle, chosen, options, planned), options, interval);
    const std::vector<SteadyTurn> rests = rests_of(trial.history, planned, radius);
    const double largest = largest_lateral_acceleration(
        trial.history, [&](std::size_t row) { return off(trial.history, radius, row) <= off_circle; });
    evaluate({.geometry = turning_geometry(vehicle),
              .small = small,
              .fixed_wheel = false,
              .half_width = 1.2 * chosen.at("step")},
             rests, outcome);
    outcome.figures.push_back(
        {"largest lateral acceleration", "m/s^2", "that was held on the circle for a second", largest});
    outcome.verdicts.push_back(held(trial.history, planned, radius, small));
    outcome.course.line = circle(radius).points;
    finish_steady(outcome, std::move(trial), rests.size());
    return outcome;
}

}  // namespace

Maneuver constant_radius() {
    return {
        .name = "constant_radius",
        .title = "Steady-state circular driving, constant radius",
        .standard = "ISO 4138",
        .summary = "The driver follows a circle and goes faster in steps until the vehicle cannot hold it any more.",
        .settings = settings,
        .obstacle = needs_steering_and_drive,
        .drive = drive_it,
        .course = [](const VehicleDescription&, const Settings& chosen) {
            return Course{.cones = {}, .boundaries = {}, .line = circle(chosen.at("radius")).points};
        }};
}

}  // namespace hamilcar
