#include "hamilcar/maneuver/circle_braking.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/straight.hpp"

namespace hamilcar::circle_braking {

namespace {

constexpr double calm_preview = 0.8;  // of the driver on the circle, where there is nothing to hurry for [s]
constexpr double rise = 0.1;          // of the pedal [s]
constexpr double afterwards = 2;      // that is driven on after the values are taken [s]
constexpr double slow = 3;            // the end of a run; sideslip means little below [m/s]
constexpr double lock_share =
    0.05;  // of its speed before, over that of the vehicle: a wheel that turns slower is locked [1]

double ground_speed(const History& h, std::size_t i) {
    return std::sqrt(h.speed[i] * h.speed[i] + h.lateral_velocity[i] * h.lateral_velocity[i]);
}

// Radius and center of the circle that the vehicle is on.
struct Circle {
    double radius, x, y;
};
Circle circle_at(const History& h, std::size_t i) {
    const double radius = ground_speed(h, i) / h.yaw_rate[i], course = h.yaw[i] + h.sideslip(i);
    return {radius, h.x[i] - radius * std::sin(course), h.y[i] + radius * std::cos(course)};
}

int locked_wheels(const History& h, std::size_t begin, std::size_t end) {
    int out = 0;
    for (const std::vector<double>& wheel : h.wheel_speed) {
        const double rolling = wheel[begin] / h.speed[begin];
        bool locks = false;
        for (std::size_t i = begin; i <= end; ++i) locks = locks || wheel[i] < lock_share * rolling * h.speed[i];
        out += locks;
    }
    return out;
}

}  // namespace

std::vector<std::array<double, 2>> circle(double radius) {
    constexpr int points = 90;
    std::vector<std::array<double, 2>> out;
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * std::numbers::pi * i / points;
        out.push_back({radius * std::sin(angle), radius * (1 - std::cos(angle))});
    }
    return out;
}

ScenarioDescription on_circle(const VehicleDescription& vehicle, const ManeuverOptions& options, double radius,
                              double speed) {
    ScenarioDescription scenario = driving_at(vehicle, options, speed, settling);
    scenario.name = "steady circle";
    const Point& center = vehicle.chassis.center_of_mass;
    scenario.initial.position = {-center[0], -center[1]};
    scenario.driver.steering =
        PathFollowerDescription{.path = {.points = circle(radius), .closed = true}, .preview_time = calm_preview};
    scenario.driver.speed->may_brake = false;
    return scenario;
}

ScenarioDescription braking(const ScenarioDescription& steady, const History& settled, double speed, double pedal) {
    ScenarioDescription scenario = steady;
    scenario.duration = settling + observed + afterwards;
    scenario.driver.steering.reset();
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = {.time = settled.time, .value = settled.steering_wheel};
    lift_foot(scenario, speed, settling);
    scenario.brake = {.time = {0, settling, settling + rise}, .value = {0, 0, pedal}};
    scenario.driver.ending = {.speed_below = slow, .earliest = settling};
    return scenario;
}

Steady steady(const History& h) {
    const std::size_t end = row_at(h, settling), begin = row_at(h, settling - 1);
    double speed = 0, yaw_rate = 0, angle = 0, least = endless, most = -endless;
    for (std::size_t i = begin; i <= end; ++i) {
        speed += ground_speed(h, i), yaw_rate += h.yaw_rate[i], angle += h.steering_wheel[i];
        least = std::min(least, h.yaw_rate[i]), most = std::max(most, h.yaw_rate[i]);
    }
    const double rows = static_cast<double>(end - begin + 1);
    return {.speed = speed / rows,
            .radius = speed / yaw_rate,
            .unrest = (most - least) * rows / yaw_rate,
            .steering_wheel = angle / rows};
}

std::vector<double> reference_yaw_rate(const History& h) {
    const Circle circle = circle_at(h, row_at(h, settling));
    std::vector<double> out;
    for (std::size_t i = 0; i < h.size(); ++i) out.push_back(ground_speed(h, i) / circle.radius);
    return out;
}

Run evaluated(const History& h) {
    Run run;
    const std::size_t begin = row_at(h, settling), end = row_at(h, settling + observed);
    if (h.time.back() < settling) return run;
    run.largest_sideslip_change = 0;
    for (std::size_t i = begin; i < h.size(); ++i) {
        if (h.speed[i] < slow) break;
        const double change = std::abs(h.sideslip(i) - h.sideslip(begin));
        run.largest_sideslip_change = std::max(run.largest_sideslip_change, change);
    }
    run.locked = locked_wheels(h, begin, end);
    if (h.time.back() < settling + observed) return run;
    const Circle circle = circle_at(h, begin);
    const double speed = ground_speed(h, end);
    run.deceleration = (ground_speed(h, begin) - speed) / observed;
    run.yaw_rate_ratio = h.yaw_rate[end] * circle.radius / speed;
    run.acceleration_ratio = h.lateral_acceleration[end] * circle.radius / (speed * speed);
    const double dx = h.x[end] - circle.x, dy = h.y[end] - circle.y;
    run.deviation = circle.radius - std::sqrt(dx * dx + dy * dy);
    run.sideslip_change = h.sideslip(end) - h.sideslip(begin);
    run.largest_yaw_acceleration = 0;
    constexpr std::size_t apart = 10;  // rows, between which the rate's rate is taken
    for (std::size_t i = begin; i + apart <= end; ++i) {
        const double rate = (h.yaw_rate[i + apart] - h.yaw_rate[i]) / (h.time[i + apart] - h.time[i]);
        run.largest_yaw_acceleration = std::max(run.largest_yaw_acceleration, std::abs(rate));
    }
    return run;
}

}  // namespace hamilcar::circle_braking
