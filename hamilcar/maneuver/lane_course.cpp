#include "hamilcar/maneuver/lane_course.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/math/eigen.hpp"

#include <Eigen/Cholesky>

namespace hamilcar {

namespace {

constexpr double cone_distance = 3;     // between two cones of a row, about [m]
constexpr double stride = 1;            // between two points of the line [m]
constexpr double straight_before = 60;  // of the line before the first lane and behind the last one [m]
constexpr double spared = 0.4;          // of the room beside the box that the line leaves to the driver [1]

// y at stations x_i, which minimizes sum (y_i-1 - 2 y_i + y_i+1)^2 + stiffness sum (what a point of the box is beyond its
// bound)^2. The bounds are linear in y: a point `ahead` of the center of mass stands at y + ahead y'. Newton's method on the
// set of bounds that are in force ends where it no longer changes.
class LeastBending {
public:
    LeastBending(const std::vector<Lane>& lanes, const Footprint& box) : lanes_(lanes), box_(box) {
        const double first = lanes.front().begin - straight_before, last = lanes.back().end + straight_before;
        count_ = static_cast<int>(std::ceil((last - first) / stride)) + 1;
        first_ = first;
        y_ = Eigen::VectorXd::Constant(count_, lanes.front().center());
    }

    std::vector<std::array<double, 2>> points() {
        constexpr int patience = 60;  // turns; a handful is usual
        for (int turn = 0; turn < patience; ++turn) {
            const Eigen::VectorXd before = y_;
            solve();
            if ((y_ - before).cwiseAbs().maxCoeff() < 1e-9) break;
        }
        std::vector<std::array<double, 2>> out;
        for (int i = 0; i < count_; ++i) out.push_back({x(i), y_[i]});
        return out;
    }

private:
    double x(int i) const { return first_ + i * stride; }

    void solve() {
        constexpr double firm = 1e3;  // of a bound against bending [1]
        K_ = Eigen::MatrixXd::Zero(count_, count_), f_ = Eigen::VectorXd::Zero(count_);
        for (int i = 1; i + 1 < count_; ++i) {
            const int at[3] = {i - 1, i, i + 1};
            const double by[3] = {1, -2, 1};
            for (int r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) K_(at[r], at[c]) += by[r] * by[c];
            }
        }
        for (const int i : {0, 1}) add(i, 0, lanes_.front().center(), firm);
        for (const int i : {count_ - 2, count_ - 1}) add(i, 0, lanes_.back().center(), firm);
        for (const Lane& lane : lanes_) {
            for (int i = 1; i + 1 < count_; ++i) bound(lane, i, firm);
        }
        y_ = K_.ldlt().solve(f_);
    }

    // y_i + ahead y_i' is drawn to `where`.
    void add(int i, double ahead, double where, double firm) {
        const int low = std::max(i - 1, 0), high = std::min(i + 1, count_ - 1);
        const double slope = ahead / ((high - low) * stride);
        const int at[3] = {low, i, high};
        const double by[3] = {-slope, 1, slope};
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) K_(at[r], at[c]) += firm * by[r] * by[c];
            f_[at[r]] += firm * by[r] * where;
        }
    }

    // The points of the box's sides that are farthest out in a lane: its corners, and where it reaches over the lane's ends.
    void bound(const Lane& lane, int i, double firm) {
        const double slack = lane.width() - box_.width(), margin = spared * 0.5 * std::max(slack, 0.0);
        const double slope = (y_[i + 1] - y_[i - 1]) / (2 * stride);
        for (const double ahead : {box_.front, box_.rear, lane.begin - x(i), lane.end - x(i)}) {
            const double at = x(i) + ahead;
            if (ahead < box_.rear || ahead > box_.front || at < lane.begin || at > lane.end) continue;
            const double y = y_[i] + ahead * slope;
            const double highest = lane.left - margin - box_.left, lowest = lane.right + margin - box_.right;
            if (y > highest) add(i, ahead, highest, firm);
            if (y < lowest) add(i, ahead, lowest, firm);
        }
    }

    const std::vector<Lane>& lanes_;
    const Footprint& box_;
    double first_;
    int count_;
    Eigen::VectorXd y_, f_;
    Eigen::MatrixXd K_;
};

// What a convex outline covers of a strip of x: its extremes along y, none where it is not in the strip.
struct Cover {
    double right = 1e9, left = -1e9;
    bool any() const { return left >= right; }
    void add(double y) { right = std::min(right, y), left = std::max(left, y); }
    void add(const Cover& other) { right = std::min(right, other.right), left = std::max(left, other.left); }
};

using Outline = std::array<std::array<double, 2>, 4>;

Outline outline(const Footprint& box, const History& history, std::size_t row) {
    const double c = std::cos(history.yaw[row]), s = std::sin(history.yaw[row]);
    const auto corner = [&](double ahead, double beside) {
        return std::array<double, 2>{history.x[row] + c * ahead - s * beside, history.y[row] + s * ahead + c * beside};
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
    std::size_t number;  // in a History
    double left, right;  // its edges, from the outer tire's contact, both positive [m]

    Cover cover(const History& history, std::size_t row, double begin, double end) const {
        Cover out;
        const double x = history.wheel_x[number][row], y = history.wheel_y[number][row];
        if (x >= begin && x <= end) out.add(y - right), out.add(y + left);
        return out;
    }
    // Since the row before: at speed a contact is far from where it was.
    bool runs_over(const std::array<double, 2>& cone, const History& history, std::size_t row) const {
        if (row == 0) return false;
        const auto &x = history.wheel_x[number], &y = history.wheel_y[number];
        const double way = x[row] - x[row - 1], share = (cone[0] - x[row - 1]) / way;
        if (way == 0 || share < 0 || share > 1) return false;
        const double middle = y[row - 1] + share * (y[row] - y[row - 1]);
        return cone[1] > middle - right && cone[1] < middle + left;
    }
    bool is_beyond(const History& history, double x) const { return history.wheel_x[number].back() > x; }
};

std::vector<Follower> followers_of(const VehicleDescription& vehicle) {
    const double half = half_tire(vehicle);
    std::vector<Follower> out;
    std::size_t number = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        const double inner = half + wheel.dual_spacing;
        const bool is_right = wheel.wheel.center[1] < 0;
        if (unit != 0) out.push_back({number, is_right ? inner : half, is_right ? half : inner});
        ++number;
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

std::vector<std::array<double, 2>> easiest_line(const std::vector<Lane>& lanes, const Footprint& box) {
    return LeastBending(lanes, box).points();
}

Course lane_course(const std::vector<Lane>& lanes, const Footprint& box) {
    Course course;
    course.cones = cones_of(lanes);
    for (const Lane& lane : lanes) {
        for (const double y : {lane.right, lane.left}) course.boundaries.push_back({{lane.begin, y}, {lane.end, y}});
    }
    course.line = easiest_line(lanes, box);
    return course;
}

Passage passage(const VehicleDescription& vehicle, const std::vector<Lane>& lanes, const History& history) {
    const Footprint box = footprint(vehicle);
    const auto cones = cones_of(lanes);
    const std::vector<Follower> followers = followers_of(vehicle);
    std::vector<bool> hit(cones.size());
    Passage out{.clearance = 1e9, .place = 0, .cones = 0, .complete = false};
    for (std::size_t row = 0; row < history.size(); ++row) {
        const Outline corners = outline(box, history, row);
        for (const Lane& lane : lanes) {
            Cover covered = cover(corners, lane.begin, lane.end);
            for (const Follower& wheel : followers) covered.add(wheel.cover(history, row, lane.begin, lane.end));
            if (!covered.any()) continue;
            const double clearance = std::min(lane.left - covered.left, covered.right - lane.right);
            if (clearance < out.clearance) out.clearance = clearance, out.place = history.x[row];
        }
        for (std::size_t i = 0; i < cones.size(); ++i) {
            const Cover at = cover(corners, cones[i][0], cones[i][0]);
            hit[i] = hit[i] || (at.any() && cones[i][1] > at.right && cones[i][1] < at.left) ||
                     std::ranges::any_of(
                         followers, [&](const Follower& wheel) { return wheel.runs_over(cones[i], history, row); });
        }
    }
    out.cones = static_cast<std::size_t>(std::ranges::count(hit, true));
    const double end = lanes.back().end;
    out.complete = history.size() > 0 && history.x.back() + box.rear > end &&
                   std::ranges::all_of(followers, [&](const Follower& wheel) { return wheel.is_beyond(history, end); });
    return out;
}

}  // namespace hamilcar
