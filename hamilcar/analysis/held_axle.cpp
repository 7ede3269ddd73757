#include "hamilcar/analysis/held_axle.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/math/dense.hpp"

namespace hamilcar {

std::vector<AxleWheels> axles_of(const std::vector<WheelMotion>& wheels) {
    std::vector<AxleWheels> out;
    for (std::size_t i = 0; i + 1 < wheels.size(); ++i) {
        const std::string& name = wheels[i].name;
        const std::string axle = name.substr(0, name.rfind('_'));
        if (name == axle + "_left" && wheels[i + 1].name == axle + "_right") out.push_back({axle, i, i + 1});
    }
    return out;
}

HeldAxle::HeldAxle(const VehicleDescription& vehicle, const Model<double>& model, const AxleWheels& axle)
    : vehicle_(&vehicle), model_(&model), axle_(axle) {
    state_ = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    assemble(model, {}, state_);
    for (const std::size_t wheel : {axle.left, axle.right}) {
        for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
            const Suspension<double>& suspension = model.vehicle.suspensions[s];
            const auto first = static_cast<std::size_t>(suspension.first_wheel);
            const bool carries = wheel >= first && wheel < first + suspension.wheels.size();
            if (carries) loops_.push_back(static_cast<int>(s));
        }
    }
}

// Newton's method finds some closed linkage; that it is the one that this motion leads to shows in a wheel that turns a little
// from step to step. Where halving the step leaves the turn as it is, the linkage has jumped over a dead center.
std::string HeldAxle::move(double left, double right, double rack) {
    constexpr double lead_in = 0.25, finest = lead_in / 1024;  // of the way
    constexpr double most_turn = 0.05;                         // of a wheel's axis in one step [rad]
    const double from_left = travel(axle_.left), from_right = travel(axle_.right), from_rack = rack_;
    double done = 0, step = lead_in;
    while (done < 1) {
        const double share = std::min(done + step, 1.0), rack_before = rack_;
        const State<double> before = state_;
        const std::vector<WheelMotion> earlier = wheels();
        rack_ = from_rack + share * (rack - from_rack);
        std::string problem = reach(from_left + share * (left - from_left), from_right + share * (right - from_right));
        if (problem.empty() && turned_since(earlier) <= most_turn) {
            done = share;
            continue;
        }
        if (problem.empty()) problem = "the linkage of " + axle_.name + " is at a dead center";
        if (step <= finest) return problem;
        state_ = before, rack_ = rack_before;
        step /= 2;
    }
    return {};
}

double HeldAxle::turned_since(const std::vector<WheelMotion>& earlier) const {
    const std::vector<WheelMotion> now = wheels();
    double largest = 0;
    for (const std::size_t wheel : {axle_.left, axle_.right}) {
        largest = std::max(largest, (now[wheel].axis - earlier[wheel].axis).norm());
    }
    return largest;
}

Eigen::VectorXd HeldAxle::motion_for(const WheelMotion& left, const WheelMotion& right, const Eigen::Vector2d& rates) {
    const bool shared = share_suspension(left, right);
    const auto n_left = static_cast<Eigen::Index>(left.J.size()),
               n_right = shared ? 0 : static_cast<Eigen::Index>(right.J.size());
    Eigen::MatrixXd rise = Eigen::MatrixXd::Zero(2, n_left + n_right);
    for (Eigen::Index j = 0; j < n_left; ++j) {
        rise(0, j) = velocity_at<double>(left.J[static_cast<std::size_t>(j)], left.center)[2];
        if (shared) rise(1, j) = velocity_at<double>(right.J[static_cast<std::size_t>(j)], right.center)[2];
    }
    for (Eigen::Index j = 0; j < n_right; ++j) {
        rise(1, n_left + j) = velocity_at<double>(right.J[static_cast<std::size_t>(j)], right.center)[2];
    }
    return shortest_least_squares(rise, rates);
}

double HeldAxle::travel(std::size_t wheel) const {
    const WheelMotion m = wheels()[wheel];
    return m.center[2] - m.design_center[2];
}

std::string HeldAxle::reach(double left_travel, double right_travel) {
    constexpr int max_iterations = 20;
    const RackMotion<double> rack{rack_, 0, 0};
    double miss = 0;
    for (int i = 0; i < max_iterations; ++i) {
        close_loops(*model_, rack, state_, 8);
        const std::vector<WheelMotion> all = wheels();
        const WheelMotion &left = all[axle_.left], &right = all[axle_.right];
        const Eigen::Vector2d missing(left_travel - (left.center[2] - left.design_center[2]),
                                      right_travel - (right.center[2] - right.design_center[2]));
        miss = missing.cwiseAbs().maxCoeff();
        if (!std::isfinite(miss)) break;
        if (miss < 1e-11) return open_joint();
        const Eigen::VectorXd step = motion_for(left, right, missing);
        const bool shared = share_suspension(left, right);
        for (std::size_t j = 0; j < left.coordinates.size(); ++j) {
            state_.values[static_cast<std::size_t>(left.coordinates[j])] += step[static_cast<Eigen::Index>(j)];
        }
        for (std::size_t j = 0; !shared && j < right.coordinates.size(); ++j) {
            state_.values[static_cast<std::size_t>(right.coordinates[j])] +=
                step[static_cast<Eigen::Index>(left.coordinates.size() + j)];
        }
    }
    return "the linkage of " + axle_.name + " does not reach this position";
}

std::string HeldAxle::open_joint() const {
    for (const int i : loops_) {
        const LoopReport report = inspect_loops(*model_, {rack_, 0, 0}, state_, i);
        if (!(report.violation < 1e-8)) return "the linkage of " + axle_.name + " does not reach this position";
        if (report.mobility < locked_mobility) return "the linkage of " + axle_.name + " locks";
    }
    return {};
}

}  // namespace hamilcar
