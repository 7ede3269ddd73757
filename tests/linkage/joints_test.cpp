// What the kinds of tree joints mean: turns and slides of the child against the parent in the order that the description
// promises, far from design, alone and behind every other kind. Their columns and rates: linkage_test.cpp.
#include <gtest/gtest.h>

#include "linkage/kind_samples.hpp"
#include "linkage/moving.hpp"

namespace hamilcar {
namespace {

constexpr double exact = 1e-15;

// Of the child in the parent, from one rotation matrix after the other.
Pose<double> stands(const TreeJointDescription& joint, const double* q) {
    const Vec3<double> at = vec3(joint.point), axis = vec3(joint.axis);
    const auto spherical = [](const double* angles) {
        return Mat3<double>(test::turn(Vec3<double>::UnitZ(), angles[0]) *
                            test::turn(Vec3<double>::UnitX(), angles[1]) *
                            test::turn(Vec3<double>::UnitY(), angles[2]));
    };
    switch (joint.kind) {
        case TreeJoint::revolute: return test::brought(test::turn(axis, q[0]), at, at);
        case TreeJoint::prismatic: return {Mat3<double>::Identity(), axis * q[0]};
        case TreeJoint::universal:
            return test::brought(test::turn(axis, q[0]) * test::turn(vec3(joint.second_axis), q[1]), at, at);
        case TreeJoint::spherical: return test::brought(spherical(q), at, at);
        case TreeJoint::free: return test::brought(spherical(q + 3), at, at + Vec3<double>(q[0], q[1], q[2]));
    }
    return {};
}

TEST(TreeJoints, TurnAndSlideInTheirOrderBehindEveryOther) {
    std::array<double, max_coordinates> q;
    for (int k = 0; k < max_coordinates; ++k) q[k] = 0.9 * std::sin(1.3 * k + 0.4);
    for (const auto& inner : test::tree_joints) {
        for (const auto& outer : test::tree_joints) {
            const test::LinkageSample sample = test::joint_on_joint(outer, inner);
            const std::vector<TreeJointDescription>& joints = sample.linkage.joints;
            const LinkagePosition<double> at = test::MovingLinkage(sample.linkage).loops(q, {});
            const Pose<double> first = stands(joints[0], q.data());
            const Pose<double> second = stands(joints[1], q.data() + freedoms(joints[0].kind));
            const Pose<double> both{first.R * second.R, first.point(second.p)};
            const auto pose = [&](std::size_t part) {
                return at.pose[static_cast<std::size_t>(frame_of_part(sample.linkage, part))].pose();
            };
            EXPECT_LE(test::difference(pose(1), first), exact) << sample.name;
            EXPECT_LE(test::difference(pose(2), both), exact) << sample.name;
        }
    }
}

}  // namespace
}  // namespace hamilcar
