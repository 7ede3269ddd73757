#include "hamilcar/io/vehicle_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "hamilcar/linkage/compose.hpp"
#include "hamilcar/suspension/recipe.hpp"
#include "hamilcar/tire/mirrored.hpp"
#include "hamilcar/vehicle/suspension.hpp"

namespace hamilcar::io {

using hamilcar::mirrored;

namespace {

// The right side of an axle: the left one seen in the plane y = 0.
// Points change the sign of y. A product of inertia changes its sign once for every y in it. A mirrored spin axis would
// point to the right; all wheels of a vehicle spin about axes toward the left, so it is turned round: (a, b, c) becomes
// (-a, b, -c). The rack is one piece and its axis stays.
template <class... Points>
void mirror_points(Points&... points) {
    ((points[1] = -points[1]), ...);
}

void mirror(BodyDescription& body) {
    mirror_points(body.center_of_mass);
    auto& [xy, yz, xz] = body.products;
    xy = -xy, yz = -yz;
}

WheelDescription mirrored_wheel(WheelDescription wheel) {
    mirror_points(wheel.center);
    auto& [a, b, c] = wheel.spin_axis;
    a = -a, c = -c;
    return wheel;
}

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
    const TableReader table = axle.table("wheel");
    const WheelDescription wheel = read_wheel(table);
    return {.name = axle.text("name") + "_left",
            .part = composition.carriers[0],
            .wheel = wheel,
            .dual_spacing = table.number("dual_spacing_m", positive, 0),
            .bump = read_stop(axle.optional_table("bump_stop")),
            .rebound = read_stop(axle.optional_table("rebound_stop")),
            .tire = tire_of(axle, tires),
            .brake = read_brake(axle.optional_table("brake"), wheel),
            .drive_share = axle.number("drive_share", fraction, 0) / 2,
            .drive_reaction = composition.drive_reaction};
}

SuspensionWheelDescription right_wheel(SuspensionWheelDescription wheel, const std::string& axle, std::size_t part) {
    wheel.name = axle + "_right";
    wheel.part = part;
    wheel.wheel = mirrored_wheel(wheel.wheel);
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

// What fits into one suspension; vehicle/suspension.hpp has the places.
void check_sizes(const TableReader& axle, const SuspensionDescription& suspension) {
    const auto at_most = [](const char* what, int max) {
        return std::to_string(max) + " " + what +
               " at most in one suspension, both sides of one that carries two wheels";
    };
    axle.expect(suspension.springs.size() <= std::size_t{max_axial_elements}, "further_spring",
                at_most("springs", max_axial_elements));
    axle.expect(suspension.dampers.size() <= std::size_t{max_axial_elements}, "further_damper",
                at_most("dampers", max_axial_elements));
    axle.expect(suspension.bodies.size() <= std::size_t{max_bodies}, "suspension",
                at_most("bodies with a mass", max_bodies));
}

// An axle as one suspension with two wheels, or the left suspension and its mirror image.
void add_suspensions(const TableReader& axle, const NamedTires& tires, const AxleSides& sides,
                     const SuspensionDescription& named, VehicleDescription& vehicle) {
    const Composition& composition = sides.left;
    const bool two_wheels = composition.carriers.size() == 2;
    SuspensionDescription left = named;
    left.linkage = composition.linkage;
    left.wheels = {read_left_wheel(axle, tires, composition)};
    const bool carrier_holds_both = composition.parts[0].left == composition.parts[0].right && two_wheels;
    add_bodies(axle, composition, carrier_holds_both ? WheelDescription{} : left.wheels[0].wheel, left);
    SuspensionDescription right = left;
    const SuspensionWheelDescription other = right_wheel(left.wheels[0], named.name, sides.right.carriers.back());
    if (two_wheels) {
        left.wheels.push_back(other);
        add_springs_and_dampers(axle, sides, left, left);
        vehicle.suspensions.push_back(left);
    } else {
        left.name = named.name + "_left", right.name = named.name + "_right";
        right.linkage = sides.right.linkage;
        right.wheels[0] = other;
        for (SuspensionBodyDescription& body : right.bodies) mirror(body.body);
        add_springs_and_dampers(axle, sides, left, right);
        vehicle.suspensions.push_back(left), vehicle.suspensions.push_back(right);
    }
    if (!axle.is_recording()) check_sizes(axle, vehicle.suspensions.back());
}

// Whether it is steered and has a rocker decides which points and parts an axle has.
void read_recipe(const TableReader& axle, const Recipe& recipe, bool on_trailer,
                 const std::function<void(const Composition&, const Composition&)>& use) {
    const auto compose = [&](bool steered, bool has_rocker) {
        const Hardpoints points = read_hardpoints(axle, recipe, steered, has_rocker);
        const Composition left = recipe.compose(points);
        if (!axle.is_recording()) check_composition(axle, left, read_wheel(axle.table("wheel")));
        use(left, recipe.two_wheels ? left : recipe.compose(points.mirrored_side()));
    };
    const auto read = [&](bool steered) {
        if (!recipe.may_have_rocker) return compose(steered, false);
        axle.choose_presence("rocker", [&](bool has_rocker) { compose(steered, has_rocker); });
    };
    const auto key = std::ranges::find(recipe.keys, "steered", &HardpointKey::key);
    if (key == recipe.keys.end()) return read(false);
    const TableReader points = axle.table("hardpoints");
    // The driver's rack does not reach a trailer; a schema has one kind of axle for both.
    const bool by_default = key->default_value[0] != 0 && (!on_trailer || axle.is_recording());
    points.choose_flag(key->key, by_default, axle, [&](bool steered) {
        points.expect(!on_trailer || !steered, key->key, "false on a trailer");
        read(steered);
    });
    note_meanings(points, {*key}, recipe.keyword);
}

std::vector<std::string_view> suspension_keywords() {
    std::vector<std::string_view> words;
    for (const Recipe* recipe : recipes()) words.push_back(recipe->keyword);
    words.push_back("linkage");
    return words;
}

}  // namespace

void read_axle(const TableReader& axle, const NamedTires& tires, std::size_t unit, VehicleDescription& vehicle) {
    const std::size_t first_wheel = wheel_count(vehicle);
    const std::vector<std::string_view> words = suspension_keywords();
    axle.choose("suspension", words, {}, [&](std::size_t word) {
        SuspensionDescription named;
        named.name = axle.text("name"), named.keyword = words[word], named.unit = unit;
        if (const Recipe* recipe = find_recipe(words[word])) {
            read_recipe(axle, *recipe, unit > 0, [&](const Composition& left, const Composition& right) {
                add_suspensions(axle, tires, {left, right, recipe->spring_part}, named, vehicle);
            });
            return;
        }
        axle.choose_presence("right_carrier_part", [&](bool two_wheels) {
            const Composition left = read_linkage(axle, read_wheel(axle.table("wheel")), two_wheels, unit > 0);
            const Composition right = two_wheels ? left : mirrored_composition(left);
            add_suspensions(axle, tires, {left, right, left.parts[0].name}, named, vehicle);
        });
    });
    if (const auto bar = axle.optional_table("anti_roll_bar")) {
        vehicle.anti_roll_bars.push_back({first_wheel, first_wheel + 1, bar->number("rate_N_per_m", not_negative)});
    }
}

}  // namespace hamilcar::io
