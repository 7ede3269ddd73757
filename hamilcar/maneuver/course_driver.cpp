#include "hamilcar/maneuver/course_driver.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar {

namespace {

constexpr double run_up_time = 1;   // before the first lane [s]
constexpr double min_run_up = 10;   // [m]
constexpr double run_out = 5;       // behind the last lane [m]
constexpr double lost = 6;          // beside the line: there is no way back to the course from there [m]
constexpr double slow_share = 0.3;  // of the entry speed that a foot off the throttle leaves on average, at least [1]
constexpr double held_share = 0.8;  // likewise where the speed is held [1]
constexpr double standing = 1;      // slower there is nothing to wait for [m/s]
constexpr double progress = 0.01;   // of the clearance, less of which an attempt teaches nothing [m]
constexpr double insight = 0.7;     // of the error that is taken back by the next attempt [1]
constexpr double largest_correction = 0.5;  // at once [m]
constexpr double wide = 6, fine = 1;        // that the error is averaged over, to both sides, and its steps [m]

}  // namespace

CourseDriver::CourseDriver(TestRun& test, const LaneChange& change, int speeds)
    : test_(test),
      change_(change),
      box_(footprint(test.vehicle)),
      course_(lane_course(change.lanes, box_)),
      speeds_(speeds) {}

CourseDrive CourseDriver::drive(double speed) {
    const double attempts = test_["attempts"];
    Line line = course_.line;
    std::optional<CourseDrive> best;
    for (int i = 0; i < attempts; ++i) {
        const auto part = [&](int n) { return (driven_ + n / attempts) / speeds_; };
        CourseDrive now = attempt(speed, line, {part(i), part(i + 1)});
        if (now.drive.breaks_off()) return now;
        line = corrected(std::move(line), now.drive.recording);
        const bool learned = !best || now.passage.clearance > best->passage.clearance + progress;
        const bool better = !best || now.passage.better_than(best->passage);
        if (best) test_.take_energy(better ? best->drive : now.drive);
        if (better) best = std::move(now);
        if (best->passage.clean() || best->passage.too_slow() || !learned) break;
    }
    ++driven_;
    return std::move(*best);
}

CourseDrive CourseDriver::attempt(double speed, const Line& line, Share share) const {
    const double v = speed * kilometer_per_hour;
    const double run_up = std::max(run_up_time * v, min_run_up) + box_.front;
    const double last = change_.lanes.back().end - rear_end(test_.vehicle) + run_out;
    ScenarioDescription scenario =
        driving_at(test_, v, (run_up + last) / ((change_.lift ? slow_share : held_share) * v));
    scenario.name = fmt::format("{} at {:g} km/h", change_.title, speed);
    const Point& center = test_.vehicle.chassis.center_of_mass;
    scenario.initial.position = {-run_up - center[0], change_.lanes.front().center() - center[1]};
    scenario.cones = course_.cones;
    scenario.driver.steering = PathFollowerDescription{.path = {.points = line}, .preview_time = test_["preview_time"]};
    scenario.driver.ending.path_offset = lost;
    scenario.driver.ending.station = last - line.front()[0];
    scenario.driver.ending.speed_below = standing;
    if (change_.lift) lift_foot(scenario, v, (*change_.lift - box_.front + run_up) / v);
    CourseDrive out{.speed = speed, .drive = test_.drive(scenario, {.share = share}), .passage = {}};
    out.passage = passage(test_.vehicle, change_.lanes, out.drive.recording);
    if (out.drive.stopped != Stopped::no) out.passage.complete = false;
    return out;
}

// The line that is aimed at, moved against what the vehicle was beside the easiest line, evened out along the way.
CourseDriver::Line CourseDriver::corrected(Line line, const Recording& recording) const {
    std::vector<double> x, y;
    for (const auto& point : course_.line) x.push_back(point[0]), y.push_back(point[1]);
    const auto driven_x = recording[channel::x].values, driven_y = recording[channel::y].values;
    for (auto& point : line) {
        double sum = 0, count = 0;
        for (double at = point[0] - wide; at <= point[0] + wide; at += fine) {
            if (at < driven_x.front() || at > driven_x.back()) continue;
            sum += interpolated(driven_x, driven_y, at) - interpolated(x, y, at), count += 1;
        }
        if (count > 0) point[1] -= insight * std::clamp(sum / count, -largest_correction, largest_correction);
    }
    return line;
}

}  // namespace hamilcar
