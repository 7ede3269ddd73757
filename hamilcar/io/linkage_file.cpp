#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <span>

#include "hamilcar/linkage/compose.hpp"
#include "hamilcar/suspension/attachments.hpp"

namespace hamilcar::io {

namespace {

constexpr std::string_view chassis = "chassis";

std::vector<std::string_view> part_names(const LinkageDescription& linkage, bool with_chassis) {
    std::vector<std::string_view> names;
    if (with_chassis) names.push_back(chassis);
    for (const TreeJointDescription& joint : linkage.joints) names.push_back(joint.part);
    return names;
}

// The number of the part that a key names.
std::size_t part(const TableReader& table, std::string_view key, const LinkageDescription& linkage) {
    return table.one_of(key, part_names(linkage, false)) + 1;
}
std::size_t part_or_chassis(const TableReader& table, std::string_view key, const LinkageDescription& linkage) {
    return table.one_of(key, part_names(linkage, true), 0);
}

// A part or a cut may have a table of its own, under the key of its name, and its channels have that name.
void expect_free(const TableReader& table, std::string_view key, std::string_view name) {
    constexpr std::string_view taken[] = {
        "name",   "suspension", "tire",         "drive_share",        "hardpoints",         "wheel",
        "spring", "damper",     "bump_stop",    "rebound_stop",       "anti_roll_bar",      "brake",
        "joint",  "cut",        "rocker",       "further_spring",     "further_damper",     "twist_spring",
        "right",  "alignment",  "carrier_part", "right_carrier_part", "drive_reaction_part"};
    table.expect(std::ranges::find(taken, link_key(name)) == std::end(taken), key,
                 "a name that no other table of an axle has");
}

// Names are keys of tables and beginnings of channels.
void expect_own_name(const TableReader& table, std::string_view key, std::string_view name,
                     const LinkageDescription& before) {
    const auto same = [&](const std::string& other) { return link_key(other) == link_key(name); };
    table.expect(link_key(name) != chassis && std::ranges::none_of(before.cuts, same, &CutJointDescription::name) &&
                     std::ranges::none_of(before.joints, same, &TreeJointDescription::part),
                 key, "a name that no other part or cut has, however it is spelled");
}

TreeJointDescription read_joint(const TableReader& table, const LinkageDescription& before) {
    constexpr std::string_view kinds[] = {"revolute", "prismatic", "universal", "spherical", "free"};
    TreeJointDescription joint;
    table.choose("kind", kinds, {}, [&](std::size_t kind) {
        joint.kind = static_cast<TreeJoint>(kind);
        const bool has_axis = joint.kind != TreeJoint::spherical && joint.kind != TreeJoint::free;
        if (has_axis) joint.axis = table.direction("axis");
        if (joint.kind == TreeJoint::universal) joint.second_axis = table.direction("second_axis");
    });
    if (table.is_recording()) joint.kind = TreeJoint::revolute;  // along which a spring may act
    joint.part = table.text("part");
    expect_free(table, "part", joint.part);
    expect_own_name(table, "part", joint.part, before);
    joint.parent = part_or_chassis(table, "parent", before);
    joint.point = table.array<3>("point_m");
    return joint;
}

CutJointDescription read_cut(const TableReader& table, const LinkageDescription& tree, bool on_trailer,
                             std::vector<Adjuster>& adjusters) {
    constexpr std::string_view kinds[] = {"distance", "plane", "line", "revolute_spherical", "spherical"};
    CutJointDescription cut;
    cut.name = table.text("name");
    expect_free(table, "name", cut.name);
    cut.part = part(table, "part", tree), cut.base = part_or_chassis(table, "base", tree);
    table.expect(cut.part != cut.base, "base", "another part than '" + table.text("part") + "'");
    cut.tip = table.array<3>("tip_m"), cut.foot = table.array<3>("foot_m", cut.tip);
    table.choose("kind", kinds, {}, [&](std::size_t kind) {
        cut.kind = static_cast<CutJoint>(kind);
        if (cut.kind == CutJoint::distance || cut.kind == CutJoint::revolute_spherical) {
            table.expect(cut.tip != cut.foot, "foot_m", "a point apart from 'tip_m'");
            if (table.has("length_m")) cut.length = table.number("length_m", positive);
        }
        if (cut.kind != CutJoint::distance && cut.kind != CutJoint::spherical) cut.axis = table.direction("axis");
    });
    if (table.has("sets")) {
        const WheelAngle angle = static_cast<WheelAngle>(table.one_of("sets", std::span(wheel_angle_names).first(2)));
        table.expect(cut.kind == CutJoint::distance || table.is_recording(), "sets",
                     "no such key but on a cut of kind 'distance'");
        adjusters.push_back({angle, cut.name});
    }
    if (table.has("drive")) {
        cut.drive = table.unit_direction("drive");
        table.expect(!on_trailer, "drive", "no such key on a trailer: the driver's rack does not reach it");
    }
    return cut;
}

// One cut sets an angle, on each wheel.
void check_adjusters(const TableReader& axle, const Composition& composition) {
    for (const WheelAngle angle : {WheelAngle::toe, WheelAngle::camber}) {
        const auto count = std::ranges::count(composition.adjusters, angle, &Adjuster::sets);
        axle.expect(count == 0 || static_cast<std::size_t>(count) == composition.carriers.size(), "cut",
                    "as many that set " + std::string(wheel_angle_names[static_cast<std::size_t>(angle)]) +
                        " as the linkage has wheels, or none");
    }
}

// The wheels have one freedom each, and nothing else moves.
void choose_independent(const TableReader& axle, const std::vector<PartPoint>& wheels, LinkageDescription& linkage) {
    const int coordinates = linkage.coordinate_count(), equations = linkage.equation_count();
    axle.expect(coordinates <= max_coordinates, "joint", "at most " + std::to_string(max_coordinates) + " coordinates");
    axle.expect(equations <= max_equations, "joint", "at most " + std::to_string(max_equations) + " cut equations");
    const PartitionResult verdict = choose_partition(linkage, wheels);
    axle.expect(verdict.problem.empty(), "joint",
                "a linkage that moves with its wheels alone (here " + std::to_string(coordinates) +
                    " coordinates and " + std::to_string(equations) + " cut equations); " + verdict.problem);
    linkage.independent = verdict.independent;
}

}  // namespace

Composition read_linkage(const TableReader& axle, const WheelDescription& wheel, bool two_wheels, bool on_trailer) {
    Composition out;
    for (const TableReader& joint : axle.tables("joint")) out.linkage.joints.push_back(read_joint(joint, out.linkage));
    if (axle.has("cut")) {
        for (const TableReader& cut : axle.tables("cut")) {
            const CutJointDescription one = read_cut(cut, out.linkage, on_trailer, out.adjusters);
            expect_own_name(cut, "name", one.name, out.linkage);
            out.linkage.cuts.push_back(one);
        }
    }
    const std::size_t carrier = part(axle, "carrier_part", out.linkage);
    out.carriers = {carrier};
    std::vector<PartPoint> wheels{{carrier, wheel.center}};
    std::size_t right = carrier;
    if (two_wheels) {
        right = part(axle, "right_carrier_part", out.linkage);
        out.carriers.push_back(right);
        wheels.push_back({right, mirrored(wheel.center)});
    }
    if (axle.has("drive_reaction_part")) out.drive_reaction = part_or_chassis(axle, "drive_reaction_part", out.linkage);
    out.parts = {{"carrier", carrier, right, true, true}};
    for (std::size_t i = 0; i < out.linkage.joints.size(); ++i) {
        const std::string& name = out.linkage.joints[i].part;
        const bool carries = i + 1 == carrier || i + 1 == right;
        axle.expect(name != "carrier" || carries, "carrier_part", "the part that is called 'carrier'");
        if (name != "carrier") out.parts.push_back({name, i + 1, i + 1, !carries, false});
    }
    if (!axle.is_recording()) check_adjusters(axle, out), choose_independent(axle, wheels, out.linkage);
    return out;
}

Composition mirrored_composition(Composition side) {
    for (TreeJointDescription& joint : side.linkage.joints) {
        joint.point = mirrored(joint.point), joint.axis = mirrored(joint.axis);
        joint.second_axis = mirrored(joint.second_axis);
    }
    for (CutJointDescription& cut : side.linkage.cuts) {
        cut.tip = mirrored(cut.tip), cut.foot = mirrored(cut.foot), cut.axis = mirrored(cut.axis);
    }
    return side;
}

}  // namespace hamilcar::io
