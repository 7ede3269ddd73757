#include "hamilcar/analysis/joint_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/linkage/compose.hpp"

namespace hamilcar {

namespace {

using Multipliers = std::array<double, max_equations>;
using Coordinates = std::array<double, max_coordinates>;

bool moves(const Linkage<double>& linkage, int coordinate, int frame) {
    return (linkage.path[static_cast<std::size_t>(frame)] >> coordinate) & 1;
}

// The linkage where it stands, everything beyond a coordinate moved along `motion` about the anchor and the rest held.
LinkagePosition<double> moved(const Linkage<double>& linkage, const LinkagePosition<double>& at, int coordinate,
                              const Spatial<double>& motion) {
    LinkagePosition<double> out = at;
    out.X.fill(0);
    for (int frame = 0; frame <= linkage.nq(); ++frame) {
        const auto f = static_cast<std::size_t>(frame);
        out.own.x[f] = moves(linkage, coordinate, frame) ? motion : Spatial<double>(Spatial<double>::Zero());
        const Vec3<double> turned = angular(out.own.x[f]);
        out.motion.x[f] = spatial<double>(linear(out.own.x[f]) - turned.cross(linkage.anchor()), turned);
    }
    return out;
}

// What is unbalanced along one tree coordinate, the cut joints open.
double along_coordinate(const Unbalanced& of, std::size_t suspension, const LinkagePosition<double>& at, int k) {
    const Linkage<double>& linkage = of.vehicle().suspensions[suspension].linkage;
    LinkagePosition<double> column = moved(linkage, at, k, at.B[static_cast<std::size_t>(k)]);
    column.X[static_cast<std::size_t>(k)] = 1;
    return of.along(suspension, column);
}

// Phi_w^T lambda = what is unbalanced along the dependent coordinates.
Multipliers multipliers(const Linkage<double>& linkage, const LinkagePosition<double>& at,
                        const Coordinates& unbalanced) {
    Multipliers lambda{};
    for (int e = 0; e < linkage.nW(); ++e) {
        for (int i = 0; i < linkage.nW(); ++i) {
            const auto k = static_cast<std::size_t>(linkage.dependent[static_cast<std::size_t>(i)]);
            lambda[static_cast<std::size_t>(e)] += at.Phi_w_inverse(i, e) * unbalanced[k];
        }
    }
    return lambda;
}

// What a tree joint gives along a motion, about the anchor, of all that it carries from its first coordinate on.
double joint_load(const Unbalanced& of, std::size_t suspension, const LinkagePosition<double>& at,
                  const Multipliers& lambda, int first, const Spatial<double>& motion) {
    const Linkage<double>& linkage = of.vehicle().suspensions[suspension].linkage;
    double load = of.along(suspension, moved(linkage, at, first, motion));
    for (int e = 0; e < linkage.nW(); ++e) {
        const auto n = static_cast<std::size_t>(e);
        load -= linkage.sign(e, first) * lambda[n] * at.wrench[n].dot(motion);
    }
    return load;
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();
BushForces no_bushes() {
    const Vec3<double> nothing = Vec3<double>::Constant(none);
    return {nothing, nothing};
}

// A force, and its moment about the first bush, on two bushes that far apart.
BushForces on_two_bushes(const Vec3<double>& force, const Vec3<double>& moment, const Vec3<double>& apart) {
    const Vec3<double> axis = apart.normalized();
    const Vec3<double> second = moment.cross(apart) / apart.squaredNorm() + 0.5 * axis * axis.dot(force);
    return {force - second, second};
}

// A tree joint's force on what it carries, and that of its two bushes.
void add_joint(const Unbalanced& of, std::size_t suspension, const LinkageDescription& description, std::size_t i,
               const LinkagePosition<double>& at, const Multipliers& lambda, JointForces& out) {
    const TreeJointDescription& joint = description.joints[i];
    const int first = frame_of_part(description, i);  // coordinate: behind those of the joints before
    Vec3<double> force = Vec3<double>::Zero();
    const auto load = [&](const Vec3<double>& shift, const Vec3<double>& turn) {
        return joint_load(of, suspension, at, lambda, first, spatial<double>(shift, turn));
    };
    const auto unit = [](int c) { return Vec3<double>(Vec3<double>::Unit(c)); };
    if (joint.kind != TreeJoint::free) {
        for (int c = 0; c < 3; ++c) force[c] = load(unit(c), Vec3<double>::Zero());
    }
    out.joints.emplace_back(force);
    BushForces& bushes = out.joint_bushes.emplace_back(no_bushes());
    if (!joint.other_bush) return;
    const Placement<double>& pose = at.pose[static_cast<std::size_t>(frame_of_part(description, i + 1))];
    const Vec3<double> bush = pose.point(vec3(joint.point));
    const Vec3<double> arm = bush - of.vehicle().suspensions[suspension].linkage.anchor();
    Vec3<double> moment;
    for (int c = 0; c < 3; ++c) moment[c] = load(arm.cross(unit(c)), unit(c));
    bushes = on_two_bushes(force, moment, pose.point(vec3(*joint.other_bush)) - bush);
}

void add_cuts(const LinkageDescription& description, const LinkagePosition<double>& at, const Multipliers& lambda,
              JointForces& out) {
    std::size_t e = 0;
    for (const CutJointDescription& cut : description.cuts) {
        Vec3<double> force = Vec3<double>::Zero();
        const bool is_link = cut.kind == CutJoint::distance;
        out.tension.emplace_back(is_link ? -lambda[e] * at.gradient[e].norm() : none);
        for (int i = 0; i < equations(cut.kind); ++i, ++e) force += lambda[e] * at.gradient[e];
        out.cuts.emplace_back(force);
        BushForces& bushes = out.cut_bushes.emplace_back(no_bushes());
        if (!cut.other_bush) continue;
        const auto point_of = [&](std::size_t part, const Point& point) {
            return at.pose[static_cast<std::size_t>(frame_of_part(description, part))].point(vec3(point));
        };
        const Vec3<double> bush = point_of(cut.base, cut.foot), ball = point_of(cut.part, cut.tip);
        bushes = on_two_bushes(force, (ball - bush).cross(force), point_of(cut.base, *cut.other_bush) - bush);
    }
}

}  // namespace

JointForces joint_forces(const Unbalanced& of, std::size_t suspension, const LinkageDescription& description) {
    const Linkage<double>& linkage = of.vehicle().suspensions[suspension].linkage;
    const LinkagePosition<double> at = of.position(suspension, 0);
    Coordinates unbalanced{};
    for (int k = 0; k < linkage.nq(); ++k) {
        unbalanced[static_cast<std::size_t>(k)] = along_coordinate(of, suspension, at, k);
    }
    const Multipliers lambda = multipliers(linkage, at, unbalanced);
    JointForces out;
    add_cuts(description, at, lambda, out);
    for (std::size_t i = 0; i < description.joints.size(); ++i) {
        add_joint(of, suspension, description, i, at, lambda, out);
    }
    for (const int k : linkage.independent) {
        double left = unbalanced[static_cast<std::size_t>(k)];
        for (int e = 0; e < linkage.nW(); ++e) left -= lambda[static_cast<std::size_t>(e)] * linkage.entry(at, e, k);
        out.unbalanced = std::max(out.unbalanced, std::abs(left));
    }
    return out;
}

void joint_forces(const Unbalanced& of, const VehicleDescription& description, VehicleJointForces& out) {
    for (std::size_t s = 0; s < description.suspensions.size(); ++s) {
        out.emplace_back() = joint_forces(of, s, description.suspensions[s].linkage);
    }
}

}  // namespace hamilcar
