#include "hamilcar/maneuver/course_driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hamilcar {

namespace {

constexpr double run_up_time = 1;    // before the first lane [s]
constexpr double least_run_up = 10;  // [m]
constexpr double run_out = 5;        // behind the last lane [m]
constexpr double lost = 6;           // beside the line: nobody comes back to the course from there [m]
constexpr double slow_share = 0.3;   // of the entry speed that a foot off the throttle leaves on average, at least [1]
constexpr double held_share = 0.8;   // likewise where the speed is held [1]
constexpr double standing = 1;       // slower there is nothing to wait for [m/s]
constexpr double progress = 0.01;    // of the clearance, less of which an attempt teaches nothing [m]
constexpr double insight = 0.7;      // of the error that is taken back by the next attempt [1]
constexpr double largest_correction = 0.5;  // at once [m]
constexpr double wide = 6, fine = 1;        // that the error is averaged over, to both sides, and its steps [m]

// Of a value over x, at any x; x increases, but for a car that has lost its way.
double over(const std::vector<double>& x, const std::vector<double>& value, double at) {
    const auto next = std::ranges::lower_bound(x, at);
    if (next == x.begin()) return value.front();
    if (next == x.end()) return value.back();
    const auto i = static_cast<std::size_t>(next - x.begin());
    return value[i - 1] + (value[i] - value[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

}  // namespace

CourseDriver::CourseDriver(const VehicleDescription& vehicle, const LaneChange& change, const Settings& settings,
                           const ManeuverOptions& options, int speeds)
    : vehicle_(vehicle),
      change_(change),
      options_(options),
      box_(footprint(vehicle)),
      course_(lane_course(change.lanes, box_)),
      preview_(settings.at("preview_time")),
      attempts_(static_cast<int>(settings.at("attempts"))),
      speeds_(speeds) {}

CourseDrive CourseDriver::drive(double speed, bool film, Outcome& outcome) {
    Line line = course_.line;
    std::optional<CourseDrive> best;
    for (int i = 0; i < attempts_; ++i) {
        const auto part = [&](int n) { return (driven_ + n / static_cast<double>(attempts_)) / speeds_; };
        CourseDrive now = attempt(speed, line, film, share(options_, part(i), part(i + 1)));
        if (now.trial.breaks_off()) return now;
        line = corrected(std::move(line), now.trial.history);
        const bool learned = !best || now.passage.clearance > best->passage.clearance + progress;
        const bool better = !best || now.passage.better_than(best->passage);
        if (best) add_search_trial(outcome, better ? best->trial : now.trial);
        if (better) best = std::move(now);
        if (best->passage.clean() || best->passage.too_slow() || !learned) break;
    }
    ++driven_;
    return std::move(*best);
}

CourseDrive CourseDriver::attempt(double speed, const Line& line, bool film,
                                  std::function<bool(double)> keep_going) const {
    const double v = speed * kilometer_per_hour;
    const double run_up = std::max(run_up_time * v, least_run_up) + box_.front;
    const double last = change_.lanes.back().end - rear_end(vehicle_) + run_out;
    ScenarioDescription scenario =
        driving_at(vehicle_, options_, v, (run_up + last) / ((change_.lift ? slow_share : held_share) * v));
    scenario.name = fmt::format("{} at {:g} km/h", change_.title, speed);
    const Point& center = vehicle_.chassis.center_of_mass;
    scenario.initial.position = {-run_up - center[0], change_.lanes.front().center() - center[1]};
    scenario.cones = course_.cones;
    scenario.driver.steering = PathFollowerDescription{.path = {.points = line}, .preview_time = preview_};
    scenario.driver.ending.path_offset = lost;
    scenario.driver.ending.station = last - line.front()[0];
    scenario.driver.ending.speed_below = standing;
    if (change_.lift) lift_foot(scenario, v, (*change_.lift - box_.front + run_up) / v);
    CourseDrive out{.speed = speed,
                    .trial = hamilcar::drive(vehicle_, scenario, {.film = film, .keep_going = std::move(keep_going)}),
                    .passage = {}};
    out.passage = passage(vehicle_, change_.lanes, out.trial.history);
    if (out.trial.stopped != Stopped::no) out.passage.complete = false;
    return out;
}

// The line that is aimed at, moved against what the vehicle was beside the easiest line, evened out along the way.
CourseDriver::Line CourseDriver::corrected(Line line, const History& h) const {
    std::vector<double> x, y;
    for (const auto& point : course_.line) x.push_back(point[0]), y.push_back(point[1]);
    for (auto& point : line) {
        double sum = 0, count = 0;
        for (double at = point[0] - wide; at <= point[0] + wide; at += fine) {
            if (at < h.x.front() || at > h.x.back()) continue;
            sum += over(h.x, h.y, at) - over(x, y, at), count += 1;
        }
        if (count > 0) point[1] -= insight * std::clamp(sum / count, -largest_correction, largest_correction);
    }
    return line;
}

}  // namespace hamilcar
