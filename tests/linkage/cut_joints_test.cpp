// The kinds of cut joints, on a part that is otherwise free: where they are closed, and their violation elsewhere in
// meters. Their gradients and rates: linkage_test.cpp.
#include <gtest/gtest.h>

#include <numbers>

#include "linkage/kind_samples.hpp"
#include "linkage/moving.hpp"

namespace hamilcar {
namespace {

using Directions = std::vector<Vec3<double>>;

const Vec3<double> foot(0.1, 0.3, 0.2), axis = Vec3<double>(0.96, 0.2, 0.1).normalized();
const Vec3<double> across = axis.unitOrthogonal(), third = axis.cross(across);
const Vec3<double> drive(0.1, 0.99, -0.05);
constexpr double arm_length = 0.35;

// A free part whose point `tip` one cut joint holds.
class HeldPoint {
public:
    HeldPoint(CutJoint kind, const Vec3<double>& tip) {
        description_.joints = {test::tree_joint(TreeJoint::free, 0, tip, {})};
        CutJointDescription cut;
        cut.kind = kind, cut.tip = test::point(tip), cut.foot = test::point(foot);
        cut.axis = test::point(axis), cut.drive = test::point(drive);
        description_.cuts = {cut};
    }
    // Of all its equations together, with the part turned about the tip and the tip moved.
    double violation(const Vec3<double>& shift, double rack = 0) const {
        const test::MovingLinkage held(description_);
        const LinkagePosition<double> at = held.loops({shift[0], shift[1], shift[2], 0.4, -0.3, 0.7}, {rack, 0, 0});
        double square = 0;
        for (int e = 0; e < held.linkage().nW(); ++e) {
            const double one = held.linkage().violation(e, at);
            square += one * one;
        }
        return std::sqrt(square);
    }

private:
    LinkageDescription description_;
};

struct Case {
    const char* name;
    CutJoint kind;
    Vec3<double> tip;
    Directions free, held;  // of small motions of the tip; unit
};
void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}
std::vector<Case> cases() {
    const Vec3<double> rod = Vec3<double>(0.1, 0.9, 0.2).normalized(), aside = rod.unitOrthogonal();
    return {{"distance", CutJoint::distance, foot + 0.4 * rod, {aside, rod.cross(aside)}, {rod}},
            {"plane", CutJoint::plane, foot + 0.2 * across, {across, third}, {axis}},
            {"line", CutJoint::line, foot + 0.2 * axis, {axis}, {across, third}},
            {"revolute_spherical",
             CutJoint::revolute_spherical,
             foot + 0.1 * axis + arm_length * across,
             {third},
             {axis, across}},
            {"spherical", CutJoint::spherical, foot, {}, {axis, across, third}}};
}

class CutJoints : public testing::TestWithParam<Case> {};

TEST_P(CutJoints, AreClosedAtDesignHoweverThePartIsTurned) {
    EXPECT_LE(HeldPoint(GetParam().kind, GetParam().tip).violation(Vec3<double>::Zero()), 1e-15);
}

// To second order in the motion over the length of the rod or arm.
TEST_P(CutJoints, OpenByAsManyMetersAsTheTipIsMovedWhereTheyHold) {
    const HeldPoint held(GetParam().kind, GetParam().tip);
    constexpr double moved = 1e-4, second_order = moved * moved / arm_length;
    for (const double sense : {1.0, -1.0}) {
        for (const Vec3<double>& d : GetParam().held) {
            EXPECT_NEAR(held.violation(sense * moved * d), moved, second_order);
        }
        for (const Vec3<double>& d : GetParam().free) EXPECT_LE(held.violation(sense * moved * d), second_order);
    }
    const Directions& all = GetParam().held;
    if (all.size() < 2) return;
    EXPECT_NEAR(held.violation(moved * (all.front() + all.back())), moved * std::numbers::sqrt2, second_order);
}

TEST_P(CutJoints, GoWithTheRack) {
    const HeldPoint held(GetParam().kind, GetParam().tip);
    EXPECT_LE(held.violation(0.02 * drive, 0.02), 1e-15);
    EXPECT_GT(held.violation(Vec3<double>::Zero(), 0.02), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Kinds, CutJoints, testing::ValuesIn(cases()),
                         [](const auto& one) { return std::string(one.param.name); });

// However far the tip goes where it may.
TEST(CutJoint, StaysClosedOverItsWholeFreedom) {
    const std::vector<Case> all = cases();
    const auto held = [&](std::size_t i) { return HeldPoint(all[i].kind, all[i].tip); };
    const Vec3<double> rod = all[0].tip - foot;
    EXPECT_LE(held(0).violation(test::turn(Vec3<double>(0.3, 0.1, 0.9).normalized(), 0.8) * rod - rod), 1e-15);
    EXPECT_LE(held(1).violation(0.3 * across - 0.5 * third), 1e-15);
    EXPECT_LE(held(2).violation(-0.5 * axis), 1e-15);
    const Vec3<double> arm = arm_length * across;
    EXPECT_LE(held(3).violation(test::turn(axis, 0.8) * arm - arm), 1e-15);
}

}  // namespace
}  // namespace hamilcar
