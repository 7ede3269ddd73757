// Suspensions on one hinge, and the H-arm, which is a hinge on a hinge.
#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

namespace {

// One revolute joint between two bushes, no loop: the arm's angle is the independent coordinate.
Composition hinge(const Point& from, const Point& to, const char* part) {
    Composition out;
    Point axis = direction_between(from, to);
    if (axis[1] < 0) axis = {-axis[0], -axis[1], -axis[2]};  // toward +y on both sides
    const std::size_t carrier = out.join(TreeJoint::revolute, part, 0, to, axis);
    out.linkage.joints.back().other_bush = from;
    out.parts = {{"carrier", carrier, carrier, true, true}};
    out.carriers = {carrier};
    return out;
}

Composition trailing(const Hardpoints& p) {
    return hinge(p["inner_bush_m"], p["outer_bush_m"], "arm");
}

// The paper's Fig. 4, with seats on the arm.
Composition semi_trailing(const Hardpoints& p) {
    Composition out = trailing(p);
    out.spring_line = {.part = out.carriers[0], .on_part = p["spring_arm_m"], .on_base = p["spring_body_m"]};
    out.damper_line = {.part = out.carriers[0], .on_part = p["damper_arm_m"], .on_base = p["damper_body_m"]};
    return out;
}

Composition swinging(const Hardpoints& p) {
    return hinge(p["rear_bush_m"], p["front_bush_m"], "half-axle");
}

// The arm's two hinges leave the carrier one rotation about the outer axis, which the camber link takes.
Composition h_arm(const Hardpoints& p) {
    Composition out;
    const std::size_t arm = out.hinge("lower arm", 0, p["arm_rear_m"], p["arm_front_m"]);
    const std::size_t carrier = out.hinge("carrier", arm, p["outer_rear_m"], p["outer_front_m"]);
    out.cut(CutJoint::distance, "camber link", carrier, p["camber_link_carrier_m"], 0, p["camber_link_body_m"]);
    out.linkage.independent = {0};
    out.parts = {{"carrier", carrier, carrier, true, true}, {"lower_arm", arm, arm, true, false}};
    out.carriers = {carrier};
    out.adjusters = {{WheelAngle::camber, "camber link"}};
    return out;
}

constexpr auto point = HardpointKind::point;

}  // namespace

const Recipe semi_trailing_arm_recipe{.keyword = "semi_trailing_arm",
                                      .title = "Semi-trailing arm",
                                      .keys = {{"inner_bush_m", point, "inner end of the pivot axis"},
                                               {"outer_bush_m", point, "outer end of the pivot axis"},
                                               {"spring_arm_m", point, "spring's seat on the arm"},
                                               {"spring_body_m", point, "spring's seat on the chassis"},
                                               {"damper_arm_m", point, "damper's mount on the arm"},
                                               {"damper_body_m", point, "damper's mount on the chassis"}},
                                      .spring_part = "carrier",
                                      .distinct_points = {{"inner_bush_m", "outer_bush_m"},
                                                          {"spring_arm_m", "spring_body_m"},
                                                          {"damper_arm_m", "damper_body_m"}},
                                      .compose = semi_trailing,
                                      .typical = {.points = {{"inner_bush_m", {0.314, 0.188, 0.3}},
                                                             {"outer_bush_m", {0.425, 0.603, 0.3}},
                                                             {"spring_arm_m", {0.083, 0.515, 0.252}},
                                                             {"spring_body_m", {0.096, 0.515, 0.504}},
                                                             {"damper_arm_m", {-0.075, 0.585, 0.257}},
                                                             {"damper_body_m", {-0.032, 0.569, 0.75}}}}};

const Recipe trailing_arm_recipe{
    .keyword = "trailing_arm",
    .title = "Trailing arm",
    .keys = {{"inner_bush_m", point, "inner end of the pivot axis"},
             {"outer_bush_m", point, "outer end of the pivot axis"}},
    .spring_part = "carrier",
    .compose = trailing,
    .typical = {.points = {{"inner_bush_m", {0.429, 0.396, 0.3}}, {"outer_bush_m", {0.429, 0.646, 0.3}}},
                .spring = {{{0.161, 0.521, 0.257}, {0.161, 0.521, 0.525}}},
                .damper = {{{-0.075, 0.573, 0.268}, {-0.032, 0.563, 0.718}}}}};

const Recipe swing_axle_recipe{
    .keyword = "swing_axle",
    .title = "Swing axle",
    .keys = {{"front_bush_m", point, "front end of the pivot axis"},
             {"rear_bush_m", point, "rear end of the pivot axis"}},
    .spring_part = "carrier",
    .compose = swinging,
    .typical = {.points = {{"front_bush_m", {0.107, 0.115, 0.3}}, {"rear_bush_m", {-0.129, 0.081, 0.3}}},
                .spring = {{{0, 0.485, 0.343}, {0, 0.485, 0.621}}},
                .damper = {{{-0.086, 0.554, 0.246}, {-0.064, 0.508, 0.643}}}}};

const Recipe h_arm_recipe{.keyword = "h_arm",
                          .title = "H-arm with camber link",
                          .keys = {{"arm_front_m", point, "arm's axis on the chassis, front bush"},
                                   {"arm_rear_m", point, "arm's axis on the chassis, rear bush"},
                                   {"outer_front_m", point, "arm's axis on the carrier, front bush"},
                                   {"outer_rear_m", point, "arm's axis on the carrier, rear bush"},
                                   {"camber_link_body_m", point, "upper link, end on the chassis"},
                                   {"camber_link_carrier_m", point, "upper link, end on the carrier"}},
                          .spring_part = "carrier",
                          .compose = h_arm,
                          .typical = {.points = {{"arm_front_m", {0.268, 0.284, 0.214}},
                                                 {"arm_rear_m", {-0.193, 0.304, 0.193}},
                                                 {"outer_front_m", {0.193, 0.649, 0.193}},
                                                 {"outer_rear_m", {-0.15, 0.639, 0.182}},
                                                 {"camber_link_body_m", {0, 0.365, 0.461}},
                                                 {"camber_link_carrier_m", {0.021, 0.639, 0.45}}},
                                      .spring = {{{-0.064, 0.628, 0.236}, {-0.064, 0.557, 0.621}}},
                                      .damper = {{{-0.064, 0.628, 0.236}, {-0.064, 0.557, 0.621}}}}};

}  // namespace hamilcar
