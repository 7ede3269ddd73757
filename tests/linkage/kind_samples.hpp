// Small linkages for cases that the recipes do not cover: every kind of tree joint behind every other, and every kind of cut joint
// between two parts that move, driven by the rack. Rods to the chassis leave them three degrees of freedom.
#pragma once

#include <algorithm>

#include "linkage/samples.hpp"
#include "support/mechanisms.hpp"

namespace hamilcar::test {

struct NamedTreeJoint {
    const char* name;
    TreeJoint kind;
};
inline constexpr std::array tree_joints{
    NamedTreeJoint{"revolute", TreeJoint::revolute}, NamedTreeJoint{"prismatic", TreeJoint::prismatic},
    NamedTreeJoint{"universal", TreeJoint::universal}, NamedTreeJoint{"spherical", TreeJoint::spherical},
    NamedTreeJoint{"free", TreeJoint::free}};

struct NamedCutJoint {
    const char* name;
    CutJoint kind;
};
inline constexpr std::array cut_joints{NamedCutJoint{"distance", CutJoint::distance},
                                       NamedCutJoint{"plane", CutJoint::plane}, NamedCutJoint{"line", CutJoint::line},
                                       NamedCutJoint{"revolute_spherical", CutJoint::revolute_spherical},
                                       NamedCutJoint{"spherical", CutJoint::spherical}};

// A joint of that kind, with axes that are parallel to nothing.
inline TreeJointDescription tree_joint(TreeJoint kind, std::size_t parent, const Vec3<double>& at,
                                       const Vec3<double>& along) {
    const Mat3<double> axes = axes_along(along);
    return {kind, "part", parent, point(at), point(axes.col(0)), point(axes.col(1)), {}};
}

// Rods to the chassis, 0.5 m long: any first few of them hold a free part in as many directions, six hold it fast, the
// last three an inner part in three.
inline CutJointDescription rod(std::size_t part, std::size_t i) {
    struct Line {
        Vec3<double> tip, along;
    };
    static const std::array<Line, 9> rods{{{{0.55, 0.6, 0.75}, {0.1, 1, -0.2}},
                                           {{0.5, 0.05, 0.35}, {0.2, -0.1, 1}},
                                           {{0.1, 1.0, -0.1}, {1, 0.2, 0.1}},
                                           {{-0.45, 0.6, 0.3}, {-0.1, 0.15, 1}},
                                           {{-0.4, 0.5, 0.0}, {-0.2, 1, 0.1}},
                                           {{0.1, 1.1, 0.3}, {0.1, 0.2, 1}},
                                           {{0.4, 0.3, -0.1}, {0.1, 1, 0.2}},
                                           {{0.3, 0.0, 0.3}, {-0.2, 0.1, 1}},
                                           {{0.0, -0.1, 0.7}, {1, -0.1, 0.2}}}};
    CutJointDescription out;
    out.part = part, out.tip = point(rods[i].tip), out.foot = point(rods[i].tip + 0.5 * rods[i].along.normalized());
    return out;
}

// The second joint's part on the first's; rods remove all but three degrees of freedom, from the outer part first.
inline LinkageSample joint_on_joint(const NamedTreeJoint& outer, const NamedTreeJoint& inner) {
    LinkageSample out;
    out.name = std::string(outer.name) + "_behind_" + inner.name;
    out.linkage.joints = {tree_joint(inner.kind, 0, {-0.05, 0.3, 0.25}, {0.9, 0.3, -0.2}),
                          tree_joint(outer.kind, 1, {0.05, 0.55, 0.3}, {0.8, 0.5, 0.3})};
    const int rods = std::max(0, out.linkage.coordinate_count() - max_freedoms);
    for (std::size_t i = 0; i < static_cast<std::size_t>(rods); ++i) {
        out.linkage.cuts.push_back(rod(i < 6 ? 2 : 1, i));
    }
    if (rods > 0) out.linkage.cuts[0].drive = {0, 1, 0};
    return out;
}

// A free part whose point `tip` is held against a part that swings.
inline LinkageSample cut_between_parts(const NamedCutJoint& joint) {
    const Vec3<double> foot(0.1, 0.4, 0.35), axis = Vec3<double>(0.9, 0.3, 0.2).normalized();
    const Vec3<double> aside = axis.unitOrthogonal();
    CutJointDescription cut;
    cut.kind = joint.kind, cut.part = 2, cut.base = 1;
    cut.foot = point(foot), cut.axis = point(axis), cut.drive = {0.3, 0.9, -0.2};
    switch (joint.kind) {
        case CutJoint::distance:
        case CutJoint::revolute_spherical: cut.tip = point(foot + 0.05 * axis + 0.3 * aside); break;
        case CutJoint::plane: cut.tip = point(foot + 0.3 * aside); break;
        case CutJoint::line: cut.tip = point(foot + 0.1 * axis); break;
        case CutJoint::spherical: cut.tip = cut.foot; break;
    }
    LinkageSample out;
    out.name = std::string("cut_") + joint.name;
    out.linkage.joints = {tree_joint(TreeJoint::revolute, 0, {-0.05, 0.3, 0.25}, {0.9, 0.3, -0.2}),
                          tree_joint(TreeJoint::free, 0, {0.05, 0.55, 0.3}, {})};
    out.linkage.cuts = {cut};
    for (std::size_t i = 0; out.linkage.equation_count() < 4; ++i) out.linkage.cuts.push_back(rod(2, i));
    return out;
}

inline std::vector<LinkageSample> kind_samples() {
    std::vector<LinkageSample> all;
    for (const NamedTreeJoint& inner : tree_joints) {
        for (const NamedTreeJoint& outer : tree_joints) all.push_back(joint_on_joint(outer, inner));
    }
    for (const NamedCutJoint& cut : cut_joints) all.push_back(cut_between_parts(cut));
    return all;
}

}  // namespace hamilcar::test
