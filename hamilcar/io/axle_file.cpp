#include "hamilcar/io/axle_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hamilcar/io/axial_file.hpp"
#include "hamilcar/io/body_file.hpp"
#include "hamilcar/io/linkage_file.hpp"
#include "hamilcar/io/mirror.hpp"
#include "hamilcar/linkage/compose.hpp"
#include "hamilcar/suspension/recipe.hpp"
#include "hamilcar/tire/mirrored.hpp"
#include "hamilcar/vehicle/suspension.hpp"

namespace hamilcar::io {

using hamilcar::mirrored;

namespace {

void read_keys(const TableReader& table, const std::vector<HardpointKey>& keys, bool on_trailer, Hardpoints& to) {
    for (const HardpointKey& key : keys) {
        const std::string name(key.key);
        switch (key.kind) {
            case HardpointKind::flag:
                // The driver's rack does not reach a trailer; a schema has one kind of axle for both.
                to.numbers[name] =
                    table.boolean(key.key, key.default_value[0] != 0 && (!on_trailer || table.is_recording()));
                table.expect(!on_trailer || !to.flag(name), key.key, "false on a trailer");
                break;
            case HardpointKind::number: to.numbers[name] = table.number(key.key, positive, key.default_value[0]); break;
            case HardpointKind::length:
                if (table.has(key.key)) to.numbers[name] = table.number(key.key, positive);
                break;
            case HardpointKind::direction: to.points[name] = table.unit_direction(key.key, key.default_value); break;
            case HardpointKind::point:
                // `steered` stands before the keys that only a steered axle has
                if (key.only_steered && !to.flag("steered")) break;
                to.points[name] = table.array<3>(key.key);
        }
    }
}

const std::vector<HardpointKey> rocker_keys{{"pivot_m", HardpointKind::point, "a point of the rocker's axis"},
                                            {"axis", HardpointKind::direction, "of the rocker", {1, 0, 0}},
                                            {"rod_rocker_m", HardpointKind::point, "push rod, end on the rocker"},
                                            {"rod_end_m", HardpointKind::point, "push rod, end on the suspension"}};

Hardpoints read_hardpoints(const TableReader& axle, const Recipe& recipe, bool on_trailer) {
    Hardpoints points;
    read_keys(axle.table("hardpoints"), recipe.keys, on_trailer, points);
    note_meanings(axle.table("hardpoints"), recipe.keys, recipe.keyword);
    for (const auto& [one, other] : recipe.distinct_points) {
        axle.table("hardpoints")
            .expect(points[one] != points[other], other, fmt::format("a point apart from '{}'", one));
    }
    if (recipe.may_have_rocker && axle.has("rocker")) {
        const TableReader rocker = axle.table("rocker");
        constexpr std::string_view parts[] = {"lower_arm", "carrier"};
        points.rod_on = parts[rocker.one_of("rod_on", parts)];
        read_keys(rocker, rocker_keys, on_trailer, points);
        note_meanings(rocker, rocker_keys);
    }
    return points;
}

bool is_finite(const Point& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

// Rods have two ends and axes two bushes, and the wheels move with the linkage alone.
void check_composition(const TableReader& axle, const Composition& composition, const WheelDescription& wheel) {
    for (const TreeJointDescription& joint : composition.linkage.joints) {
        axle.expect(is_finite(joint.axis) && is_finite(joint.second_axis), "hardpoints",
                    "two points apart for the axis of '" + joint.part + "'");
    }
    for (const CutJointDescription& cut : composition.linkage.cuts) {
        const bool rod = cut.kind == CutJoint::distance || cut.kind == CutJoint::revolute_spherical;
        axle.expect(!rod || cut.tip != cut.foot, "hardpoints", "two ends apart for '" + cut.name + "'");
        axle.expect(is_finite(cut.axis), "hardpoints", "two points apart for the axis of '" + cut.name + "'");
    }
    std::vector<PartPoint> wheels;
    for (std::size_t i = 0; i < composition.carriers.size(); ++i) {
        wheels.push_back({composition.carriers[i], i == 0 ? wheel.center : mirrored(wheel.center)});
    }
    const PartitionResult verdict = choose_partition(composition.linkage, wheels);
    axle.expect(verdict.problem.empty(), "hardpoints",
                "a linkage that moves with its wheels alone; " + verdict.problem);
}

SuspensionWheelDescription read_left_wheel(const TableReader& axle, const NamedTires& tires,
                                           const Composition& composition) {
    const TableReader wheel = axle.table("wheel");
    return {.name = axle.text("name") + "_left",
            .part = composition.carriers[0],
            .wheel = read_wheel(wheel),
            .dual_spacing = wheel.number("dual_spacing_m", positive, 0),
            .bump = read_stop(axle.optional_table("bump_stop")),
            .rebound = read_stop(axle.optional_table("rebound_stop")),
            .tire = tire_of(axle, tires),
            .brake = read_brake(axle.optional_table("brake")),
            .drive_share = axle.number("drive_share", fraction, 0) / 2,
            .drive_reaction = composition.drive_reaction};
}

SuspensionWheelDescription right_wheel(SuspensionWheelDescription wheel, const std::string& axle, std::size_t part) {
    wheel.name = axle + "_right";
    wheel.part = part;
    wheel.wheel = mirrored(wheel.wheel);
    wheel.tire = hamilcar::mirrored(wheel.tire);
    return wheel;
}

// Bodies of the left side, or of the whole axle: a part and its mirror image are two, a part that is its own is one.
void add_bodies(const TableReader& axle, const Composition& composition, const WheelDescription& wheel,
                SuspensionDescription& to) {
    for (const PartChoice& part : composition.parts) {
        if (!part.has_table || !(part.needs_table || axle.has(part.name))) continue;
        const bool carries = part.left == composition.carriers[0];
        BodyDescription body = read_body(axle.table(part.name), carries ? wheel : WheelDescription{});
        to.bodies.push_back({part.left, body});
        if (part.right == part.left) continue;
        mirror(body);
        to.bodies.push_back({part.right, body});
    }
}

// An axle as one suspension with two wheels.
void add_two_wheel_suspension(const TableReader& axle, const NamedTires& tires, const Composition& composition,
                              std::string_view usual_part, SuspensionDescription suspension,
                              VehicleDescription& vehicle) {
    suspension.linkage = composition.linkage;
    suspension.wheels = {read_left_wheel(axle, tires, composition)};
    suspension.wheels.push_back(right_wheel(suspension.wheels[0], suspension.name, composition.carriers[1]));
    add_bodies(
        axle, composition,
        composition.parts[0].left == composition.parts[0].right ? WheelDescription{} : suspension.wheels[0].wheel,
        suspension);
    add_springs_and_dampers(axle, {composition, composition, usual_part}, suspension, suspension);
    vehicle.suspensions.push_back(suspension);
}

// The left suspension and its mirror image.
void add_pair_of_suspensions(const TableReader& axle, const NamedTires& tires, const Composition& left,
                             const Composition& right, std::string_view usual_part, const SuspensionDescription& named,
                             VehicleDescription& vehicle) {
    SuspensionDescription suspension = named;
    suspension.name = named.name + "_left";
    suspension.linkage = left.linkage;
    suspension.wheels = {read_left_wheel(axle, tires, left)};
    add_bodies(axle, left, suspension.wheels[0].wheel, suspension);
    SuspensionDescription other = suspension;
    other.name = named.name + "_right";
    other.linkage = right.linkage;
    other.wheels[0] = right_wheel(suspension.wheels[0], named.name, right.carriers[0]);
    for (SuspensionBodyDescription& body : other.bodies) mirror(body.body);
    add_springs_and_dampers(axle, {left, right, usual_part}, suspension, other);
    vehicle.suspensions.push_back(suspension), vehicle.suspensions.push_back(other);
}

// What fits into one suspension; vehicle/suspension.hpp has the places.
void check_sizes(const TableReader& axle, const SuspensionDescription& suspension) {
    const auto at_most = [](const char* what, int most) {
        return std::to_string(most) + " " + what +
               " at most in one suspension, both sides of one that carries two wheels";
    };
    axle.expect(suspension.springs.size() <= std::size_t{max_axial_elements}, "further_spring",
                at_most("springs", max_axial_elements));
    axle.expect(suspension.dampers.size() <= std::size_t{max_axial_elements}, "further_damper",
                at_most("dampers", max_axial_elements));
    axle.expect(suspension.bodies.size() <= std::size_t{max_bodies}, "suspension",
                at_most("bodies with a mass", max_bodies));
}

}  // namespace

std::vector<std::string_view> suspension_keywords() {
    std::vector<std::string_view> words;
    for (const Recipe* recipe : recipes()) words.push_back(recipe->keyword);
    words.push_back("linkage");
    return words;
}

void note_meanings(const TableReader& table, const std::vector<HardpointKey>& keys, std::string_view suspension) {
    for (const HardpointKey& key : keys) table.note(key.key, key.meaning, suspension);
}

void read_axle(const TableReader& axle, const NamedTires& tires, std::size_t unit, VehicleDescription& vehicle) {
    const std::vector<std::string_view> words = suspension_keywords();
    const std::string_view keyword = words[axle.one_of("suspension", words)];
    const Recipe* recipe = find_recipe(keyword);
    Composition left, right;
    if (recipe) {
        const Hardpoints points = read_hardpoints(axle, *recipe, unit > 0);
        left = recipe->compose(points);
        if (!recipe->two_wheels) right = recipe->compose(points.mirrored_side());
        if (!axle.is_recording()) check_composition(axle, left, read_wheel(axle.table("wheel")));
    } else {
        left = read_linkage(axle, read_wheel(axle.table("wheel")), unit > 0);
        if (left.carriers.size() == 1) right = mirrored_composition(left);
    }
    const std::string_view usual_part = recipe ? recipe->spring_part : left.parts[0].name;
    SuspensionDescription named;
    named.name = axle.text("name"), named.keyword = keyword, named.unit = unit;
    const std::size_t first_wheel = wheel_count(vehicle);
    if (left.carriers.size() == 2) {
        add_two_wheel_suspension(axle, tires, left, usual_part, named, vehicle);
    } else {
        add_pair_of_suspensions(axle, tires, left, right, usual_part, named, vehicle);
    }
    if (!axle.is_recording()) check_sizes(axle, vehicle.suspensions.back());
    if (const auto bar = axle.optional_table("anti_roll_bar")) {
        vehicle.anti_roll_bars.push_back({first_wheel, first_wheel + 1, bar->number("rate_N_per_m", not_negative)});
    }
}

}  // namespace hamilcar::io
