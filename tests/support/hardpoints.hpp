// The paper's two suspensions by their hardpoints, read back from the linkage that a recipe made of them: for tests with
// equations of their own.
#pragma once

#include <optional>
#include <variant>

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar::test {

// Spherical joint and slide, plus a massless control arm and a tie rod: the paper's Fig. 3.
struct MacPhersonPoints {
    Point strut_top{};      // T, on the chassis
    Point slide_point{};    // S, on the spindle; the strut slides along S -> T and its length is |T - S|
    Point arm_front{};      // A1, control arm axis, front bush
    Point arm_rear{};       // A2, control arm axis, rear bush
    Point ball_joint{};     // C, on the spindle
    Point rack_end{};       // R, tie rod inner end at rack displacement 0
    Point tie_rod_outer{};  // Q, on the spindle
    Point rack_axis{};      // unit; a positive rack displacement moves R along it; zero if it is not steered
    std::optional<double> arm_length, tie_rod_length;  // [m]; from the points if absent
};

// One revolute joint: the paper's Fig. 4.
struct SemiTrailingArmPoints {
    Point inner_bush{}, outer_bush{};
    Point spring_arm{}, spring_body{};  // spring seats on arm and chassis
    Point damper_arm{}, damper_body{};  // damper mounts on arm and chassis
};

using PaperPoints = std::variant<MacPhersonPoints, SemiTrailingArmPoints>;

inline MacPhersonPoints strut_points(const SuspensionDescription& d) {
    const TreeJointDescription &top = d.linkage.joints.at(0), &slide = d.linkage.joints.at(1);
    const CutJointDescription &arm = d.linkage.cuts.at(0), &rod = d.linkage.cuts.at(1);
    return {top.point, slide.point, arm.foot,  arm.other_bush.value(), arm.tip, rod.foot, rod.tip,
            rod.drive, arm.length,  rod.length};
}

inline SemiTrailingArmPoints arm_points(const SuspensionDescription& d) {
    const TreeJointDescription& hinge = d.linkage.joints.at(0);
    const LineDescription &spring = d.springs.at(0).line, &damper = d.dampers.at(0).line;
    return {hinge.other_bush.value(), hinge.point, spring.on_part, spring.on_base, damper.on_part, damper.on_base};
}

// The suspension of the paper's car with this keyword.
inline PaperPoints paper_points(const SuspensionDescription& d) {
    if (d.keyword == "macpherson") return strut_points(d);
    return arm_points(d);
}

}  // namespace hamilcar::test
