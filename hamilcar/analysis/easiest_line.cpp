#include "hamilcar/analysis/easiest_line.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/math/dense.hpp"
#include "hamilcar/math/eigen.hpp"

namespace hamilcar {

namespace {

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
        constexpr int max_iterations = 60;  // a handful is usual
        for (int i = 0; i < max_iterations; ++i) {
            const Eigen::VectorXd before = y_;
            solve();
            if ((y_ - before).cwiseAbs().maxCoeff() < 1e-9) break;
        }
        std::vector<std::array<double, 2>> out;
        for (int k = 0; k < count_; ++k) out.push_back({x(k), y_[k]});
        return out;
    }

private:
    static constexpr double firm = 1e3;  // of a bound against bending [1]

    double x(int i) const { return first_ + i * stride; }

    void solve() {
        K_ = Eigen::MatrixXd::Zero(count_, count_), f_ = Eigen::VectorXd::Zero(count_);
        const Eigen::Vector3d bend(1, -2, 1);
        for (int i = 1; i + 1 < count_; ++i) K_.block<3, 3>(i - 1, i - 1) += bend * bend.transpose();
        for (const int i : {0, 1}) fix(i, lanes_.front().center());
        for (const int i : {count_ - 2, count_ - 1}) fix(i, lanes_.back().center());
        for (const Lane& lane : lanes_) {
            for (int i = 1; i + 1 < count_; ++i) bound(lane, i);
        }
        y_ = solve_symmetric(K_, f_);
    }

    void fix(int i, double where) { K_(i, i) += firm, f_[i] += firm * where; }

    // y_i + ahead y_i' is drawn to `where`.
    void draw(int i, double ahead, double where) {
        const double slope = ahead / (2 * stride);
        const Eigen::Vector3d by(-slope, 1, slope);
        K_.block<3, 3>(i - 1, i - 1) += firm * by * by.transpose();
        f_.segment<3>(i - 1) += firm * by * where;
    }

    // The points of the box's sides that are farthest out in a lane: its corners, and where it reaches over the lane's ends.
    void bound(const Lane& lane, int i) {
        const double slack = lane.width() - box_.width(), margin = spared * 0.5 * std::max(slack, 0.0);
        const double slope = (y_[i + 1] - y_[i - 1]) / (2 * stride);
        for (const double ahead : {box_.front, box_.rear, lane.begin - x(i), lane.end - x(i)}) {
            const double at = x(i) + ahead;
            if (ahead < box_.rear || ahead > box_.front || at < lane.begin || at > lane.end) continue;
            const double y = y_[i] + ahead * slope;
            const double highest = lane.left - margin - box_.left, lowest = lane.right + margin - box_.right;
            if (y > highest) draw(i, ahead, highest);
            if (y < lowest) draw(i, ahead, lowest);
        }
    }

    const std::vector<Lane>& lanes_;
    const Footprint& box_;
    double first_;
    int count_;
    Eigen::VectorXd y_, f_;
    Eigen::MatrixXd K_;
};

}  // namespace

std::vector<std::array<double, 2>> easiest_line(const std::vector<Lane>& lanes, const Footprint& box) {
    return LeastBending(lanes, box).points();
}

}  // namespace hamilcar
