#include "hamilcar/live/course_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hamilcar::live {

namespace {

using GroundPoint = std::array<double, 2>;

constexpr double run_up = 80;          // from the start to the entry [m]
constexpr double max_offset = 15;      // from the line, beyond which the run is over [m]
constexpr double closing_ratio = 1.5;  // a line whose ends are closer than this times its first segment is closed [1]
constexpr std::size_t min_lap_points = 4;  // points

double distance(const GroundPoint& a, const GroundPoint& b) {
    return std::hypot(b[0] - a[0], b[1] - a[1]);
}

// Positive if the point is to the left of the line from `from` to `to`.
double cross(const GroundPoint& from, const GroundPoint& to, double x, double y) {
    return (to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0]);
}

// The course's line, or without one a straight line along x past all cones and boundaries.
PathDescription line_of(const Course& course) {
    PathDescription path{.points = course.line};
    if (path.points.empty()) {
        double first = std::numeric_limits<double>::infinity(), last = -first;
        const auto add = [&](const GroundPoint& spot) {
            first = std::min(first, spot[0]), last = std::max(last, spot[0]);
        };
        for (const GroundPoint& cone : course.cones) add(cone);
        for (const Gate& gate : course.boundaries) add(gate.from), add(gate.to);
        path.points = {{first, 0}, {last, 0}};
    }
    const std::vector<GroundPoint>& points = path.points;
    if (points.size() < min_lap_points) return path;
    path.closed = distance(points.back(), points.front()) <= closing_ratio * distance(points[0], points[1]);
    constexpr double same = 1e-3;  // [m]
    if (path.closed && distance(points.back(), points.front()) < same) path.points.pop_back();
    return path;
}

// The maneuver's own summary describes a test driven by the program; a person is judged by cones and boundaries only.
std::string task_summary(const Course& course, bool is_lap) {
    if (course.cones.empty() && course.boundaries.empty()) {
        return std::string(is_lap ? "One lap along the dashed line" : "Along the dashed line to its end") +
               ": time, speeds, lateral acceleration and deviation are measured; there is no pass or fail criterion.";
    }
    const char* criteria = course.cones.empty()        ? "no boundary may be crossed."
                           : course.boundaries.empty() ? "no cone may be hit."
                                                       : "no cone may be hit and no boundary crossed.";
    return std::string("Drive through the course to its end at a speed of your choice: ") + criteria;
}

}  // namespace

CourseJudge::CourseJudge(TestCourse course, const VehicleDescription& vehicle)
    : course_(std::move(course)),
      box_(footprint(vehicle)),
      path_(line_of(course_.course)),
      cones_(course_.course.cones.size()),
      crossed_(course_.course.boundaries.size()) {
    course_.summary = task_summary(course_.course, path_.closed());
    end_ = path_.length();
    double first = std::numeric_limits<double>::infinity(), last = -first;
    const auto add = [&](double station) { first = std::min(first, station), last = std::max(last, station); };
    for (const Gate& gate : course_.course.boundaries) {
        sides_.push_back(side_of(gate));
        add(sides_.back().begin), add(sides_.back().end);
    }
    for (const GroundPoint& cone : course_.course.cones) add(station_of(cone[0], cone[1]));
    if (!path_.closed() && last > first) entry_ = first, end_ = last;
    begin();
}

// Of the nearest point of the line, whatever its direction there.
double CourseJudge::station_of(double x, double y) const {
    const PathPlace one = path_.nearest_of_all(x, y, 0), other = path_.nearest_of_all(x, y, std::numbers::pi);
    return std::abs(one.offset) <= std::abs(other.offset) ? one.station : other.station;
}

CourseJudge::Side CourseJudge::side_of(const Gate& gate) const {
    const double from = station_of(gate.from[0], gate.from[1]), to = station_of(gate.to[0], gate.to[1]);
    const PathPoint beside = path_.at(0.5 * (from + to));
    const double turn = cross(gate.from, gate.to, beside.x, beside.y);
    return {gate, std::min(from, to), std::max(from, to), turn > 0 ? 1.0 : turn < 0 ? -1.0 : 0.0};
}

CourseJudge::Start CourseJudge::start() const {
    const PathPoint at = path_.at(entry_ - run_up);
    return {at.x, at.y, at.heading()};
}

void CourseJudge::begin() {
    run_ = {};
    std::ranges::fill(cones_, 0);
    std::ranges::fill(crossed_, 0);
    has_previous_ = false;
    station_ = entry_ - run_up;
    last_ = {};
}

void CourseJudge::update(const Observation& observation) {
    if (run_.over) return;
    const PathPlace place = path_.nearest(observation.x, observation.y, station_);
    if (has_previous_) {
        check_contacts(observation);
        update_run(observation, place.station, place.offset);
    }
    station_ = place.station;
    last_ = observation;
    has_previous_ = true;
}

// Whether the segment between two points, which may coincide, intersects the car's box.
bool CourseJudge::touches(const Observation& observation, const GroundPoint& from, const GroundPoint& to) const {
    const double c = std::cos(observation.yaw), s = std::sin(observation.yaw);
    const auto in_vehicle_frame = [&](const GroundPoint& spot) {
        const double x = spot[0] - observation.x, y = spot[1] - observation.y;
        return GroundPoint{c * x + s * y, c * y - s * x};
    };
    const GroundPoint a = in_vehicle_frame(from), b = in_vehicle_frame(to);
    const GroundPoint low{box_.rear, box_.right}, high{box_.front, box_.left};
    double begin = 0, end = 1;  // of the part that is inside
    for (std::size_t i = 0; i < 2; ++i) {
        const double way = b[i] - a[i];
        if (way == 0 && (a[i] < low[i] || a[i] > high[i])) return false;
        if (way == 0) continue;
        const double one = (low[i] - a[i]) / way, other = (high[i] - a[i]) / way;
        begin = std::max(begin, std::min(one, other)), end = std::min(end, std::max(one, other));
    }
    return begin <= end;
}

// Whether the car is beside a boundary on its wrong side, outside the course.
bool CourseJudge::is_beyond(const Observation& observation, const Side& side) const {
    if (station_ < side.begin || station_ > side.end) return false;
    return side.inward * cross(side.gate.from, side.gate.to, observation.x, observation.y) < 0;
}

void CourseJudge::check_contacts(const Observation& observation) {
    const std::vector<GroundPoint>& cones = course_.course.cones;
    for (std::size_t i = 0; i < cones.size(); ++i) {
        if (cones_[i] || !touches(observation, cones[i], cones[i])) continue;
        cones_[i] = 1, ++run_.cones;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        const Gate& gate = sides_[i].gate;
        if (crossed_[i] || !(touches(observation, gate.from, gate.to) || is_beyond(observation, sides_[i]))) continue;
        crossed_[i] = 1, ++run_.boundaries;
    }
}

// Times are those at which the front passes entry and end; the run ends when the rear has passed as well.
void CourseJudge::update_run(const Observation& observation, double station, double offset) {
    const double interval = observation.time - last_.time, way = station - station_;
    const auto crossing_time = [&](double goal) {
        const double left = station + box_.front - goal;
        return observation.time - (way > 0 ? std::clamp(left / way, 0.0, 1.0) * interval : 0);
    };
    if (!run_.entered) {
        if (station + box_.front < entry_) return;
        run_.entered = true;
        run_.entry_time = crossing_time(entry_), run_.entry_speed = observation.speed;
    }
    const double acceleration =
        (observation.lateral_velocity - last_.lateral_velocity) / interval + observation.speed * observation.yaw_rate;
    run_.lateral_acceleration = std::max(run_.lateral_acceleration, std::abs(acceleration));
    run_.sum_acceleration += acceleration, run_.sum_offset += std::abs(offset), ++run_.samples;
    const bool front_is_out = station_ + box_.front >= end_;  // already at the last update
    if (!front_is_out) {
        run_.distance = std::min(station + box_.front, end_) - entry_;
        run_.time = (station + box_.front >= end_ ? crossing_time(end_) : observation.time) - run_.entry_time;
        run_.exit_speed = observation.speed;
    }
    run_.finished = station + box_.rear >= end_;
    run_.over = run_.finished || std::abs(offset) > max_offset;
}

}  // namespace hamilcar::live
