// Where a MacPherson spindle is: Newton's method on its six equations, for a strut length and a rack displacement.

#include "tests/oracle/simbody_parts.hpp"

#include <stdexcept>

namespace hamilcar::oracle {

using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;
using SimTK::Vector;

Linkage::Linkage(const CornerDescription& corner) : wheel_center(to_vec3(corner.wheel.center)) {
    const auto& strut = std::get<MacPhersonDescription>(corner.suspension);
    if (!strut.steered) throw std::invalid_argument(corner.name + ": this engine moves every strut's rack end");
    top = to_vec3(strut.strut_top);
    slide = to_vec3(strut.slide_point);
    slide_axis = UnitVec3(top - slide);
    ball = to_vec3(strut.ball_joint);
    const Vec3 front = to_vec3(strut.arm_front);
    arm_axis = UnitVec3(to_vec3(strut.arm_rear) - front);
    arm_foot = front + (~arm_axis * (ball - front)) * Vec3(arm_axis);
    arm_length = strut.arm_length.value_or((ball - arm_foot).norm());
    rack_end = to_vec3(strut.rack_end);
    tie_rod = to_vec3(strut.tie_rod_outer);
    rack_axis = UnitVec3(to_vec3(strut.rack_axis));
    tie_rod_length = strut.tie_rod_length.value_or((tie_rod - rack_end).norm());
}

namespace {

// Residuals of the strut length and the five constraints, and their gradients with respect to the spindle's twist
// (rotation, then displacement of the wheel center) in chassis axes.
class LinkageEquations {
public:
    LinkageEquations(const Linkage& linkage, const Transform& pose, double strut_length, double rack)
        : residual_(6), gradient_(6, 6) {
        const Vec3 slide = pose * (linkage.slide - linkage.wheel_center);
        const Vec3 ball = pose * (linkage.ball - linkage.wheel_center);
        const Vec3 tie_rod = pose * (linkage.tie_rod - linkage.wheel_center);
        const UnitVec3 across = linkage.slide_axis.perp();
        const Vec3 slide_frame[3] = {Vec3(linkage.slide_axis), Vec3(across), linkage.slide_axis % across};
        for (int i = 0; i < 3; ++i) {  // this frame turns with the spindle, so the arm of its motion reaches to T
            const Vec3 axis = pose.R() * slide_frame[i];
            set(i, ~axis * (linkage.top - slide) - (i == 0 ? strut_length : 0), -axis, linkage.top - pose.p());
        }
        const Vec3 arm = ball - linkage.arm_foot;
        set(3, ~linkage.arm_axis * arm, Vec3(linkage.arm_axis), ball - pose.p());
        set(4, (arm.normSqr() - linkage.arm_length * linkage.arm_length) / 2, arm, ball - pose.p());
        rod_ = tie_rod - (linkage.rack_end + rack * linkage.rack_axis);
        set(5, (rod_.normSqr() - linkage.tie_rod_length * linkage.tie_rod_length) / 2, rod_, tie_rod - pose.p());
    }

    SpatialVec newton_step() const { return solve(-residual_); }

    SpatialVec twist(double strut_rate, const Vec3& rack_velocity) const {
        Vector rates(6, 0.0);
        rates[0] = strut_rate;
        rates[5] = ~rod_ * rack_velocity;
        return solve(rates);
    }

private:
    // A residual that grows as the spindle's material point at `arm` from the wheel center moves along `direction`.
    void set(int row, double value, const Vec3& direction, const Vec3& arm) {
        residual_[row] = value;
        const Vec3 moment = arm % direction;
        for (int j = 0; j < 3; ++j) {
            gradient_(row, j) = moment[j];
            gradient_(row, 3 + j) = direction[j];
        }
    }

    SpatialVec solve(const Vector& right_side) const {
        Vector twist;
        SimTK::FactorLU(gradient_).solve(right_side, twist);
        return {Vec3(twist[0], twist[1], twist[2]), Vec3(twist[3], twist[4], twist[5])};
    }

    Vector residual_;
    SimTK::Matrix gradient_;
    Vec3 rod_;  // from the rack's end to the spindle's
};

}  // namespace

Transform spindle_pose(const Linkage& linkage, double strut_length, double rack) {
    Transform pose(linkage.wheel_center);
    for (int iteration = 0; iteration < 50; ++iteration) {
        const SpatialVec step = LinkageEquations(linkage, pose, strut_length, rack).newton_step();
        const double angle = step[0].norm();
        if (angle > 0) pose.updR() = Rotation(angle, UnitVec3(step[0])) * pose.R();
        pose.updP() += step[1];
        if (angle + step[1].norm() < 1e-13) return pose;
    }
    throw std::runtime_error("the linkage does not reach this strut length and rack displacement");
}

SpatialVec spindle_twist(const Linkage& linkage, const Transform& pose, double strut_rate, const Inputs& inputs) {
    const Vec3 rack_velocity = inputs.rack_rate * Vec3(linkage.rack_axis);
    return LinkageEquations(linkage, pose, 0, inputs.rack).twist(strut_rate, rack_velocity);
}

}  // namespace hamilcar::oracle
