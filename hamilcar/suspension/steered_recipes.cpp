// Single-wheel suspensions whose last link may be attached to the rack: MacPherson strut, double wishbone, five links.
#include <string>

#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

namespace {

constexpr auto point = HardpointKind::point;
constexpr HardpointKey steered =
    one_for_both({"steered", HardpointKind::flag, "whether the rack moves the last link's inner end", {1}});
constexpr HardpointKey not_steered =
    one_for_both({"steered", HardpointKind::flag, "whether the rack moves link 5's end", {0}});
constexpr HardpointKey rack_axis = one_for_both(
    {"rack_axis", HardpointKind::direction, "in which a positive rack displacement moves that end", {0, 1, 0}});

// A rod that the rack moves if the axle is steered.
void add_rod(Composition& to, const Hardpoints& p, const char* name, std::size_t carrier, const Point& outer,
             const Point& inner) {
    CutJointDescription& rod = to.cut(CutJoint::distance, name, carrier, outer, 0, inner);
    if (p.flag("steered")) rod.drive = p["rack_axis"];
}

// The carrier slides on a strut that turns in its top mount; the paper's Fig. 3.
Composition macpherson(const Hardpoints& p) {
    Composition out;
    const std::size_t strut = out.join(TreeJoint::spherical, "strut", 0, p["strut_top_m"]);
    const std::size_t carrier = out.join(TreeJoint::prismatic, "carrier", strut, p["slide_point_m"],
                                         direction_between(p["strut_top_m"], p["slide_point_m"]));
    CutJointDescription& arm = out.arm("control arm", carrier, p["ball_joint_m"], p["arm_front_m"], p["arm_rear_m"]);
    if (p.numbers.contains("arm_length_m")) arm.length = p.number("arm_length_m");
    add_rod(out, p, "tie rod", carrier, p["tie_rod_outer_m"], p["rack_end_m"]);
    if (p.numbers.contains("tie_rod_length_m")) out.linkage.cuts.back().length = p.number("tie_rod_length_m");
    constexpr int length = 3;  // of the strut
    out.linkage.independent = {length};
    out.spring_line = {.coordinate = length, .at_design = distance(p["strut_top_m"], p["slide_point_m"])};
    out.damper_line = out.spring_line;
    out.parts = {{"carrier", carrier, carrier, true, true}};
    out.carriers = {carrier};
    out.kingpin = {{{carrier, p["ball_joint_m"]}, {strut, p["strut_top_m"]}}};
    out.adjusters = {{WheelAngle::toe, "tie rod"},
                     {WheelAngle::camber, "strut", {{0, 1, 0}}},
                     {WheelAngle::caster, "strut", {{1, 0, 0}}}};
    return out;
}

// A bell crank on the chassis that a rod from the suspension turns.
void add_rocker(Composition& to, const Hardpoints& p) {
    const std::size_t rocker = to.join(TreeJoint::revolute, "rocker", 0, p["pivot_m"], p["axis"]);
    std::size_t part = 0;
    for (const PartChoice& choice : to.parts) {
        if (choice.name == p.rod_on) part = choice.left;
    }
    to.cut(CutJoint::distance, "push rod", part, p["rod_end_m"], rocker, p["rod_rocker_m"]);
    to.parts.push_back({"rocker", rocker, rocker, true, true});
}

// The lower arm carries the carrier's lower ball; the upper arm has no mass of its own and is a cut joint.
Composition double_wishbone(const Hardpoints& p) {
    Composition out;
    const std::size_t arm = out.hinge("lower arm", 0, p["lower_rear_m"], p["lower_front_m"]);
    const std::size_t carrier = out.join(TreeJoint::spherical, "carrier", arm, p["lower_ball_m"]);
    out.arm("upper arm", carrier, p["upper_ball_m"], p["upper_rear_m"], p["upper_front_m"]);
    const char* rod = p.flag("steered") ? "tie rod" : "toe link";
    add_rod(out, p, rod, carrier, p["tie_rod_outer_m"], p["tie_rod_body_m"]);
    out.linkage.independent = {0};  // the lower arm's angle
    out.parts = {{"carrier", carrier, carrier, true, true}, {"lower_arm", arm, arm, true, false}};
    out.carriers = {carrier};
    out.kingpin = {{{carrier, p["lower_ball_m"]}, {carrier, p["upper_ball_m"]}}};
    out.adjusters = {{WheelAngle::toe, rod},
                     {WheelAngle::camber, "upper arm", {{0, 1, 0}}},
                     {WheelAngle::caster, "upper arm", {{1, 0, 0}}}};
    if (!p.rod_on.empty()) add_rocker(out, p);
    return out;
}

// Link 1 is part of the tree, so that four loops remain of five.
Composition five_link(const Hardpoints& p) {
    Composition out;
    const Point body = p["link_1_body_m"], outer = p["link_1_carrier_m"];
    const std::array<Point, 2> axes = link_axes(body, outer);
    const std::size_t link = out.join(TreeJoint::universal, "link 1", 0, body, axes[0], axes[1]);
    const std::size_t carrier = out.join(TreeJoint::spherical, "carrier", link, outer);
    for (int i = 2; i <= 4; ++i) {
        const std::string key = "link_" + std::to_string(i);
        out.cut(CutJoint::distance, "link " + std::to_string(i), carrier, p[key + "_carrier_m"], 0, p[key + "_body_m"]);
    }
    add_rod(out, p, "link 5", carrier, p["link_5_carrier_m"], p["link_5_body_m"]);
    out.linkage.independent = {0};  // link 1's elevation
    out.parts = {{"carrier", carrier, carrier, true, true}, {"link_1", link, link, true, false}};
    out.carriers = {carrier};
    out.adjusters = {{WheelAngle::toe, "link 5"}, {WheelAngle::camber, "link 4"}};
    return out;
}

}  // namespace

const Recipe macpherson_recipe{.keyword = "macpherson",
                               .title = "MacPherson strut",
                               .keys = {{"strut_top_m", point, "top mount"},
                                        {"slide_point_m", point, "a point of the strut's axis on the carrier"},
                                        {"arm_front_m", point, "control arm's axis, front bush"},
                                        {"arm_rear_m", point, "control arm's axis, rear bush"},
                                        {"ball_joint_m", point, "control arm's ball on the carrier"},
                                        {"rack_end_m", point, "tie rod, inner end"},
                                        {"tie_rod_outer_m", point, "tie rod, end on the carrier"},
                                        steered,
                                        rack_axis,
                                        {"arm_length_m", HardpointKind::length, "control arm's ball from its axis"},
                                        {"tie_rod_length_m", HardpointKind::length, "between the tie rod's ends"}},
                               .spring_part = "carrier",
                               .distinct_points = {{"strut_top_m", "slide_point_m"},
                                                   {"arm_front_m", "arm_rear_m"},
                                                   {"rack_end_m", "tie_rod_outer_m"}},
                               .compose = macpherson,
                               .typical = {.points = {{"strut_top_m", {-0.113, 0.532, 0.852}},
                                                      {"slide_point_m", {-0.026, 0.644, 0.3}},
                                                      {"arm_front_m", {0, 0.341, 0.202}},
                                                      {"arm_rear_m", {-0.316, 0.359, 0.202}},
                                                      {"ball_joint_m", {-0.006, 0.699, 0.177}},
                                                      {"rack_end_m", {0.115, 0.348, 0.228}},
                                                      {"tie_rod_outer_m", {0.119, 0.747, 0.204}},
                                                      {"rack_axis", {0, 1, 0}}}}};

const Recipe double_wishbone_recipe{.keyword = "double_wishbone",
                                    .title = "Double wishbone",
                                    .keys = {{"lower_front_m", point, "lower arm's axis, front bush"},
                                             {"lower_rear_m", point, "lower arm's axis, rear bush"},
                                             {"lower_ball_m", point, "lower arm's ball on the carrier"},
                                             {"upper_front_m", point, "upper arm's axis, front bush"},
                                             {"upper_rear_m", point, "upper arm's axis, rear bush"},
                                             {"upper_ball_m", point, "upper arm's ball on the carrier"},
                                             {"tie_rod_body_m", point, "tie rod or toe link, inner end"},
                                             {"tie_rod_outer_m", point, "tie rod or toe link, end on the carrier"},
                                             steered,
                                             rack_axis},
                                    .spring_part = "lower_arm",
                                    .may_have_rocker = true,
                                    .compose = double_wishbone,
                                    .typical = {.points = {{"lower_front_m", {0.124, 0.312, 0.208}},
                                                           {"lower_rear_m", {-0.224, 0.312, 0.208}},
                                                           {"lower_ball_m", {0.006, 0.694, 0.212}},
                                                           {"upper_front_m", {0.083, 0.451, 0.429}},
                                                           {"upper_rear_m", {-0.108, 0.451, 0.429}},
                                                           {"upper_ball_m", {-0.011, 0.649, 0.452}},
                                                           {"tie_rod_body_m", {-0.115, 0.32, 0.233}},
                                                           {"tie_rod_outer_m", {-0.12, 0.655, 0.241}},
                                                           {"rack_axis", {0, -1, 0}}},
                                                .spring = {{{-0.025, 0.538, 0.224}, {-0.025, 0.486, 0.547}}},
                                                .damper = {{{-0.025, 0.538, 0.224}, {-0.025, 0.486, 0.547}}}}};

const Recipe five_link_recipe{.keyword = "five_link",
                              .title = "Five links",
                              .keys = {{"link_1_body_m", point, "link 1, end on the chassis; a lower lateral link"},
                                       {"link_1_carrier_m", point, "link 1, end on the carrier"},
                                       {"link_2_body_m", point, "link 2, end on the chassis"},
                                       {"link_2_carrier_m", point, "link 2, end on the carrier"},
                                       {"link_3_body_m", point, "link 3, end on the chassis"},
                                       {"link_3_carrier_m", point, "link 3, end on the carrier"},
                                       {"link_4_body_m", point, "link 4, end on the chassis"},
                                       {"link_4_carrier_m", point, "link 4, end on the carrier"},
                                       {"link_5_body_m", point, "link 5, end on the chassis or rack"},
                                       {"link_5_carrier_m", point, "link 5, end on the carrier"},
                                       not_steered,
                                       rack_axis},
                              .spring_part = "carrier",
                              .compose = five_link,
                              .typical = {.points = {{"link_1_body_m", {-0.174, 0.259, 0.178}},
                                                     {"link_1_carrier_m", {-0.017, 0.645, 0.176}},
                                                     {"link_2_body_m", {0.219, 0.412, 0.223}},
                                                     {"link_2_carrier_m", {-0.017, 0.645, 0.176}},
                                                     {"link_3_body_m", {0.147, 0.458, 0.362}},
                                                     {"link_3_carrier_m", {0.014, 0.651, 0.385}},
                                                     {"link_4_body_m", {-0.05, 0.402, 0.414}},
                                                     {"link_4_carrier_m", {0.014, 0.651, 0.385}},
                                                     {"link_5_body_m", {-0.219, 0.195, 0.277}},
                                                     {"link_5_carrier_m", {-0.149, 0.659, 0.255}},
                                                     {"rack_axis", {0, -1, 0}}},
                                          .spring = {{{-0.059, 0.601, 0.202}, {-0.078, 0.561, 0.437}}},
                                          .damper = {{{-0.074, 0.621, 0.212}, {-0.088, 0.53, 0.659}}}}};

}  // namespace hamilcar
