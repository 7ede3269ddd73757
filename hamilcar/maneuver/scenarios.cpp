#include "hamilcar/maneuver/scenarios.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/analysis/pull.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

int gear_for(const VehicleDescription& vehicle, double speed) {
    if (vehicle.power_units.empty()) return 0;
    const PowerUnitDescription& unit = vehicle.power_units.front();
    const auto* engine = std::get_if<EngineDescription>(&unit.source);
    if (!engine) return 1;
    constexpr double lively = 2;  // times the idle speed
    const double shaft = output_speeds(vehicle).front() * speed;
    int gear = static_cast<int>(unit.gearbox.ratios.size());
    while (gear > 1 && unit.gearbox.ratios[static_cast<std::size_t>(gear) - 1] * shaft < lively * engine->idle_speed) {
        --gear;
    }
    return gear;
}

ScenarioDescription driving_at(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed,
                               double duration) {
    ScenarioDescription scenario;
    scenario.duration = duration;
    scenario.solver = options.solver;
    scenario.road = options.road;
    scenario.controllers_off = options.controllers_off;
    scenario.steering_mechanics = options.steering_mechanics;
    scenario.initial.velocity = {speed, 0, 0};
    scenario.driver.speed.emplace();
    scenario.driver.speed->speed = {.time = {0}, .value = {speed}, .interpolation = Interpolation::linear};
    if (!vehicle.power_units.empty()) scenario.driver.shifting = ShiftingDescription{.gear = gear_for(vehicle, speed)};
    return scenario;
}

ScenarioDescription driving_at(const TestRun& test, double speed, double duration) {
    ScenarioDescription scenario = driving_at(test.vehicle, test.options, speed, duration);
    scenario.name = test.maneuver_name;
    return scenario;
}

ScenarioDescription steered_at(const TestRun& test, double speed, SignalDescription angle) {
    ScenarioDescription scenario = driving_at(test, speed, angle.time.back());
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = std::move(angle);
    return scenario;
}

double steering_lock(const VehicleDescription& vehicle) {
    constexpr double hair = 0.99;               // of the lock, within what a scenario's check allows
    constexpr double no_stops = 1000 * degree;  // where a file says nothing of stops
    const Column column(vehicle.steering);
    if (!column.exists() || vehicle.steering.rack_travel <= 0) return no_stops;
    return hair * column.angle(vehicle.steering.rack_travel);
}

double angle_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration) {
    const SteadyHandling handling = steady_handling(vehicle, speed);
    return lateral_acceleration / (handling.lateral_acceleration_gain * handling.rack_per_angle);
}

SignalDescription turned(const std::vector<std::array<double, 2>>& corners) {
    constexpr double fine = 0.01;  // [s]
    SignalDescription out;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
        const auto [from, start] = corners[i];
        const auto [to, end] = corners[i + 1];
        const int parts = start == end ? 1 : std::max(1, static_cast<int>(std::ceil((to - from) / fine)));
        for (int k = 0; k < parts; ++k) {
            const double share = static_cast<double>(k) / parts;
            out.time.push_back(from + share * (to - from)), out.value.push_back(start + share * (end - start));
        }
    }
    out.time.push_back(corners.back()[0]), out.value.push_back(corners.back()[1]);
    return out;
}

SignalDescription tabulated(const std::function<double(double)>& angle, double duration) {
    constexpr double spacing = 0.01;  // [s]
    SignalDescription out;
    const auto points = static_cast<std::size_t>(std::lround(duration / spacing));
    for (std::size_t i = 0; i <= points; ++i) {
        out.time.push_back(static_cast<double>(i) * spacing);
        out.value.push_back(angle(out.time.back()));
    }
    return out;
}

void lift_foot(ScenarioDescription& scenario, double speed, double time, double within) {
    scenario.driver.speed->may_brake = false;
    scenario.driver.speed->speed = {
        .time = {0, time, time + within}, .value = {speed, speed, 0}, .interpolation = Interpolation::linear};
}

void follow_straight_line(ScenarioDescription& scenario, const VehicleDescription& vehicle, double length) {
    if (vehicle.steering.rack_per_revolution <= 0) return;
    constexpr double behind = 20, apart = 50;  // points of the line [m]
    scenario.driver.steering.emplace();
    auto& points = scenario.driver.steering->path.points;
    for (double x = -behind; x < length + apart; x += apart) points.push_back({x, 0});
}

std::vector<std::array<double, 2>> circle(double radius, int points) {
    std::vector<std::array<double, 2>> out;
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * std::numbers::pi * i / points;
        out.push_back({radius * std::sin(angle), radius * (1 - std::cos(angle))});
    }
    return out;
}

}  // namespace hamilcar
