// A linkage of every recipe, with the hardpoints of no car in particular, and variants: steered axles, a push rod.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/linkage/compose.hpp"
#include "hamilcar/suspension/attachments.hpp"

namespace hamilcar::test {

struct LinkageSample {
    std::string name, keyword;
    LinkageDescription linkage;
    std::vector<PartPoint> wheels;
    std::vector<int> bar_arms{};  // coordinates of an anti-roll bar's arms, of the wheels
};
inline void PrintTo(const LinkageSample& sample, std::ostream* out) {
    *out << sample.name;
}

inline LinkageSample sample(const std::string& keyword, const Composition& made, const std::string& suffix) {
    LinkageSample out{keyword + suffix, keyword, made.linkage, {}, made.bar_arms};
    const Point center{0.01, 0.72, 0.3};
    for (std::size_t i = 0; i < made.carriers.size(); ++i) {
        out.wheels.push_back({made.carriers[i], i == 0 ? center : mirrored(center)});
    }
    return out;
}

inline LinkageSample sample(const std::string& keyword, const Hardpoints& points, const std::string& suffix = "") {
    return sample(keyword, find_recipe(keyword)->compose(points), suffix);
}

inline LinkageSample sample_with_parts(const std::string& keyword, const Hardpoints& points,
                                       const std::vector<std::string>& links, const std::string& suffix) {
    Composition made = find_recipe(keyword)->compose(points);
    for (const std::string& link : links) make_part(made, link);
    return sample(keyword, made, suffix);
}

// With a bar's drop link on a part, the link of that key a part of its own where `link` names one.
inline LinkageSample sample_with_bar(const std::string& keyword, const Hardpoints& points, const std::string& link,
                                     const BarArm& arm, const std::string& suffix) {
    Composition made = find_recipe(keyword)->compose(points);
    if (!link.empty()) make_part(made, link);
    const PartChoice& part = link.empty() ? made.parts.front() : made.parts.back();
    const bool both = made.carriers.size() == 2;
    BarArm left = arm, right{mirrored(arm.pivot), mirrored(arm.end), mirrored(arm.link), part.right};
    left.part = part.left;
    add_bar_arm(made, both ? "left " : "", left);
    if (both) add_bar_arm(made, "right ", right);
    return sample(keyword, made, suffix);
}

inline Hardpoints solid_axle_points() {
    Hardpoints p;
    p.points = {{"lower_body_m", {0.9, 0.42, 0.33}},
                {"lower_axle_m", {0.05, 0.5, 0.25}},
                {"upper_body_m", {0.5, 0.22, 0.55}},
                {"upper_axle_m", {0.0, 0.1, 0.45}},
                {"panhard_body_m", {-0.15, 0.5, 0.38}},
                {"panhard_axle_m", {-0.13, -0.5, 0.34}},
                {"watt_pivot_m", {-0.14, 0.0, 0.31}},
                {"watt_axis", {1, 0, 0}},
                {"watt_left_crank_m", {-0.14, 0.02, 0.39}},
                {"watt_left_body_m", {-0.14, 0.5, 0.4}},
                {"watt_right_crank_m", {-0.14, -0.02, 0.23}},
                {"watt_right_body_m", {-0.14, -0.5, 0.22}},
                {"front_eye_m", {0.7, 0.5, 0.34}},
                {"seat_m", {0.0, 0.52, 0.36}},
                {"kingpin_lower_m", {0.02, 0.62, 0.2}},
                {"kingpin_upper_m", {0.0, 0.59, 0.4}},
                {"tie_rod_m", {-0.16, 0.57, 0.28}},
                {"drag_link_body_m", {0.55, 0.45, 0.5}},
                {"drag_link_knuckle_m", {0.0, 0.44, 0.43}},
                {"rack_axis", {1, 0, 0}}};
    p.numbers = {{"steered", 0}, {"link_share", 0.75}};
    return p;
}

inline Hardpoints wishbone_points() {
    Hardpoints p;
    p.points = {{"lower_front_m", {0.2, 0.3, 0.2}},
                {"lower_rear_m", {-0.2, 0.32, 0.21}},
                {"lower_ball_m", {0.01, 0.68, 0.18}},
                {"upper_front_m", {0.12, 0.4, 0.5}},
                {"upper_rear_m", {-0.15, 0.42, 0.47}},
                {"upper_ball_m", {-0.02, 0.64, 0.5}},
                {"tie_rod_body_m", {0.13, 0.33, 0.25}},
                {"tie_rod_outer_m", {0.14, 0.68, 0.24}},
                {"rack_axis", {0, 1, 0}},
                {"pivot_m", {0.0, 0.3, 0.6}},
                {"axis", {1, 0, 0}},
                {"rod_rocker_m", {0.0, 0.36, 0.62}},
                {"rod_end_m", {0.0, 0.62, 0.22}}};
    p.numbers = {{"steered", 1}};
    return p;
}

inline Hardpoints five_link_points() {
    Hardpoints p;
    p.points = {{"link_1_body_m", {-0.02, 0.25, 0.22}},
                {"link_1_carrier_m", {0.02, 0.68, 0.19}},
                {"link_2_body_m", {0.45, 0.4, 0.28}},
                {"link_2_carrier_m", {0.08, 0.66, 0.22}},
                {"link_3_body_m", {0.02, 0.35, 0.44}},
                {"link_3_carrier_m", {0.0, 0.64, 0.43}},
                {"link_4_body_m", {0.3, 0.42, 0.45}},
                {"link_4_carrier_m", {0.06, 0.63, 0.42}},
                {"link_5_body_m", {-0.15, 0.3, 0.26}},
                {"link_5_carrier_m", {-0.14, 0.68, 0.25}},
                {"rack_axis", {0, 1, 0}}};
    p.numbers = {{"steered", 0}};
    return p;
}

inline Hardpoints arm_points() {
    Hardpoints p;
    p.points = {{"inner_bush_m", {0.3, 0.2, 0.28}},
                {"outer_bush_m", {0.42, 0.6, 0.3}},
                {"front_bush_m", {0.2, 0.12, 0.3}},
                {"rear_bush_m", {-0.2, 0.1, 0.31}},
                {"arm_front_m", {0.25, 0.28, 0.22}},
                {"arm_rear_m", {-0.2, 0.3, 0.2}},
                {"outer_front_m", {0.18, 0.66, 0.21}},
                {"outer_rear_m", {-0.14, 0.65, 0.2}},
                {"camber_link_body_m", {0.0, 0.35, 0.48}},
                {"camber_link_carrier_m", {0.02, 0.64, 0.46}},
                {"arm_ball_m", {-0.08, 0.66, 0.19}},
                {"integral_link_arm_m", {0.17, 0.62, 0.22}},
                {"integral_link_carrier_m", {0.15, 0.65, 0.35}},
                {"toe_link_body_m", {-0.22, 0.33, 0.24}},
                {"toe_link_carrier_m", {-0.2, 0.68, 0.23}},
                {"rack_axis", {0, 1, 0}},
                {"bush_m", {0.4, 0.55, 0.3}},
                {"beam_m", {0.2, 0.5, 0.33}}};
    p.numbers = {{"steered", 0}};
    return p;
}

inline Hardpoints strut_points() {
    Hardpoints p;
    p.points = {
        {"strut_top_m", {-0.1, 0.5, 0.8}}, {"slide_point_m", {-0.02, 0.6, 0.28}}, {"arm_front_m", {0.0, 0.32, 0.19}},
        {"arm_rear_m", {-0.3, 0.33, 0.2}}, {"ball_joint_m", {0.0, 0.65, 0.17}},   {"rack_end_m", {0.11, 0.32, 0.21}},
        {"rack_axis", {0, 1, 0}},          {"tie_rod_outer_m", {0.11, 0.7, 0.19}}};
    p.numbers = {{"steered", 1}};
    return p;
}

inline std::vector<LinkageSample> recipe_samples() {
    Hardpoints steered = solid_axle_points(), rocker = wishbone_points();
    steered.numbers["steered"] = 1;
    rocker.rod_on = "lower_arm";
    Hardpoints four = solid_axle_points();
    four.points["upper_axle_m"] = {0.0, 0.08, 0.45}, four.points["upper_body_m"] = {0.5, 0.4, 0.5};
    return {sample("macpherson", strut_points()),
            sample("double_wishbone", wishbone_points()),
            sample("double_wishbone", rocker, "_with_rocker"),
            sample("five_link", five_link_points()),
            sample("semi_trailing_arm", arm_points()),
            sample("trailing_arm", arm_points()),
            sample("swing_axle", arm_points()),
            sample("h_arm", arm_points()),
            sample("integral_link", arm_points()),
            sample("twist_beam", arm_points()),
            sample("four_link_axle", four),
            sample("panhard_axle", solid_axle_points()),
            sample("panhard_axle", steered, "_steered"),
            sample("watt_axle", solid_axle_points()),
            sample("leaf_axle", solid_axle_points()),
            sample("leaf_axle", steered, "_steered"),
            sample_with_bar("macpherson", strut_points(), "", {{-0.3, 0.4, 0.2}, {0.02, 0.55, 0.22}, {0.03, 0.57, 0.5}},
                            "_with_bar"),
            sample_with_bar("double_wishbone", wishbone_points(), "upper_arm",
                            {{-0.4, 0.35, 0.4}, {-0.1, 0.5, 0.41}, {-0.05, 0.55, 0.49}}, "_with_bar_on_upper_arm"),
            sample_with_bar("five_link", five_link_points(), "link_3",
                            {{0.35, 0.4, 0.3}, {0.1, 0.5, 0.3}, {0.01, 0.52, 0.44}}, "_with_bar_on_link_3"),
            sample_with_bar("panhard_axle", solid_axle_points(), "",
                            {{0.5, 0.3, 0.4}, {0.1, 0.35, 0.4}, {0.1, 0.36, 0.3}}, "_with_bar"),
            sample_with_parts("four_link_axle", four, {"lower_link"}, "_with_links_as_parts")};
}

}  // namespace hamilcar::test
