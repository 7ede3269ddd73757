// Mechanisms with published solutions, as suspensions on a fixed base, and the poses of their parts in closed form: an
// independent solution that shares no code with the linkage.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/linkage/frame.hpp"

namespace hamilcar::test {

using Vec = Vec3<double>;
using Poses = std::vector<Pose<double>>;  // of the bodies, relative to design

struct Mechanism {
    SuspensionDescription suspension;
    Vec gravity{0, 0, 0};                // [m/s^2]
    std::function<Poses(double)> poses;  // at an angle of the crank from design, loops closed on the branch of design
};

inline Point point(const Vec& v) {
    return {v[0], v[1], v[2]};
}

// Adds a part on a joint; returns its number.
inline std::size_t add_part(Mechanism& to, TreeJoint kind, std::size_t parent, const Vec& at, const Vec& axis,
                            const Vec& second = Vec::Zero()) {
    auto& joints = to.suspension.linkage.joints;
    joints.push_back({kind, std::to_string(joints.size() + 1), parent, point(at), point(axis), point(second)});
    return joints.size();
}

// A body with its inertia about its center of mass, given in axes that are the columns of `axes` at design.
inline void add_body(Mechanism& to, std::size_t part, double mass, const Vec& center, const Vec& inertia,
                     const Mat3<double>& axes = Mat3<double>::Identity()) {
    const Mat3<double> I = axes * inertia.asDiagonal() * axes.transpose();
    to.suspension.bodies.push_back(
        {part, {mass, point(center), {I(0, 0), I(1, 1), I(2, 2)}, {I(0, 1), I(1, 2), I(0, 2)}}});
}

// A cut joint at a point that both parts share at design: a hinge about z in a planar mechanism, else a ball.
inline void cut_hinge(Mechanism& to, std::size_t part, std::size_t base, const Vec& at) {
    to.suspension.linkage.cuts.push_back({CutJoint::line, "cut", part, base, point(at), point(at), {0, 0, 1}, {}, {}});
}
inline void cut_ball(Mechanism& to, std::size_t part, std::size_t base, const Vec& at) {
    to.suspension.linkage.cuts.push_back({CutJoint::spherical, "cut", part, base, point(at), point(at), {}, {}, {}});
}

// Unit axes with the first along v; the others do not matter for a body of revolution.
inline Mat3<double> axes_along(const Vec& v) {
    const Vec x = v.normalized(), y = x.unitOrthogonal();
    Mat3<double> axes;
    axes << x, y, x.cross(y);
    return axes;
}

// The pose that turns by R and brings the design point `from` to `to`.
inline Pose<double> brought(const Mat3<double>& R, const Vec& from, const Vec& to) {
    return {R, to - R * from};
}
inline Mat3<double> turn(const Vec& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}
inline double plane_angle(const Vec& v) {
    return std::atan2(v[1], v[0]);
}

// Four hinges about z: crank O-A, coupler A-B, rocker D-B; B where two circles meet, on the side it has at design.
struct FourBar {
    Vec O, A, B, D;
    Poses poses(double angle) const {
        const double coupler = (B - A).norm(), rocker = (B - D).norm();
        const Mat3<double> crank = turn(Vec::UnitZ(), angle);
        const Vec tip = O + crank * (A - O), to_D = D - tip;
        const double square = to_D.squaredNorm(), along = (coupler * coupler - rocker * rocker + square) / (2 * square),
                     across = std::sqrt(coupler * coupler / square - along * along),
                     side = (D - A).cross(B - A)[2] > 0 ? 1 : -1;
        const Vec knee = tip + along * to_D + side * across * Vec::UnitZ().cross(to_D);
        const auto turned = [&](const Vec& now, const Vec& design) {
            return turn(Vec::UnitZ(), plane_angle(now) - plane_angle(design));
        };
        return {brought(crank, O, O), brought(turned(knee - tip, B - A), A, tip),
                brought(turned(knee - D, B - D), D, D)};
    }
};

// In all of these the crank's angle is coordinate 0, and the bodies are added in the order of `poses`.
inline Mechanism planar_four_bar(const FourBar& at) {
    Mechanism m;
    const std::size_t crank = add_part(m, TreeJoint::revolute, 0, at.O, Vec::UnitZ());
    const std::size_t coupler = add_part(m, TreeJoint::revolute, crank, at.A, Vec::UnitZ());
    const std::size_t rocker = add_part(m, TreeJoint::revolute, 0, at.D, Vec::UnitZ());
    cut_hinge(m, coupler, rocker, at.B);
    m.suspension.linkage.independent = {0};
    m.poses = [at](double angle) { return at.poses(angle); };
    return m;
}

// Orientation of a rod on a universal joint that points along `rod` at design and along `now`: first about the unit axis
// `a`, which now points the same way, then about the unit axis b that the first has turned along; a, b and a x b at
// right angles.
inline Mat3<double> on_universal_joint(const Vec& rod, const Vec& now, const Vec& a, const Vec& b) {
    const Vec c = a.cross(b);
    // About b: the component along a becomes that of `now`, which the rotation about a preserves.
    const double ra = rod.dot(a), rc = rod.dot(c), na = now.dot(a), flat = ra * ra + rc * rc;
    const double nc = std::copysign(std::sqrt(flat - na * na), rc);
    const double second = std::atan2(na, nc) - std::atan2(ra, rc);
    const double first = std::atan2(now.dot(c), now.dot(b)) - std::atan2(nc, rod.dot(b));
    return turn(a, first) * turn(b, second);
}

// Three hinges about z: crank O-A, rod A-S; the slider S moves along x.
struct PlanarSliderCrank {
    Vec O, A, S;
    Poses poses(double angle) const {
        const Mat3<double> crank = turn(Vec::UnitZ(), angle);
        const Vec tip = O + crank * (A - O), rod = S - A;
        const double rise = S[1] - tip[1], reach = std::sqrt(rod.squaredNorm() - rise * rise);
        const Vec along(std::copysign(reach, rod[0]), rise, 0);
        const Mat3<double> stands = turn(Vec::UnitZ(), plane_angle(along) - plane_angle(rod));
        return {brought(crank, O, O), brought(stands, A, tip), brought(Mat3<double>::Identity(), S, tip + along)};
    }
};

inline Mechanism planar_slider_crank(const PlanarSliderCrank& at) {
    Mechanism m;
    const std::size_t crank = add_part(m, TreeJoint::revolute, 0, at.O, Vec::UnitZ());
    const std::size_t rod = add_part(m, TreeJoint::revolute, crank, at.A, Vec::UnitZ());
    const std::size_t slider = add_part(m, TreeJoint::prismatic, 0, at.S, Vec::UnitX());
    cut_hinge(m, rod, slider, at.S);
    m.suspension.linkage.independent = {0};
    m.poses = [at](double angle) { return at.poses(angle); };
    return m;
}

// A crank about x, a ball at its tip, a rod, a universal joint, a slider along x (R-S-U-P).
struct SpatialSliderCrank {
    Vec A, B, S;        // of the crank, at its tip, on the slider
    Vec first, second;  // axes of the universal joint, the first on the slider
    Poses poses(double angle) const {
        const Mat3<double> crank = turn(Vec::UnitX(), angle);
        const Vec tip = A + crank * (B - A), rod = B - S;
        const double reach = std::sqrt(rod.squaredNorm() - (tip - S).tail<2>().squaredNorm());
        const Vec slider(tip[0] - std::copysign(reach, rod[0]), S[1], S[2]);
        const Mat3<double> stands = on_universal_joint(rod, tip - slider, first, second);
        return {brought(crank, A, A), brought(stands, S, slider), brought(Mat3<double>::Identity(), S, slider)};
    }
};

inline Mechanism spatial_slider_crank(const SpatialSliderCrank& at) {
    Mechanism m;
    const std::size_t crank = add_part(m, TreeJoint::revolute, 0, at.A, Vec::UnitX());
    const std::size_t slider = add_part(m, TreeJoint::prismatic, 0, at.S, Vec::UnitX());
    const std::size_t rod = add_part(m, TreeJoint::universal, slider, at.S, at.first, at.second);
    cut_ball(m, rod, crank, at.B);
    m.suspension.linkage.independent = {0};
    m.poses = [at](double angle) { return at.poses(angle); };
    return m;
}

// Crank about x, ball, coupler, universal joint, rocker about y (R-S-U-R).
struct SpatialFourBar {
    Vec A, B, C, E;     // pivot of the crank, its tip, tip of the rocker, its pivot
    Vec first, second;  // axes of the universal joint, the first on the rocker
    Poses poses(double angle) const {
        const Mat3<double> crank = turn(Vec::UnitX(), angle);
        const Vec tip = A + crank * (B - A);
        const double swing = rocker_angle(tip, std::abs(rocker_angle(B, 1)) < 1e-9 ? 1 : -1);
        const Mat3<double> rocker = turn(Vec::UnitY(), swing);
        const Vec knee = E + rocker * (C - E);
        const Mat3<double> rod = on_universal_joint(B - C, rocker.transpose() * (tip - knee), first, second);
        return {brought(crank, A, A), brought(rocker * rod, C, knee), brought(rocker, E, E)};
    }
    // From |E + R_y (C - E) - tip| = |C - B|: P cos + Q sin = K has two roots; the design's is zero.
    double rocker_angle(const Vec& tip, int root) const {
        const Vec u = C - E, w = E - tip;
        const double P = w[0] * u[0] + w[2] * u[2], Q = w[0] * u[2] - w[2] * u[0];
        const double K = ((C - B).squaredNorm() - u.squaredNorm() - w.squaredNorm()) / 2;
        const double middle = std::atan2(Q, P), half = std::acos(K / std::hypot(P, Q));
        return std::remainder(middle + root * half, 2 * std::numbers::pi);
    }
};

inline Mechanism spatial_four_bar(const SpatialFourBar& at) {
    Mechanism m;
    const std::size_t crank = add_part(m, TreeJoint::revolute, 0, at.A, Vec::UnitX());
    const std::size_t rocker = add_part(m, TreeJoint::revolute, 0, at.E, Vec::UnitY());
    const std::size_t coupler = add_part(m, TreeJoint::universal, rocker, at.C, at.first, at.second);
    cut_ball(m, coupler, crank, at.B);
    m.suspension.linkage.independent = {0};
    m.poses = [at](double angle) { return at.poses(angle); };
    return m;
}

}  // namespace hamilcar::test
