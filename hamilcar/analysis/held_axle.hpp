// An axle whose wheels are led to given travels while the chassis is held at its design attitude.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "hamilcar/analysis/wheel_motion.hpp"

namespace hamilcar {

struct AxleWheels {
    std::string name;
    std::size_t left, right;  // numbers among all wheels
};

std::vector<AxleWheels> axles_of(const std::vector<WheelMotion>& wheels);

class HeldAxle {
public:
    HeldAxle(const VehicleDescription& vehicle, const Model<double>& model, const AxleWheels& axle);

    // Brings both wheels to their travels [m], a bit at a time, and the rack; the reason if they do not get there without leaving
    // the branch of the linkage that they are on.
    std::string move(double left, double right, double rack);

    std::vector<WheelMotion> wheels() const { return wheel_motions(*vehicle_, *model_, state_, rack_); }
    double rack() const { return rack_; }

    // The motion, per independent coordinate of the axle's suspensions, left then right, that raises its wheels at those rates.
    static Eigen::VectorXd motion_for(const WheelMotion& left, const WheelMotion& right, const Eigen::Vector2d& rates);

private:
    double travel(std::size_t wheel) const;
    double turned_since(const std::vector<WheelMotion>& earlier) const;  // the axle's wheels, by their axes [rad]
    std::string reach(double left_travel, double right_travel);
    std::string open_joint() const;

    const VehicleDescription* vehicle_;
    const Model<double>* model_;
    AxleWheels axle_;
    std::vector<int> loops_;  // of the suspensions that carry its wheels
    State<double> state_;
    double rack_ = 0;
};

// Whether one suspension carries both wheels.
inline bool share_suspension(const WheelMotion& left, const WheelMotion& right) {
    return left.coordinates == right.coordinates;
}

}  // namespace hamilcar
