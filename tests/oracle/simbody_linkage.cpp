// A strut's linkage written in another way: with its spindle free in space and every joint a constraint, or without the
// links, which a constraint for the whole car stands for.

#include <algorithm>

#include "support/hardpoints.hpp"
#include "tests/oracle/simbody_parts.hpp"

namespace hamilcar::oracle {

using SimTK::Rotation;
using SimTK::Vec3;

namespace {

// A strut's coordinates are its angles and its slide, a free spindle's three translations of the top and the same angles.
constexpr std::size_t slide = 3, top = 0, first_angle_when_free = 3;

// From the top toward the spindle, at design.
Vec3 slide_axis(const SuspensionDescription& description) {
    return to_vec3(description.linkage.joints.at(1).axis);
}

// Angles about z, x', y'' and their rates.
struct Turn {
    Turn(const TreeState& at, std::size_t first)
        : yawed(at.coordinates.at(first), SimTK::ZAxis),
          rolled(yawed * Rotation(at.coordinates.at(first + 1), SimTK::XAxis)),
          rotation(rolled * Rotation(at.coordinates.at(first + 2), SimTK::YAxis)),
          rate(at.rates.at(first) * Vec3(yawed.z()) + at.rates.at(first + 1) * Vec3(yawed.x()) +
               at.rates.at(first + 2) * Vec3(rolled.y())) {}

    Rotation yawed, rolled, rotation;
    Vec3 rate;
};

// The spindle's frame sits at the top, through which its slide axis runs. It is part 1; nothing sits on the piston rod.
SuspensionDescription with_free_spindle(SuspensionDescription description) {
    const test::MacPhersonPoints strut = test::strut_points(description);
    TreeJointDescription in_space;
    in_space.kind = TreeJoint::free, in_space.part = "carrier", in_space.point = strut.strut_top;
    CutJointDescription sliding;
    sliding.kind = CutJoint::line, sliding.name = "strut", sliding.part = 0, sliding.base = 1;
    sliding.tip = strut.strut_top, sliding.foot = strut.slide_point;
    sliding.axis = description.linkage.joints.at(1).axis;
    const auto renumber = [](std::size_t& part) { part = std::min<std::size_t>(part, 1); };
    const auto move = [&](LineDescription& line) {
        if (line.coordinate) line = {1, 0, strut.slide_point, strut.strut_top, {}};
        renumber(line.part), renumber(line.base);
    };
    for (CutJointDescription& cut : description.linkage.cuts) renumber(cut.part), renumber(cut.base);
    description.linkage.joints = {in_space};
    description.linkage.cuts.push_back(sliding);
    for (auto& body : description.bodies) renumber(body.part);
    for (auto& wheel : description.wheels) renumber(wheel.part), renumber(wheel.drive_reaction);
    for (auto& spring : description.springs) move(spring.line);
    for (auto& damper : description.dampers) move(damper.line);
    return description;
}

}  // namespace

bool is_strut(const SuspensionDescription& description) {
    return description.keyword == "macpherson";
}

SuspensionDescription modelled(const SuspensionDescription& description, SpindleModel model) {
    if (!is_strut(description) || model == SpindleModel::strut) return description;
    if (model == SpindleModel::free) return with_free_spindle(description);
    SuspensionDescription out = description;
    out.linkage.cuts.clear();
    return out;
}

TreeState freed(const SuspensionDescription& description, const TreeState& strut) {
    const Turn turn(strut, 0);
    const Vec3 axis = turn.rotation * slide_axis(description);
    const double length = strut.coordinates.at(slide);
    const Vec3 at = length * axis, moving = strut.rates.at(slide) * axis + length * (turn.rate % axis);
    TreeState spindle{{at[0], at[1], at[2]}, {moving[0], moving[1], moving[2]}, {}};
    for (std::size_t k = 0; k < slide; ++k) {
        spindle.coordinates.push_back(strut.coordinates[k]);
        spindle.rates.push_back(strut.rates[k]);
    }
    return spindle;
}

TreeState on_its_strut(const SuspensionDescription& description, const TreeState& spindle) {
    const Vec3 axis = Turn(spindle, first_angle_when_free).rotation * slide_axis(description);
    const auto along = [&](const std::vector<double>& of) { return ~axis * Vec3(of[top], of[top + 1], of[top + 2]); };
    const auto angles = [](const std::vector<double>& of) {
        return std::vector<double>(of.begin() + first_angle_when_free, of.end());
    };
    TreeState strut{angles(spindle.coordinates), angles(spindle.rates), {}};
    strut.coordinates.push_back(along(spindle.coordinates));
    strut.rates.push_back(along(spindle.rates));
    return strut;
}

}  // namespace hamilcar::oracle
