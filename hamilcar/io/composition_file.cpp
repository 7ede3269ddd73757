// An axle's linkages: the recipe's points become a composition for each side; links that carry something and the arms of an anti-roll bar
// are added to it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/vehicle_tables.hpp"
#include "hamilcar/linkage/compose.hpp"
#include "hamilcar/suspension/attachments.hpp"
#include "hamilcar/vehicle/suspension.hpp"

namespace hamilcar::io {

using hamilcar::mirrored;

namespace {

// Tells a recorder what keys mean, in a suspension or everywhere.
void note_meanings(const TableReader& table, const std::vector<HardpointKey>& keys, std::string_view suspension = {}) {
    for (const HardpointKey& key : keys) table.note(key.key, key.meaning, suspension);
}

void read_keys(const TableReader& table, const std::vector<HardpointKey>& keys, Hardpoints& to) {
    for (const HardpointKey& key : keys) {
        const std::string name(key.key);
        switch (key.kind) {
            case HardpointKind::flag:  // `steered` was read before
                if (!to.numbers.contains(name)) to.numbers[name] = table.boolean(key.key, key.default_value[0] != 0);
                break;
            case HardpointKind::number: to.numbers[name] = table.number(key.key, positive, key.default_value[0]); break;
            case HardpointKind::length:
                if (table.has(key.key)) to.numbers[name] = table.number(key.key, positive);
                break;
            case HardpointKind::direction: to.points[name] = table.unit_direction(key.key, key.default_value); break;
            case HardpointKind::point:
                if (key.only_steered && !to.flag("steered")) break;
                to.points[name] = table.array<3>(key.key);
        }
    }
}

const std::vector<HardpointKey> rocker_keys{{"pivot_m", HardpointKind::point, "a point of the rocker's axis"},
                                            {"axis", HardpointKind::direction, "of the rocker", {1, 0, 0}},
                                            {"rod_rocker_m", HardpointKind::point, "push rod, end on the rocker"},
                                            {"rod_end_m", HardpointKind::point, "push rod, end on the suspension"}};

Hardpoints read_hardpoints(const TableReader& axle, const Recipe& recipe, bool steered, bool has_rocker) {
    Hardpoints points;
    points.numbers["steered"] = steered ? 1 : 0;
    read_keys(axle.table("hardpoints"), recipe.keys, points);
    note_meanings(axle.table("hardpoints"), recipe.keys, recipe.keyword);
    for (const auto& [one, other] : recipe.distinct_points) {
        axle.table("hardpoints")
            .expect(points[one] != points[other], other, fmt::format("a point apart from '{}'", one));
    }
    if (has_rocker) {
        const TableReader rocker = axle.table("rocker");
        constexpr std::string_view parts[] = {"lower_arm", "carrier"};
        points.rod_on = parts[rocker.one_of("rod_on", parts)];
        read_keys(rocker, rocker_keys, points);
        note_meanings(rocker, rocker_keys);
    }
    return points;
}

// What is one piece has no right side of its own.
void check_shared(const TableReader& axle, const Recipe& recipe, const Hardpoints& left, const Hardpoints& right) {
    for (const HardpointKey& key : recipe.keys) {
        if (!key.shared) continue;
        const auto same = [&](const auto& of_left, const auto& of_right) {
            const auto own = of_left.find(key.key), other = of_right.find(key.key);
            return own == of_left.end() || other == of_right.end() || own->second == other->second;
        };
        axle.table("hardpoints")
            .expect(same(left.points, right.points) && same(left.numbers, right.numbers), key.key,
                    "the left side's: it is one for both sides");
    }
}

bool is_finite(const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

// Rods have two ends and axes two bushes, and the wheels move with the linkage alone.
void check_composition(const TableReader& axle, const Composition& composition, const std::vector<Point>& centers) {
    const LinkageDescription& linkage = composition.linkage;
    for (const TreeJointDescription& joint : linkage.joints) {
        axle.expect(is_finite(joint.axis) && is_finite(joint.second_axis), "hardpoints",
                    "two points apart for the axis of '" + joint.part + "'");
    }
    for (const CutJointDescription& cut : linkage.cuts) {
        const bool rod = cut.kind == CutJoint::distance || cut.kind == CutJoint::revolute_spherical;
        axle.expect(!rod || cut.tip != cut.foot, "hardpoints", "two ends apart for '" + cut.name + "'");
        axle.expect(is_finite(cut.axis), "hardpoints", "two points apart for the axis of '" + cut.name + "'");
    }
    axle.expect(
        linkage.coordinate_count() <= max_coordinates && linkage.equation_count() <= max_equations, "suspension",
        fmt::format(
            "at most {} coordinates and {} cut equations in one suspension, with links that are parts and a bar's "
            "arms (here {} and {})",
            max_coordinates, max_equations, linkage.coordinate_count(), linkage.equation_count()));
    std::vector<PartPoint> wheels;
    for (std::size_t i = 0; i < composition.carriers.size(); ++i) {
        wheels.push_back({composition.carriers[i], centers[i]});
    }
    const PartitionResult verdict = choose_partition(linkage, wheels);
    axle.expect(verdict.problem.empty(), linkage.independent.empty() ? "suspension" : "hardpoints",
                "a linkage that moves with its wheels alone; " + verdict.problem);
}

// Whether a spring, a damper or a drop link sits on a link, or it has a mass.
bool needs_part(const TableReader& axle, std::string_view link) {
    const auto names_it = [&](const TableReader& table) {
        return std::ranges::any_of(std::array{"on", "right_on", "to"},
                                   [&](const char* key) { return table.text_if_there(key) == link; });
    };
    for (const char* key : {"spring", "damper", "anti_roll_bar"}) {
        const auto table = axle.optional_table(key);
        if (table && names_it(*table)) return true;
    }
    for (const char* key : {"further_spring", "further_damper"}) {
        if (axle.has(key) && std::ranges::any_of(axle.tables(key), names_it)) return true;
    }
    return axle.has(link);
}

void add_link_parts(const AxleTables& axle, AxleSides& sides) {
    for (const std::string& link : link_keys(sides.left)) {
        if (axle.left.is_recording()) {
            sides.left.parts.push_back({link, 1, 1, true, false});
        } else if (needs_part(axle.left, link) || (axle.differ() && needs_part(axle.of_right(), link))) {
            make_part(sides.left, link);
            if (!sides.hold_both()) make_part(sides.right, link);
        } else {
            sides.left.bare_links.push_back(link);
        }
    }
}

BarArm read_arm(const TableReader& bar, const AxleSides& sides, bool right) {
    const PartChoice& part = part_of(bar, "on", sides.left, sides.default_part);
    BarArm arm{bar.array<3>("pivot_m"), bar.array<3>("arm_end_m"), bar.array<3>("link_m"),
               right ? part.right : part.left};
    bar.expect(std::hypot(arm.end[0] - arm.pivot[0], arm.end[2] - arm.pivot[2]) > 0, "arm_end_m",
               "a point apart from the bar's axis, which lies across the vehicle through 'pivot_m'");
    bar.expect(arm.link != arm.end, "link_m", "a point apart from 'arm_end_m', the other end of the drop link");
    if (right) arm.pivot = mirrored(arm.pivot), arm.end = mirrored(arm.end), arm.link = mirrored(arm.link);
    return arm;
}

// Makes the bar push by itself.
void read_bar_actuator(const TableReader& bar, AxleSides& sides) {
    constexpr Range lag{"number not below 0.005", 0.005};  // that explicit steps can follow [s]
    const auto actuator = bar.optional_table("actuator");
    if (!actuator) return;
    sides.bar_force = actuator->number("max_force_N", positive);
    sides.bar_response = actuator->number("response_time_s", lag, sides.bar_response);
}

void read_bar(const AxleTables& axle, AxleSides& sides) {
    const auto bar = axle.left.optional_table("anti_roll_bar");
    if (!bar) return;
    const TableReader other = axle.differ() ? axle.of_right().table("anti_roll_bar") : *bar;
    bar->choose({{"rate_N_per_m"}, {"rate_N_m_per_rad", "pivot_m", "arm_end_m", "link_m", "on"}},
                [&](std::size_t group) {
                    const char* key = group == 0 ? "rate_N_per_m" : "rate_N_m_per_rad";
                    sides.bar_rate = bar->number(key, not_negative);
                    if (axle.differ()) {
                        other.expect(other.number(key, not_negative) == sides.bar_rate, key,
                                     "the left side's: the bar is one for both sides");
                    }
                    if (group == 0) return read_bar_actuator(*bar, sides);
                    const BarArm left = read_arm(*bar, sides, false);
                    const BarArm right = axle.left.is_recording() ? left : read_arm(other, sides, true);
                    add_bar_arm(sides.left, sides.hold_both() ? "left " : "", left);
                    add_bar_arm(sides.hold_both() ? sides.left : sides.right, sides.hold_both() ? "right " : "", right);
                });
}

// What a side may have only if the other one has it.
void check_presence(const AxleTables& axle) {
    if (!axle.differ()) return;
    const TableReader right = axle.left.table("right");
    for (const char* key : {"rocker", "anti_roll_bar"}) {
        if (right.has(key) && !axle.left.has(key)) right.expect(false, key, "no such table: the axle itself has none");
    }
}

// What any composition may have.
void finish(const AxleTables& axle, AxleSides& sides, const UseSides& use) {
    check_presence(axle);
    add_link_parts(axle, sides);
    read_bar(axle, sides);
    if (!axle.left.is_recording()) {
        const Point left = read_wheel(axle.left.table("wheel")).center;
        const Point right = mirrored(read_wheel(axle.of_right().table("wheel")).center);
        check_composition(axle.left, sides.left, {left, right});
        if (!sides.hold_both()) check_composition(axle.of_right(), sides.right, {right});
    }
    use(sides);
}

void compose_recipe(const AxleTables& axle, const Recipe& recipe, bool steered, bool has_rocker, const UseSides& use) {
    Hardpoints left = read_hardpoints(axle.left, recipe, steered, has_rocker), right = left;
    if (axle.differ()) {
        right = read_hardpoints(axle.of_right(), recipe, steered, has_rocker);
        check_shared(axle.of_right(), recipe, left, right);
        if (recipe.two_wheels) left.right_points = right.points;
    }
    AxleSides sides{recipe.compose(left), {}, recipe.spring_part, {}};
    if (!recipe.two_wheels) sides.right = recipe.compose(right.mirrored_side());
    finish(axle, sides, use);
}

}  // namespace

const PartChoice& part_of(const TableReader& table, std::string_view key, const Composition& composition,
                          std::string_view fallback) {
    std::vector<std::string_view> names = part_names(composition);
    names.insert(names.end(), composition.bare_links.begin(), composition.bare_links.end());  // for the message alone
    const auto default_name = std::ranges::find(names, fallback);
    const std::optional<std::size_t> place =
        default_name == names.end() ? std::nullopt : std::optional<std::size_t>(default_name - names.begin());
    return composition.parts[table.one_of(key, names, place)];
}

std::vector<std::string_view> part_names(const Composition& composition) {
    std::vector<std::string_view> names;
    for (const PartChoice& part : composition.parts) names.push_back(part.name);
    return names;
}

// Whether it is steered and has a rocker decides which points and parts an axle has.
void read_recipe(const AxleTables& axle, const Recipe& recipe, bool on_trailer, const UseSides& use) {
    const auto read = [&](bool steered) {
        if (!recipe.may_have_rocker) return compose_recipe(axle, recipe, steered, false, use);
        axle.left.choose_presence("rocker",
                                  [&](bool has_rocker) { compose_recipe(axle, recipe, steered, has_rocker, use); });
    };
    const auto key = std::ranges::find(recipe.keys, "steered", &HardpointKey::key);
    if (key == recipe.keys.end()) return read(false);
    const TableReader points = axle.left.table("hardpoints");
    // The driver's rack does not reach a trailer; a schema has one kind of axle for both.
    const bool by_default = key->default_value[0] != 0 && (!on_trailer || axle.left.is_recording());
    points.choose_flag(key->key, by_default, axle.left, [&](bool steered) {
        points.expect(!on_trailer || !steered, key->key, "false on a trailer");
        if (axle.differ()) {
            const TableReader right = axle.of_right().table("hardpoints");
            right.expect(right.boolean(key->key, steered) == steered, key->key,
                         "the left side's: it is one for both sides");
        }
        read(steered);
    });
    note_meanings(points, {*key}, recipe.keyword);
}

// What the sides of a linkage have in common, so that a part's name means the same on both.
bool have_one_structure(const LinkageDescription& a, const LinkageDescription& b) {
    return std::ranges::equal(a.joints, b.joints,
                              [](const auto& x, const auto& y) {
                                  return x.part == y.part && x.kind == y.kind && x.parent == y.parent;
                              }) &&
           std::ranges::equal(a.cuts, b.cuts, [](const auto& x, const auto& y) {
               return x.name == y.name && x.kind == y.kind && x.part == y.part && x.base == y.base;
           });
}

void read_own_linkage(const AxleTables& axle, bool on_trailer, const UseSides& use) {
    axle.left.choose_presence("right_carrier_part", [&](bool two_wheels) {
        const auto read = [&](const TableReader& table) {
            return read_linkage(table, read_wheel(table.table("wheel")), two_wheels, on_trailer);
        };
        AxleSides sides{read(axle.left), {}, {}, {}};
        const std::string default_part = sides.left.parts[0].name;
        sides.default_part = default_part;
        if (!two_wheels) sides.right = mirrored_composition(axle.differ() ? read(axle.of_right()) : sides.left);
        if (axle.differ() && !two_wheels) {
            axle.left.expect(
                have_one_structure(sides.left.linkage, sides.right.linkage), "right",
                "the joints and cuts of the left side, in their order, with points and lengths of their own");
        }
        finish(axle, sides, use);
    });
}

}  // namespace hamilcar::io
