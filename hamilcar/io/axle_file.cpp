#include "hamilcar/io/vehicle_tables.hpp"

#include <algorithm>
#include <numbers>

#include "hamilcar/suspension/recipe.hpp"
#include "hamilcar/tire/mirrored.hpp"
#include "hamilcar/vehicle/suspension.hpp"

namespace hamilcar::io {

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

SuspensionWheelDescription read_wheel_of(const TableReader& axle, const NamedTires& tires,
                                         const BrakeSystemDescription& brakes, const Composition& composition,
                                         std::size_t number) {
    const TableReader table = axle.table("wheel");
    const WheelDescription wheel = read_wheel(table);
    SuspensionWheelDescription out{.name = axle.text("name") + "_left",
                                   .part = composition.carriers[number],
                                   .wheel = wheel,
                                   .dual_spacing = table.number("dual_spacing_m", positive, 0),
                                   .bump = read_stop(axle.optional_table("bump_stop")),
                                   .rebound = read_stop(axle.optional_table("rebound_stop")),
                                   .tire = tire_of(axle, tires),
                                   .brake = read_brake(axle.optional_table("brake"), wheel, brakes),
                                   .drive_share = axle.number("drive_share", fraction, 0) / 2,
                                   .drive_reaction = composition.drive_reaction,
                                   .bar_arm = {}};
    if (!composition.bar_arms.empty()) out.bar_arm = composition.bar_arms[number];
    return out;
}

SuspensionWheelDescription mirrored_wheel(SuspensionWheelDescription wheel, const std::string& axle) {
    wheel.name = axle + "_right";
    wheel.wheel = mirrored_wheel(wheel.wheel);
    wheel.tire = hamilcar::mirrored(wheel.tire);
    return wheel;
}

// The bodies of one side; of a suspension that holds both, those that the other side shares belong to the left one.
void add_bodies(const TableReader& axle, const AxleSides& sides, bool right, SuspensionDescription& to) {
    const Composition& composition = right ? sides.of_right() : sides.left;
    const WheelDescription wheel = read_wheel(axle.table("wheel"));
    for (const PartChoice& part : composition.parts) {
        if (!part.has_table || !(part.needs_table || axle.has(part.name))) continue;
        const bool shared = sides.hold_both() && part.left == part.right;
        if (shared && right) continue;
        const bool carries = !shared && part.left == composition.carriers[0];
        BodyDescription body = read_body(axle.table(part.name), carries ? wheel : WheelDescription{});
        if (right) mirror(body);
        to.bodies.push_back({right ? part.right : part.left, body});
    }
}

// What is one piece has no right side of its own.
void check_shared_parts(const AxleTables& axle, const AxleSides& sides) {
    if (!axle.differ() || !sides.hold_both()) return;
    const TableReader right = axle.left.table("right");
    for (const PartChoice& part : sides.left.parts) {
        if (part.left == part.right && right.has(part.name))
            right.expect(false, part.name, "no such table: it is one part for both sides");
    }
    for (const char* key : {"joint", "cut", "carrier_part", "drive_reaction_part"}) {
        if (right.has(key)) right.expect(false, key, "no such key: this linkage holds both sides");
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

// An axle as one suspension with two wheels, or one on each side.
void add_suspensions(const AxleTables& axle, const NamedTires& tires, const AxleSides& sides,
                     const SuspensionDescription& named, VehicleDescription& vehicle) {
    const bool one = sides.hold_both();
    check_shared_parts(axle, sides);
    SuspensionDescription left = named, right = named;
    left.linkage = sides.left.linkage, right.linkage = sides.right.linkage;
    left.wheels = {read_wheel_of(axle.left, tires, vehicle.brakes, sides.left, 0)};
    add_bodies(axle.left, sides, false, left);
    SuspensionDescription& of_right = one ? left : right;
    of_right.wheels.push_back(mirrored_wheel(
        read_wheel_of(axle.of_right(), tires, vehicle.brakes, sides.of_right(), one ? 1 : 0), named.name));
    add_bodies(axle.of_right(), sides, true, of_right);
    add_springs_and_dampers(axle, sides, left, of_right);
    align_axle(axle, sides, left, of_right);
    if (!one) left.name += "_left", right.name += "_right";
    if (!axle.left.is_recording()) check_sizes(axle.left, left), check_sizes(axle.of_right(), of_right);
    vehicle.suspensions.push_back(left);
    if (!one) vehicle.suspensions.push_back(right);
}

std::vector<std::string_view> suspension_keywords() {
    std::vector<std::string_view> words;
    for (const Recipe* recipe : recipes()) words.push_back(recipe->keyword);
    words.push_back("linkage");
    return words;
}

// Whether a rack moves any part of it.
bool is_steered(const LinkageDescription& linkage) {
    return std::ranges::any_of(linkage.cuts, [](const CutJointDescription& cut) { return cut.drive != Point{}; });
}

// An actuator that moves the axle's rack in place of the steering wheel.
void read_steering_actuator(const TableReader& axle, std::size_t unit, std::size_t first, VehicleDescription& vehicle) {
    const auto table = axle.optional_table("steering_actuator");
    if (!table) return;
    constexpr Range travel{"number above 0, 0.2 at most", 0, 0.2, false}, frequency{"number from 0.1 to 50", 0.1, 50};
    constexpr Range damping{"number from 0.1 to 2", 0.1, 2};
    const AxleSteerDescription own{.axle = axle.text("name"),
                                   .travel = table->number("travel_m", travel),
                                   .frequency = 2 * std::numbers::pi * table->number("frequency_hz", frequency, 5),
                                   .damping_ratio = table->number("damping_ratio", damping, 1)};
    if (axle.is_recording()) return;
    axle.expect(unit == 0, "steering_actuator", "no such table on a trailer");
    axle.expect(is_steered(vehicle.suspensions[first].linkage), "steering_actuator",
                "a linkage whose 'steered' is true, or with a cut that has a 'drive'");
    axle.expect(vehicle.axle_steers.size() < max_axle_steers, "steering_actuator",
                std::to_string(max_axle_steers) + " axles with it at most");
    for (std::size_t s = first; s < vehicle.suspensions.size(); ++s) {
        vehicle.suspensions[s].steered_by = vehicle.axle_steers.size();
    }
    vehicle.axle_steers.push_back(own);
}

// Keys that an axle has for both of its sides.
constexpr std::string_view of_both_sides[] = {
    "name", "suspension", "drive_share", "twist_spring", "right_carrier_part", "right", "steering_actuator"};

}  // namespace

void read_axle(const TableReader& axle, const NamedTires& tires, std::size_t unit, VehicleDescription& vehicle) {
    const std::size_t first_wheel = wheel_count(vehicle), first = vehicle.suspensions.size();
    const std::vector<std::string_view> words = suspension_keywords();
    const AxleTables tables{axle, axle.laid_over("right", of_both_sides)};
    axle.choose("suspension", words, {}, [&](std::size_t word) {
        SuspensionDescription named;
        named.name = axle.text("name"), named.keyword = words[word], named.unit = unit;
        const auto add = [&](const AxleSides& sides) {
            add_suspensions(tables, tires, sides, named, vehicle);
            if (!sides.bar_rate) return;
            vehicle.anti_roll_bars.push_back(
                {first_wheel, first_wheel + 1, *sides.bar_rate, sides.bar_force, sides.bar_response});
        };
        if (const Recipe* recipe = find_recipe(words[word])) return read_recipe(tables, *recipe, unit > 0, add);
        read_own_linkage(tables, unit > 0, add);
    });
    read_steering_actuator(axle, unit, first, vehicle);
    axle.note_laid_over("right", of_both_sides, tables.right);
}

}  // namespace hamilcar::io
