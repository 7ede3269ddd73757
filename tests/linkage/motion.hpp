// The motion of a frame from its poses alone: what columns and rates in the linkage must agree with.
#pragma once

#include "hamilcar/linkage/frame.hpp"
#include "support/difference.hpp"

namespace hamilcar::test {

// Motion (velocity of the body-fixed point at the chassis origin ; angular velocity) of a frame whose pose is pose_at(x),
// per unit of x.
template <class PoseAt>
Spatial<double> motion_of(PoseAt&& pose_at, double x, double step = 1e-3) {
    const Pose<double> pose = pose_at(x);
    const Mat3<double> R_rate = derivative([&](double at) { return Mat3<double>(pose_at(at).R); }, x, step);
    const Vec3<double> p_rate = derivative([&](double at) { return Vec3<double>(pose_at(at).p); }, x, step);
    const Mat3<double> W = R_rate * pose.R.transpose();  // skew: v = W (y - p) + p' of the body point now at y
    const Vec3<double> w = 0.5 * Vec3<double>(W(2, 1) - W(1, 2), W(0, 2) - W(2, 0), W(1, 0) - W(0, 1));
    return spatial<double>(p_rate - w.cross(pose.p), w);
}

// Largest difference of two poses, over all entries.
inline double difference(const Pose<double>& a, const Pose<double>& b) {
    return std::max((a.R - b.R).cwiseAbs().maxCoeff(), (a.p - b.p).cwiseAbs().maxCoeff());
}

}  // namespace hamilcar::test
