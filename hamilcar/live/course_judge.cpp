#include "hamilcar/live/course_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hamilcar::live {

namespace {

using Spot = std::array<double, 2>;

constexpr double run_up = 80;         // from the start to the entry [m]
constexpr double lost = 15;           // beside the line: nobody comes back to the course from there [m]
constexpr double closing = 1.5;       // times the first stride, within which a line returns to its beginning [1]
constexpr std::size_t least_lap = 4;  // points

double distance(const Spot& a, const Spot& b) {
    return std::hypot(b[0] - a[0], b[1] - a[1]);
}

// Positive where a point is to the left of the way from `from` to `to`.
double cross(const Spot& from, const Spot& to, double x, double y) {
    return (to[0] - from[0]) * (y - from[1]) - (to[1] - from[1]) * (x - from[0]);
}

// Where there is no line, straight along x past all that stands there.
PathDescription line_of(const Course& course) {
    PathDescription path{.points = course.line};
    if (path.points.empty()) {
        double first = std::numeric_limits<double>::infinity(), last = -first;
        const auto add = [&](const Spot& spot) { first = std::min(first, spot[0]), last = std::max(last, spot[0]); };
        for (const Spot& cone : course.cones) add(cone);
        for (const Gate& gate : course.boundaries) add(gate.from), add(gate.to);
        path.points = {{first, 0}, {last, 0}};
    }
    const std::vector<Spot>& points = path.points;
    if (points.size() < least_lap) return path;
    path.closed = distance(points.back(), points.front()) <= closing * distance(points[0], points[1]);
    constexpr double same = 1e-3;  // [m]
    if (path.closed && distance(points.back(), points.front()) < same) path.points.pop_back();
    return path;
}

// What a maneuver's own summary tells is a test that the program drives, of which a person is judged by the ground alone.
std::string task_on(const Course& course, bool is_lap) {
    if (course.cones.empty() && course.boundaries.empty()) {
        return std::string(is_lap ? "One lap along the dashed line" : "Along the dashed line to its end") +
               ": time, speeds, lateral acceleration and deviation are measured, nothing is to be passed.";
    }
    const char* criteria = course.cones.empty()        ? "no boundary may be crossed."
                           : course.boundaries.empty() ? "no cone may be hit."
                                                       : "no cone may be hit and no boundary crossed.";
    return std::string("Through the course to its end, at a speed of your own: ") + criteria;
}

}  // namespace

CourseJudge::CourseJudge(TestCourse course, const VehicleDescription& vehicle)
    : course_(std::move(course)),
      box_(footprint(vehicle)),
      path_(line_of(course_.course)),
      cones_(course_.course.cones.size()),
      crossed_(course_.course.boundaries.size()) {
    course_.summary = task_on(course_.course, path_.closed());
    end_ = path_.length();
    double first = std::numeric_limits<double>::infinity(), last = -first;
    const auto add = [&](double station) { first = std::min(first, station), last = std::max(last, station); };
    for (const Gate& gate : course_.course.boundaries) {
        sides_.push_back(side_of(gate));
        add(sides_.back().begin), add(sides_.back().end);
    }
    for (const Spot& cone : course_.course.cones) add(station_of(cone[0], cone[1]));
    if (!path_.closed() && last > first) entry_ = first, end_ = last;
    begin();
}

// In whatever direction it leads there.
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
    begun_ = false;
    station_ = entry_ - run_up;
    last_ = {};
}

void CourseJudge::look(const Senses& senses) {
    if (run_.over) return;
    const PathPlace place = path_.nearest(senses.x, senses.y, station_);
    if (begun_) {
        look_around(senses);
        pass(senses, place.station, place.offset);
    }
    station_ = place.station;
    last_ = senses;
    begun_ = true;
}

// Whether what stands straight between two points is under the car; the two may be one.
bool CourseJudge::touches(const Senses& senses, const Spot& from, const Spot& to) const {
    const double c = std::cos(senses.yaw), s = std::sin(senses.yaw);
    const auto seen = [&](const Spot& spot) {
        const double x = spot[0] - senses.x, y = spot[1] - senses.y;
        return Spot{c * x + s * y, c * y - s * x};
    };
    const Spot a = seen(from), b = seen(to);
    const Spot low{box_.rear, box_.right}, high{box_.front, box_.left};
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

// Beside a boundary, on its wrong side: past the course instead of through it.
bool CourseJudge::is_beyond(const Senses& senses, const Side& side) const {
    if (station_ < side.begin || station_ > side.end) return false;
    return side.inward * cross(side.gate.from, side.gate.to, senses.x, senses.y) < 0;
}

void CourseJudge::look_around(const Senses& senses) {
    const std::vector<Spot>& cones = course_.course.cones;
    for (std::size_t i = 0; i < cones.size(); ++i) {
        if (cones_[i] || !touches(senses, cones[i], cones[i])) continue;
        cones_[i] = 1, ++run_.cones;
    }
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        const Gate& gate = sides_[i].gate;
        if (crossed_[i] || !(touches(senses, gate.from, gate.to) || is_beyond(senses, sides_[i]))) continue;
        crossed_[i] = 1, ++run_.boundaries;
    }
}

// Times are those at which the foremost point passes entry and end; what is behind it has to follow.
void CourseJudge::pass(const Senses& senses, double station, double offset) {
    const double interval = senses.time - last_.time, way = station - station_;
    const auto passing = [&](double goal) {
        const double left = station + box_.front - goal;
        return senses.time - (way > 0 ? std::clamp(left / way, 0.0, 1.0) * interval : 0);
    };
    if (!run_.entered) {
        if (station + box_.front < entry_) return;
        run_.entered = true;
        run_.entry_time = passing(entry_), run_.entry_speed = senses.speed;
    }
    const double acceleration =
        (senses.lateral_velocity - last_.lateral_velocity) / interval + senses.speed * senses.yaw_rate;
    run_.lateral_acceleration = std::max(run_.lateral_acceleration, std::abs(acceleration));
    run_.sum_acceleration += acceleration, run_.sum_offset += std::abs(offset), ++run_.looks;
    const bool front_is_out = station_ + box_.front >= end_;  // since before
    if (!front_is_out) {
        run_.distance = std::min(station + box_.front, end_) - entry_;
        run_.time = (station + box_.front >= end_ ? passing(end_) : senses.time) - run_.entry_time;
        run_.exit_speed = senses.speed;
    }
    run_.finished = station + box_.rear >= end_;
    run_.over = run_.finished || std::abs(offset) > lost;
}

}  // namespace hamilcar::live
