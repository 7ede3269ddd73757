#include "hamilcar/maneuver/circle_braking.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/maneuver/braking.hpp"

namespace hamilcar::circle_braking {

namespace {

constexpr double calm_preview = 0.8;  // of the driver on the circle, where there is nothing to hurry for [s]
constexpr double rise = 0.1;          // of the pedal [s]
constexpr double afterwards = 2;      // that is driven on after the values are taken [s]
constexpr double slow = 3;            // the end of a run; sideslip means little below [m/s]
// Of a wheel's speed before, over that of the vehicle: a wheel that turns slower is locked [1].
constexpr double lock_share = 0.05;

// Radius and center of the circle that the vehicle is on when braking begins.
struct Circle {
    double radius, x, y;
};
Circle circle_of(const Recording& recording, std::span<const double> speed) {
    const auto now = [i = sample_at(recording[channel::x], settling), &recording](const char* channel) {
        return recording[channel].values[i];
    };
    const double radius = speed[sample_at(recording[channel::x], settling)] / (now(channel::yaw_rate) * degree);
    const double course = (now(channel::heading) + now(channel::sideslip)) * degree;
    return {radius, now(channel::x) - radius * std::sin(course), now(channel::y) + radius * std::cos(course)};
}

bool locks(std::span<const double> spin, std::span<const double> speed, std::size_t begin, std::size_t end) {
    const double rolling = spin[begin] / speed[begin];
    for (std::size_t i = begin; i <= end; ++i) {
        if (spin[i] < lock_share * rolling * speed[i]) return true;
    }
    return false;
}

double speed_of(const TestRun& test) {
    return std::sqrt(test["radius"] * test["lateral_acceleration"]);
}

void note_what_is_off(TestRun& test, const Steady& steady) {
    constexpr double tolerance = 0.03;  // of radius, lateral acceleration and steadiness [1]
    const double radius = test["radius"], wanted = test["lateral_acceleration"],
                 reached = steady.lateral_acceleration();
    const auto off = [](double found, double asked) { return std::abs(found - asked) > tolerance * asked; };
    if (!off(steady.radius, radius) && !off(reached, wanted) && steady.unrest <= tolerance) return;
    test.note(
        "before braking the vehicle drove a radius of {:.1f} m at {:.2f} m/s^2, with a yaw rate that varied by "
        "{:.1f} %; wanted: {:g} m at {:g} m/s^2",
        steady.radius, reached, 100 * steady.unrest, radius, wanted);
}

}  // namespace

std::vector<Setting> circle_settings(const VehicleDescription& vehicle, double default_acceleration) {
    constexpr double part = 0.43, step = 0.5;  // of what tips the vehicle over [1]; [m/s^2]
    const double bearable = rounded_down(part * tipping_acceleration(vehicle), step);
    return {
        {"radius", "m", "of the circle", 100, 20, 500},
        {"lateral_acceleration", "m/s^2", "on the steady circle", std::min(default_acceleration, bearable), 0.5, 12}};
}

std::optional<Recording> settle(TestRun& test, double share) {
    Drive drive = test.drive(on_circle(test), {.share = {0, share}, .replay = false});
    const bool reached = drive.stopped == Stopped::no && drive.recording.end() >= settling - 0.01;
    if (reached) note_what_is_off(test, steady(drive.recording));
    if (!test.take(drive)) return {};
    if (reached) return std::move(drive.recording);
    test.fail("the steady circle was not reached: {}", drive.trouble.empty() ? "the run ended early" : drive.trouble);
    return {};
}

ScenarioDescription on_circle(const TestRun& test) {
    const double radius = test["radius"];
    ScenarioDescription scenario = driving_at(test, speed_of(test), settling);
    scenario.name = "steady circle";
    const Point& center = test.vehicle.chassis.center_of_mass;
    scenario.initial.position = {-center[0], -center[1]};
    scenario.driver.steering =
        PathFollowerDescription{.path = {.points = circle(radius), .closed = true}, .preview_time = calm_preview};
    scenario.driver.speed->may_brake = false;
    return scenario;
}

ScenarioDescription braking(const TestRun& test, const Recording& settled, double pedal) {
    ScenarioDescription scenario = on_circle(test);
    scenario.duration = settling + observed + afterwards;
    scenario.driver.steering.reset();
    scenario.steering_input = SteeringInput::steering_wheel;
    scenario.steering = {.time = settled.time(), .value = scaled(settled[channel::steering_wheel].values, degree)};
    lift_foot(scenario, speed_of(test), settling);
    scenario.brake = {.time = {0, settling, settling + rise}, .value = {0, 0, pedal}};
    scenario.driver.ending = {.speed_below = slow, .earliest = settling};
    return scenario;
}

Steady steady(const Recording& recording) {
    const std::vector<double> over_ground = hamilcar::braking::ground_speed(recording);
    const auto last_second = [&](const Series& series) { return between(series, settling - 1, settling).values; };
    const auto yaw_rate = last_second(recording[channel::yaw_rate]);
    const double speed = mean(last_second({over_ground, recording.rate()})), turning = mean(yaw_rate);
    return {.speed = speed,
            .radius = speed / (turning * degree),
            .unrest = (std::ranges::max(yaw_rate) - std::ranges::min(yaw_rate)) / turning,
            .steering_wheel = mean(last_second(recording[channel::steering_wheel]))};
}

void add_steady_figures(TestRun& test, const Steady& steady) {
    test.figure("radius", "m", steady.radius, "of the steady circle");
    test.figure("lateral acceleration", "m/s^2", steady.lateral_acceleration(), "on the steady circle");
    test.figure("steering wheel angle", "deg", steady.steering_wheel, "held from then on");
}

Run evaluated(const Recording& recording, const std::vector<std::string>& wheels, double after) {
    Run run;
    const Series x = recording[channel::x];
    const auto y = recording[channel::y].values, along = recording[channel::speed].values,
               sideslip = recording[channel::sideslip].values, yaw_rate = recording[channel::yaw_rate].values;
    const std::size_t begin = sample_at(x, settling), end = sample_at(x, settling + after);
    if (recording.end() < settling) return run;
    run.largest_sideslip_change = 0;
    for (std::size_t i = begin; i < along.size() && along[i] >= slow; ++i) {
        run.largest_sideslip_change = std::max(run.largest_sideslip_change, std::abs(sideslip[i] - sideslip[begin]));
    }
    for (const std::string& wheel : wheels) {
        run.locked += locks(recording[channel::wheel_spin(wheel)].values, along, begin, end);
    }
    if (recording.end() < settling + after) return run;
    const std::vector<double> speed = hamilcar::braking::ground_speed(recording);
    const Circle circle = circle_of(recording, speed);
    run.deceleration = (speed[begin] - speed[end]) / after;
    run.yaw_rate_ratio = yaw_rate[end] * degree * circle.radius / speed[end];
    run.acceleration_ratio =
        recording[channel::lateral_acceleration].values[end] * circle.radius / (speed[end] * speed[end]);
    run.deviation = circle.radius - std::hypot(x.values[end] - circle.x, y[end] - circle.y);
    run.sideslip_change = sideslip[end] - sideslip[begin];
    run.largest_yaw_acceleration = 0;
    constexpr std::size_t apart = 10;  // rows, between which the rate's rate is taken
    for (std::size_t i = begin; i + apart <= end; ++i) {
        const double rate = (yaw_rate[i + apart] - yaw_rate[i]) / (recording.time()[i + apart] - recording.time()[i]);
        run.largest_yaw_acceleration = std::max(run.largest_yaw_acceleration, std::abs(rate));
    }
    return run;
}

void add_time_charts(TestRun& test, const std::string& while_what, const Drives& drives) {
    io::Chart yaw{.title = "Yaw rate " + while_what, .x_label = "time [s]", .y_label = "yaw rate [deg/s]"};
    io::Chart path{.title = "Path " + while_what, .x_label = "x [m]", .y_label = "y [m]", .equal_axes = true};
    // After the beginning only.
    const auto part = [](const Recording& drive, const std::string& label, std::span<const double> x,
                         std::span<const double> y) -> io::Curve {
        const std::size_t from = sample_at(drive[channel::x], settling);
        return {.label = label, .x = scaled(x.subspan(from), 1), .y = scaled(y.subspan(from), 1)};
    };
    for (const auto& [label, drive] : drives) {
        yaw.curves.push_back(part(*drive, label, drive->time(), (*drive)[channel::yaw_rate].values));
        path.curves.push_back(part(*drive, label, (*drive)[channel::x].values, (*drive)[channel::y].values));
    }
    if (!drives.empty()) {
        const Recording& last = *drives.back().second;
        const std::vector<double> speed = hamilcar::braking::ground_speed(last),
                                  reference = scaled(speed, 1 / (circle_of(last, speed).radius * degree));
        yaw.curves.push_back(part(last, "on the circle, last run", last.time(), reference));
    }
    io::Curve line{.label = "circle"};
    for (const auto& [x, y] : circle(test["radius"])) line.x.push_back(x), line.y.push_back(y);
    line.x.push_back(line.x.front()), line.y.push_back(line.y.front());
    path.curves.push_back(std::move(line));
    test.outcome.charts.push_back(std::move(yaw)), test.outcome.charts.push_back(std::move(path));
}

}  // namespace hamilcar::circle_braking
