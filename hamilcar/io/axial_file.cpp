#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <functional>

#include "hamilcar/linkage/compose.hpp"

namespace hamilcar::io {

namespace {

// A line and its mirror image. `sense` is -1 where a rotation of the left side is mirrored by one with the other sign.
struct Lines {
    LineDescription left, right;
    bool turns = false;
    double sense = 1;
};

using UseLines = std::function<void(const Lines&)>;

// Along the one coordinate of the joint that carries a part.
Lines along_joint(const TableReader& table, const AxleSides& sides, const PartChoice& part) {
    const auto joint = [](const AxleSides& of, bool right, std::size_t number) -> const TreeJointDescription& {
        return (right ? of.of_right() : of.left).linkage.joints[number - 1];
    };
    const TreeJointDescription &left = joint(sides, false, part.left), &right = joint(sides, true, part.right);
    table.expect(freedoms(left.kind) == 1 && right.kind == left.kind, "along",
                 "a part on a revolute or prismatic joint, on both sides");
    Lines out;
    out.left.coordinate = frame_of_part(sides.left.linkage, part.left) - 1;
    out.right.coordinate = frame_of_part(sides.of_right().linkage, part.right) - 1;
    out.turns = left.kind == TreeJoint::revolute;
    const Point m = mirrored(left.axis);
    const double same = m[0] * right.axis[0] + m[1] * right.axis[1] + m[2] * right.axis[2];
    // A mirrored rotation turns the other way about the mirrored axis.
    out.sense = out.turns == (same > 0) ? -1 : 1;
    return out;
}

// From a point of the part `on` to a point of the part `to`, which is the chassis unless the file says otherwise.
Lines between_points(const TableReader& table, const AxleSides& sides) {
    const PartChoice& part = part_of(table, "on", sides.left, sides.default_part);
    Lines out;
    out.left.part = part.left, out.right.part = part.right;
    if (sides.hold_both() && table.has("right_on")) {
        out.right.part = part_of(table, "right_on", sides.left, part.name).right;
    }
    if (table.has("to")) {
        const PartChoice& base = part_of(table, "to", sides.left, "");
        table.expect(base.left != part.left, "to", "another part than the line starts from");
        out.left.base = base.left, out.right.base = base.right;
    }
    out.left.on_part = table.array<3>("at_m"), out.left.on_base = table.array<3>("body_m");
    table.expect(out.left.on_part != out.left.on_base, "body_m", "a point apart from 'at_m'");
    out.right.on_part = mirrored(out.left.on_part), out.right.on_base = mirrored(out.left.on_base);
    return out;
}

// What is read beside the lines depends on them.
void read_lines(const TableReader& table, const AxleSides& sides, const UseLines& use) {
    table.choose({{"at_m", "body_m"}, {"along"}}, [&](std::size_t group) {
        if (group == 0) return use(between_points(table, sides));
        table.choose("along", part_names(sides.left), {},
                     [&](std::size_t part) { use(along_joint(table, sides, sides.left.parts[part])); });
    });
}

// [axle.KEY], which must be there where the suspension itself says where it acts, then every [[axle.further_KEY]].
using OwnLine = std::optional<LineDescription> Composition::*;
void for_each_element(const TableReader& axle, const std::string& key, const AxleSides& sides, OwnLine own,
                      const std::function<void(const TableReader&, const Lines&, std::size_t)>& add) {
    std::size_t number = 0;
    const auto read = [&](const TableReader& table) {
        read_lines(table, sides, [&](const Lines& lines) { add(table, lines, number); });
        ++number;
    };
    if (const auto& line = sides.left.*own) {
        add(axle.table(key), {*line, *(sides.of_right().*own)}, number++);
    } else if (const auto table = axle.optional_table(key)) {
        read(*table);
    }
    if (!axle.has("further_" + key)) return;
    for (const TableReader& table : axle.tables("further_" + key)) read(table);
}

// "front_left", then "front_left_2": the prefix of an element's channels.
std::string numbered(const std::string& name, std::size_t i) {
    return i == 0 ? name : name + "_" + std::to_string(i + 1);
}

SpringDescription read_spring(const TableReader& table, bool turns) {
    const double rate = table.number(turns ? "rate_N_m_per_rad" : "rate_N_per_m", positive);
    const auto preload = table.number_or("carry", turns ? "moment_at_design_N_m" : "force_at_design_N", any_number);
    const double seat = table.number(turns ? "seat_deg" : "seat_m", any_number, 0);
    return {rate, preload.value_or(0), !preload, seat};
}

// Between two shares of the force, by a command.
void read_adjustment(const TableReader& table, DamperDescription& to) {
    constexpr Range lag{"number not below 0.002", 0.002};  // that explicit steps can follow [s]
    constexpr Range above{"number not below 1", 1};
    to.soft = table.number("soft", fraction);
    to.firm = table.number("firm", above);
    to.response_time = table.number("response_time_s", lag, to.response_time);
    table.expect(to.firm > to.soft, "firm", "a share above that of 'soft'");
}

DamperDescription read_any_damper(const TableReader& table, bool turns) {
    DamperDescription out;
    if (turns) {
        const double damping = table.number("damping_N_m_s_per_rad", not_negative);
        out = {{-1, 1}, {-damping, damping}};
    } else {
        out = read_damper(table);
    }
    if (const auto adjustable = table.optional_table("adjustable")) read_adjustment(*adjustable, out);
    return out;
}

// Bump and rebound trade places.
void turn_over(DamperDescription& damper) {
    for (std::vector<double>* list : {&damper.velocity, &damper.force}) {
        std::ranges::reverse(*list);
        for (double& number : *list) number = -number;
    }
}

}  // namespace

void add_springs_and_dampers(const AxleTables& axle, const AxleSides& sides, SuspensionDescription& left,
                             SuspensionDescription& right) {
    const std::string name = axle.left.text("name");
    std::vector<SuspensionSpringDescription> right_springs;
    std::vector<SuspensionDamperDescription> right_dampers;
    const auto add_of = [&](const TableReader& table, bool is_left, bool is_right) {
        for_each_element(table, "spring", sides, &Composition::spring_line,
                         [&](const TableReader& element, const Lines& lines, std::size_t number) {
                             SpringDescription spring = read_spring(element, lines.turns);
                             if (is_left)
                                 left.springs.push_back({numbered(name + "_left", number), lines.left, spring});
                             spring.force_at_design *= lines.sense, spring.seat *= lines.sense;
                             if (is_right)
                                 right_springs.push_back({numbered(name + "_right", number), lines.right, spring});
                         });
        for_each_element(table, "damper", sides, &Composition::damper_line,
                         [&](const TableReader& element, const Lines& lines, std::size_t number) {
                             DamperDescription damper = read_any_damper(element, lines.turns);
                             if (is_left)
                                 left.dampers.push_back({numbered(name + "_left", number), lines.left, damper});
                             if (lines.sense < 0) turn_over(damper);
                             if (is_right)
                                 right_dampers.push_back({numbered(name + "_right", number), lines.right, damper});
                         });
    };
    add_of(axle.left, true, !axle.differ());
    if (axle.differ()) add_of(*axle.right, false, true);
    right.springs.insert(right.springs.end(), right_springs.begin(), right_springs.end());
    right.dampers.insert(right.dampers.end(), right_dampers.begin(), right_dampers.end());
    if (!sides.left.twist) return;
    if (const auto table = axle.left.optional_table("twist_spring")) {
        LineDescription line;
        line.coordinate = sides.left.twist;
        left.springs.push_back({name + "_twist", line, {table->number("rate_N_m_per_rad", positive), 0}});
    }
}

}  // namespace hamilcar::io
