#include "hamilcar/maneuver/lane_course.hpp"

#include <algorithm>
#include <cmath>

namespace hamilcar {

namespace {

constexpr double cone_distance = 3;  // between two cones of a row, about [m]

// What a convex outline covers of a strip of x: its extremes along y, none where it is not in the strip.
struct Cover {
    double right = 1e9, left = -1e9;
    bool any() const { return left >= right; }
    void add(double y) { right = std::min(right, y), left = std::max(left, y); }
    void add(const Cover& other) { right = std::min(right, other.right), left = std::max(left, other.left); }
};

using Outline = std::array<std::array<double, 2>, 4>;

// Where the center of mass is on the ground, and where it heads.
struct Pose {
    double x, y, yaw;  // [m], [rad]
};

Outline outline(const Footprint& box, const Pose& pose) {
    const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
    const auto corner = [&](double ahead, double beside) {
        return std::array<double, 2>{pose.x + c * ahead - s * beside, pose.y + s * ahead + c * beside};
    };
    return {corner(box.front, box.left), corner(box.rear, box.left), corner(box.rear, box.right),
            corner(box.front, box.right)};
}

Cover cover(const Outline& corners, double begin, double end) {
    Cover out;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto &from = corners[i], &to = corners[(i + 1) % corners.size()];
        if (from[0] >= begin && from[0] <= end) out.add(from[1]);
        for (const double x : {begin, end}) {
            if ((from[0] - x) * (to[0] - x) >= 0) continue;
            out.add(from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0]));
        }
    }
    return out;
}

// A wheel of a trailer on the ground, with all its tires.
struct Follower {
    std::span<const double> x, y;  // of its outer tire's contact [m]
    double left, right;            // its edges from there, both positive [m]

    Cover cover(std::size_t row, double begin, double end) const {
        Cover out;
        if (x[row] >= begin && x[row] <= end) out.add(y[row] - right), out.add(y[row] + left);
        return out;
    }
    // Since the row before: at speed a contact is far from where it was.
    bool runs_over(const std::array<double, 2>& cone, std::size_t row) const {
        if (row == 0) return false;
        const double way = x[row] - x[row - 1], share = (cone[0] - x[row - 1]) / way;
        if (way == 0 || share < 0 || share > 1) return false;
        const double middle = std::lerp(y[row - 1], y[row], share);
        return cone[1] > middle - right && cone[1] < middle + left;
    }
};

std::vector<Follower> followers_of(const VehicleDescription& vehicle, const Recording& recording) {
    const double half = half_tire(vehicle);
    std::vector<Follower> out;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        if (unit == 0) return;
        const double inner = half + wheel.dual_spacing;
        const bool is_right = wheel.wheel.center[1] < 0;
        out.push_back({recording[channel::contact_x(wheel.name)].values,
                       recording[channel::contact_y(wheel.name)].values, is_right ? inner : half,
                       is_right ? half : inner});
    });
    return out;
}

std::vector<std::array<double, 2>> cones_of(const std::vector<Lane>& lanes) {
    std::vector<std::array<double, 2>> out;
    for (const Lane& lane : lanes) {
        const int parts = std::max(1, static_cast<int>(std::lround((lane.end - lane.begin) / cone_distance)));
        for (int i = 0; i <= parts; ++i) {
            const double x = lane.begin + (lane.end - lane.begin) * i / parts;
            out.push_back({x, lane.left}), out.push_back({x, lane.right});
        }
    }
    return out;
}

}  // namespace

Course lane_course(const std::vector<Lane>& lanes, const Footprint& box) {
    Course course;
    course.cones = cones_of(lanes);
    for (const Lane& lane : lanes) {
        for (const double y : {lane.right, lane.left}) course.boundaries.push_back({{lane.begin, y}, {lane.end, y}});
    }
    course.line = easiest_line(lanes, box);
    return course;
}

Passage passage(const VehicleDescription& vehicle, const std::vector<Lane>& lanes, const Recording& recording) {
    const Footprint box = footprint(vehicle);
    const auto cones = cones_of(lanes);
    const std::vector<Follower> followers = followers_of(vehicle, recording);
    const auto x = recording[channel::x].values, y = recording[channel::y].values,
               yaw = recording[channel::heading].values;
    std::vector<bool> hit(cones.size());
    Passage out{.clearance = 1e9, .place = 0, .cones = 0, .complete = false};
    for (std::size_t row = 0; row < x.size(); ++row) {
        const Outline corners = outline(box, {x[row], y[row], yaw[row] * degree});
        for (const Lane& lane : lanes) {
            Cover covered = cover(corners, lane.begin, lane.end);
            for (const Follower& wheel : followers) covered.add(wheel.cover(row, lane.begin, lane.end));
            if (!covered.any()) continue;
            const double clearance = std::min(lane.left - covered.left, covered.right - lane.right);
            if (clearance < out.clearance) out.clearance = clearance, out.place = x[row];
        }
        for (std::size_t i = 0; i < cones.size(); ++i) {
            const Cover at = cover(corners, cones[i][0], cones[i][0]);
            hit[i] =
                hit[i] || (at.any() && cones[i][1] > at.right && cones[i][1] < at.left) ||
                std::ranges::any_of(followers, [&](const Follower& wheel) { return wheel.runs_over(cones[i], row); });
        }
    }
    out.cones = static_cast<std::size_t>(std::ranges::count(hit, true));
    const double end = lanes.back().end;
    out.complete = !x.empty() && x.back() + box.rear > end &&
                   std::ranges::all_of(followers, [&](const Follower& wheel) { return wheel.x.back() > end; });
    return out;
}

}  // namespace hamilcar
