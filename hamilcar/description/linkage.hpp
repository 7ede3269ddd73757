// A linkage of any shape as plain data: parts joined to a tree, and cut joints that close its loops. Part 0 is the chassis
// (or the trailer) that the linkage hangs on; tree joint i carries part i + 1. Everything is given at the design position, in
// the vehicle frame.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hamilcar {

using Point = std::array<double, 3>;  // [m], vehicle frame, or a direction [1]

enum class TreeJoint { revolute, prismatic, universal, spherical, free };

struct TreeJointDescription {
    TreeJoint kind = TreeJoint::revolute;
    std::string part;        // what it carries
    std::size_t parent = 0;  // the part it stands on
    Point point{};           // center of a rotation
    Point axis{};            // of a revolute or prismatic joint, the first of a universal one; unit
    Point second_axis{};     // of a universal joint, on the cross; unit
    std::optional<Point>
        other_bush;  // of a revolute joint with two of them, the point is the first; for pictures and bush forces alone
};

// How many coordinates a tree joint has.
inline int freedoms(TreeJoint kind) {
    switch (kind) {
        case TreeJoint::universal: return 2;
        case TreeJoint::spherical: return 3;
        case TreeJoint::free: return 6;
        default: return 1;
    }
}

// distance: |tip - foot| stays; plane: tip stays in the plane through the foot, across `axis`; line: tip stays on the line
// through the foot along `axis`; revolute_spherical: a massless arm hinged about `axis` through the foot, a ball at the tip;
// spherical: tip and foot stay together.
enum class CutJoint { distance, plane, line, revolute_spherical, spherical };

// How many equations a cut joint has.
inline int equations(CutJoint kind) {
    switch (kind) {
        case CutJoint::line:
        case CutJoint::revolute_spherical: return 2;
        case CutJoint::spherical: return 3;
        default: return 1;
    }
}

struct CutJointDescription {
    CutJoint kind = CutJoint::distance;
    std::string name;                // "tie rod"
    std::size_t part = 1, base = 0;  // what the tip and what the foot sit on
    Point tip{}, foot{};
    Point axis{};                  // on the base; unit
    Point drive{};                 // the rack moves the foot by this times its displacement [1]
    std::optional<double> length;  // of a distance or an arm [m]; from the points if absent
    std::optional<double> offset;  // of an arm's ball from the foot, along the axis [m]; from the points if absent
    std::optional<Point>
        other_bush;  // of an arm with two of them, the foot is the first; for pictures and bush forces alone
};

// Coordinates are those of the tree joints one after the other: angles and lengths, zero at design. A free joint has three
// translations along x, y, z, then the rotations of a spherical one: about z, x', y''.
struct LinkageDescription {
    std::vector<TreeJointDescription> joints;
    std::vector<CutJointDescription> cuts;
    std::vector<int> independent;  // coordinates; chosen from the Jacobian at design if empty

    int coordinate_count() const {
        int count = 0;
        for (const TreeJointDescription& joint : joints) count += freedoms(joint.kind);
        return count;
    }
    int equation_count() const {
        int count = 0;
        for (const CutJointDescription& cut : cuts) count += equations(cut.kind);
        return count;
    }
    // Whether a coordinate is an angle [rad]; else it is a length [m].
    bool turns(int coordinate) const {
        for (const TreeJointDescription& joint : joints) {
            const int own = freedoms(joint.kind);
            if (coordinate < own) {
                const bool slides = joint.kind == TreeJoint::free ? coordinate < 3 : joint.kind == TreeJoint::prismatic;
                return !slides;
            }
            coordinate -= own;
        }
        return false;
    }
};

}  // namespace hamilcar
