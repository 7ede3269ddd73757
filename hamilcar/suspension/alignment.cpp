#include "hamilcar/suspension/alignment.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/linkage/compose.hpp"
#include "hamilcar/math/dense.hpp"
#include "hamilcar/suspension/moved_parts.hpp"

namespace hamilcar {

namespace {

constexpr double closed = 1e-12;       // violation of a linkage that counts as none [m]
constexpr double reached = 1e-10;      // of heights [m] and angles [rad]
constexpr double difference = 1e-6;    // for slopes [m, rad]
constexpr double largest_step = 0.05;  // of an unknown [m, rad]

Point plus(const Point& a, const Vec3<double>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

// Links and arms stay as long as they are, wherever their ends are moved.
void keep_lengths(LinkageDescription& linkage) {
    for (CutJointDescription& cut : linkage.cuts) {
        const Vec3<double> span = vec3(cut.tip) - vec3(cut.foot), axis = vec3(cut.axis);
        if (cut.kind == CutJoint::distance && !cut.length) cut.length = span.norm();
        if (cut.kind != CutJoint::revolute_spherical) continue;
        if (!cut.length) cut.length = (span - axis * axis.dot(span)).norm();
        if (!cut.offset) cut.offset = axis.dot(span);
    }
}

void shim(CutJointDescription& cut, const Vec3<double>& by) {
    cut.foot = plus(cut.foot, by);
    if (cut.other_bush) cut.other_bush = plus(*cut.other_bush, by);
}

// A link that is a part of its own is longer where its outer ball sits farther out.
void lengthen(LinkageDescription& linkage, const TreeJointDescription& link, double amount) {
    const auto ball = std::ranges::find(linkage.cuts, link.part + " ball", &CutJointDescription::name);
    ball->foot = plus(ball->foot, (vec3(ball->foot) - vec3(link.point)).normalized() * amount);
}

void adjust(SuspensionDescription& suspension, const Adjuster& adjuster, double amount) {
    LinkageDescription& linkage = suspension.linkage;
    const auto cut = std::ranges::find(linkage.cuts, adjuster.joint, &CutJointDescription::name);
    if (cut != linkage.cuts.end()) {
        if (adjuster.shift) return shim(*cut, vec3(*adjuster.shift) * amount);
        *cut->length += amount;
        return;
    }
    const auto joint = std::ranges::find(linkage.joints, adjuster.joint, &TreeJointDescription::part);
    if (!adjuster.shift) return lengthen(linkage, *joint, amount);
    const std::size_t part = 1 + static_cast<std::size_t>(joint - linkage.joints.begin());
    suspension = with_parts_moved(suspension, shifted(linkage, part, vec3(*adjuster.shift) * amount));
}

// What is unknown: the independent coordinates, and how much is turned or shimmed.
class Alignment {
public:
    Alignment(const SuspensionDescription& suspension, const Composition& composition,
              const std::vector<AlignmentTargets>& targets)
        : from_(suspension), design_(suspension), kingpin_(composition.kingpin), targets_(targets) {
        design_.linkage.independent = compose(suspension.linkage).independent;
        keep_lengths(design_.linkage);
        for (const Adjuster& one : composition.adjusters) {
            const auto angle = static_cast<std::size_t>(one.sets);
            if (std::ranges::any_of(targets, [&](const auto& wheel) { return wheel[angle].has_value(); }))
                adjusters_.push_back(one);
        }
        x_ = Eigen::VectorXd::Zero(freedoms() + static_cast<Eigen::Index>(adjusters_.size()));
    }

    // Newton's method with slopes by differences.
    bool solve() {
        constexpr int most = 40;
        std::optional<Eigen::VectorXd> left = residual(x_);
        for (int i = 0; left && i < most; ++i) {
            if (left->size() != x_.size()) return false;
            if (left->lpNorm<Eigen::Infinity>() < reached) return true;
            const auto step = newton_step(*left);
            if (!step) return false;
            x_ -= *step;
            left = residual(x_);
        }
        return false;
    }

    SuspensionDescription aligned() const {
        const Stand stand = *stand_at(x_);
        SuspensionDescription out = with_parts_moved(stand.suspension, stand.poses);
        for (std::size_t i = 0; i < out.linkage.cuts.size(); ++i) {  // from the points, where it was
            if (!from_.linkage.cuts[i].length) out.linkage.cuts[i].length.reset();
            if (!from_.linkage.cuts[i].offset) out.linkage.cuts[i].offset.reset();
        }
        move_along_coordinates(stand.q, out);
        for (std::size_t i = 0; i < out.springs.size(); ++i) {
            SpringDescription& spring = out.springs[i].spring;
            const double longer = length_of_line(out.springs[i].line) - length_of_line(design_.springs[i].line);
            if (!spring.carries) spring.force_at_design -= spring.rate * longer;
        }
        return out;
    }

private:
    struct Stand {
        SuspensionDescription suspension;  // adjusted, its loops open where it stands
        std::vector<Pose<double>> poses;   // of its parts, with the loops closed
        std::vector<double> q;
    };
    Eigen::Index freedoms() const { return static_cast<Eigen::Index>(design_.linkage.independent.size()); }

    std::optional<Stand> stand_at(const Eigen::VectorXd& x) const {
        Stand out{design_, {}, {}};
        for (std::size_t i = 0; i < adjusters_.size(); ++i) {
            adjust(out.suspension, adjusters_[i], x[freedoms() + static_cast<Eigen::Index>(i)]);
        }
        const Linkage<double> linkage = compose(out.suspension.linkage);
        std::array<double, max_coordinates> V{}, W{};
        std::copy_n(x.data(), freedoms(), V.begin());
        LinkagePosition<double> at;
        const auto open = [&] {
            linkage.find_loops(V.data(), W.data(), {}, at);
            double most = 0;
            for (int e = 0; e < linkage.nW(); ++e) most = std::max(most, linkage.violation(e, at));
            return most;
        };
        constexpr int most = 30;
        int i = 0;
        for (; !(open() < closed) && i < most; ++i) linkage.newton_step(V.data(), W.data(), {});
        if (i == most) return {};
        for (std::size_t part = 0; part <= out.suspension.linkage.joints.size(); ++part) {
            const auto frame = static_cast<std::size_t>(frame_of_part(out.suspension.linkage, part));
            out.poses.push_back(at.pose[frame].pose());
        }
        for (int k = 0; k < linkage.nq(); ++k) out.q.push_back(linkage.value(k, V.data(), W.data()));
        return out;
    }

    // Heights of the wheels' centers, then what is missing to each target.
    std::optional<Eigen::VectorXd> residual(const Eigen::VectorXd& x) const {
        const std::optional<Stand> stand = stand_at(x);
        if (!stand) return {};
        std::vector<double> out;
        for (std::size_t i = 0; i < design_.wheels.size(); ++i) {
            const SuspensionWheelDescription& wheel = stand->suspension.wheels[i];
            out.push_back(stand->poses[wheel.part].point(vec3(wheel.wheel.center))[2] -
                          design_.wheels[i].wheel.center[2]);
        }
        for (std::size_t i = 0; i < design_.wheels.size(); ++i) {
            const std::array<double, wheel_angle_names.size()> angles = angles_of(*stand, i);
            for (std::size_t k = 0; k < angles.size(); ++k) {
                if (targets_[i][k]) out.push_back(angles[k] - *targets_[i][k]);
            }
        }
        return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
    }

    std::array<double, wheel_angle_names.size()> angles_of(const Stand& stand, std::size_t i) const {
        const SuspensionWheelDescription& wheel = stand.suspension.wheels[i];
        const double outward = wheel.wheel.center[1] < 0 ? -1 : 1;
        const Vec3<double> axis = stand.poses[wheel.part].direction(vec3(wheel.wheel.spin_axis).normalized());
        const auto end = [&](const PartEnd& of) {
            // Where the joint stands after shims: points of the kingpin are points of the joints at design.
            return stand.poses[of.part].point(vec3(of.point) + moved_by(stand.suspension, of));
        };
        const Vec3<double> upward = end(kingpin_[1]) - end(kingpin_[0]);
        return {outward * std::atan2(axis[0], axis[1]), -outward * std::asin(axis[2]),
                std::atan2(-upward[0], upward[2])};
    }
    // How far shims have moved that part.
    Vec3<double> moved_by(const SuspensionDescription& adjusted, const PartEnd& of) const {
        if (of.part == 0) return Vec3<double>::Zero();
        return vec3(adjusted.linkage.joints[of.part - 1].point) - vec3(design_.linkage.joints[of.part - 1].point);
    }

    // Nothing where the linkage does not close nearby, or no slope leads on.
    std::optional<Eigen::VectorXd> newton_step(const Eigen::VectorXd& left) const {
        Eigen::MatrixXd slopes(left.size(), x_.size());
        for (Eigen::Index k = 0; k < x_.size(); ++k) {
            const Eigen::VectorXd way = Eigen::VectorXd::Unit(x_.size(), k) * difference;
            const auto above = residual(x_ + way), below = residual(x_ - way);
            if (!above || !below) return {};
            slopes.col(k) = (*above - *below) / (2 * difference);
        }
        const Eigen::VectorXd step = shortest_least_squares(slopes, left);
        if (!step.allFinite()) return {};
        return step * std::min(1.0, largest_step / step.lpNorm<Eigen::Infinity>());
    }

    static double length_of_line(const LineDescription& line) {
        return line.coordinate ? line.at_design : (vec3(line.on_part) - vec3(line.on_base)).norm();
    }
    static void move_along_coordinates(const std::vector<double>& q, SuspensionDescription& out) {
        const auto move = [&](LineDescription& line) {
            if (line.coordinate) line.at_design += q[static_cast<std::size_t>(*line.coordinate)];
        };
        for (auto& spring : out.springs) move(spring.line);
        for (auto& damper : out.dampers) move(damper.line);
    }

    SuspensionDescription from_, design_;  // as described; with lengths that stay
    std::array<PartEnd, 2> kingpin_;
    std::vector<AlignmentTargets> targets_;
    std::vector<Adjuster> adjusters_;
    Eigen::VectorXd x_;
};

}  // namespace

bool can_set(const Composition& composition, WheelAngle angle) {
    return std::ranges::find(composition.adjusters, angle, &Adjuster::sets) != composition.adjusters.end();
}

std::optional<std::string> align(SuspensionDescription& suspension, const Composition& composition,
                                 const std::vector<AlignmentTargets>& targets) {
    Alignment alignment(suspension, composition, targets);
    if (!alignment.solve()) return "angles that its linkage can be set to";
    suspension = alignment.aligned();
    return {};
}

}  // namespace hamilcar
