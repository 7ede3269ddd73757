// How to make a suspension of parts: the hardpoints that a file gives, and the composition that follows from them. A recipe
// has no kinematics; it names joints. The reader of files, the JSON Schema and the pages in docs/ all use its list of keys.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

// The point on the other side of the vehicle's middle plane.
inline Point mirrored(const Point& p) {
    return {p[0], -p[1], p[2]};
}

enum class HardpointKind { point, direction, flag, number, length };

// One key of the table [axle.hardpoints] or [axle.rocker]. Directions, flags and numbers have a default; a length that
// the file does not give is the distance between the points.
struct HardpointKey {
    std::string_view key;
    HardpointKind kind = HardpointKind::point;
    std::string_view meaning;
    Point default_value{};      // of a direction, or of a flag or a number in its first element
    bool only_steered = false;  // a point that is required only if the axle is steered
    bool shared = false;        // of a suspension with two wheels: there is one for both sides
};

// Of a suspension with two wheels, or of both sides of an axle: there is one of it.
constexpr HardpointKey one_for_both(HardpointKey key) {
    key.shared = true;
    return key;
}

// What was read, by key; flags are 0 or 1.
struct Hardpoints {
    std::map<std::string, Point, std::less<>> points;
    std::map<std::string, double, std::less<>> numbers;
    std::map<std::string, Point, std::less<>> right_points{};  // of a right side that differs, as a left one's
    std::string rod_on;  // of a rocker: the part that the rod's other end sits on; empty without a rocker

    const Point& operator[](std::string_view key) const { return points.find(key)->second; }
    bool flag(std::string_view key) const { return number(key) != 0; }
    double number(std::string_view key) const { return numbers.find(key)->second; }
    // On the right side of a suspension that carries both wheels.
    Point right(std::string_view key) const {
        const auto own = right_points.find(key);
        return mirrored(own == right_points.end() ? (*this)[key] : own->second);
    }
    Hardpoints mirrored_side() const {
        Hardpoints other = *this;
        for (auto& [key, point] : other.points) {
            if (key != "rack_axis") point = mirrored(point);  // the rack is one piece
        }
        return other;
    }
};

// A part that has a mass or that springs may act on: on a two-wheel suspension its left and its right copy, or the same one
// twice.
struct PartChoice {
    std::string name;
    std::size_t left = 1, right = 1;
    bool has_table = false, needs_table = false;  // [axle.NAME] with mass, center and inertia
};

double distance(const Point& a, const Point& b);
// Unit vector from a to b.
Point direction_between(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);
// Of the universal joint at the inner end of a link: one lifts its outer end, the other sweeps it; about neither the link spins.
std::array<Point, 2> link_axes(const Point& inner, const Point& outer);

// An angle of a wheel that is set on an alignment rack.
enum class WheelAngle { toe, camber, caster };
inline constexpr std::array<std::string_view, 3> wheel_angle_names{"toe", "camber", "caster"};

// What is turned or shimmed for that: a cut joint or the part that a tree joint carries. Without a direction the length of a rod changes;
// else the joint with all that hangs on it moves that way on what carries it.
struct Adjuster {
    WheelAngle sets;
    std::string joint;
    std::optional<Point> shift{};
};

struct PartEnd {
    std::size_t part = 0;
    Point point{};
};

struct Composition {
    LinkageDescription linkage;
    std::vector<PartChoice> parts;
    std::vector<std::size_t> carriers;  // of the wheels, left first
    std::size_t drive_reaction = 0;     // part that the drive torque reacts on: 0 the chassis
    std::vector<int> bar_arms;          // coordinates of an anti-roll bar's arms, of the wheels, left first; or none
    std::vector<Adjuster> adjusters;    // one for each angle, of each wheel
    std::array<PartEnd, 2> kingpin{};   // two points of the steering axis, lower one first, where caster can be set
    std::vector<std::string>
        bare_links{};                   // keys of the links that no key of the file names: nothing is mounted on them
    bool links_are_equivalent = false;  // they stand for something else, and nothing is mounted on them
    std::optional<int> twist;           // coordinate of a twist beam
    std::optional<LineDescription> spring_line, damper_line;  // of [axle.spring] and [axle.damper] where the suspension
                                                              // itself says where they act

    // Adds a joint and returns the number of the part it moves.
    std::size_t join(TreeJoint kind, const std::string& part, std::size_t parent, const Point& point,
                     const Point& axis = {}, const Point& second_axis = {}) {
        linkage.joints.push_back({kind, part, parent, point, axis, second_axis});
        return linkage.joints.size();
    }
    // A part that turns in two bushes.
    std::size_t hinge(const std::string& part, std::size_t parent, const Point& bush, const Point& other) {
        join(TreeJoint::revolute, part, parent, bush, direction_between(bush, other));
        linkage.joints.back().other_bush = other;
        return linkage.joints.size();
    }
    CutJointDescription& cut(CutJoint kind, const std::string& name, std::size_t part, const Point& tip,
                             std::size_t base, const Point& foot) {
        CutJointDescription cut;
        cut.kind = kind, cut.name = name, cut.part = part, cut.tip = tip, cut.base = base, cut.foot = foot;
        return linkage.cuts.emplace_back(cut);
    }
    // A massless arm that turns in two bushes on the chassis, with its ball at the tip.
    CutJointDescription& arm(const std::string& name, std::size_t part, const Point& ball, const Point& bush,
                             const Point& other) {
        CutJointDescription& arm = cut(CutJoint::revolute_spherical, name, part, ball, 0, bush);
        arm.axis = direction_between(bush, other), arm.other_bush = other;
        return arm;
    }
};

// An axle as it usually is, to start a vehicle from: estimates on the layout of shipped vehicles. The left side, its wheel center
// at (0, 0.75, 0.3); a solid axle's as a rear axle, but for the points of its steering. No ends where the suspension itself says
// where [axle.spring] and [axle.damper] act; a rack_axis where it is steered as it stands.
struct TypicalAxle {
    struct Ends {
        Point at{}, body{};
    };
    static constexpr Point wheel_center{0, 0.75, 0.3};
    std::map<std::string_view, Point> points;
    std::optional<Ends> spring, damper;
};

struct Recipe {
    std::string_view keyword;
    std::string_view title;
    bool two_wheels = false;
    std::vector<HardpointKey> keys;
    std::string_view spring_part;  // where springs and dampers act unless the file says otherwise
    bool may_have_rocker = false;
    std::vector<std::array<std::string_view, 2>> distinct_points{};  // pairs of keys whose points must differ
    Composition (*compose)(const Hardpoints&) = nullptr;  // of the side whose points they are, or of both wheels
    TypicalAxle typical{};
};

// Every recipe; a new one is one file and its name here and in recipes.cpp.
extern const Recipe macpherson_recipe, double_wishbone_recipe, five_link_recipe, semi_trailing_arm_recipe,
    trailing_arm_recipe, swing_axle_recipe, h_arm_recipe, integral_link_recipe, twist_beam_recipe,
    four_link_axle_recipe, panhard_axle_recipe, watt_axle_recipe, leaf_axle_recipe;
const std::vector<const Recipe*>& recipes();
// The recipe of that keyword, or null.
const Recipe* find_recipe(std::string_view keyword);

}  // namespace hamilcar
