// The integral-link rear suspension: a wide lower arm on a hinge, a ball between arm and carrier, and a short upright link between both that
// keeps the carrier from turning about the ball when it brakes or drives.
#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

namespace {

constexpr auto point = HardpointKind::point;

// The ball leaves the carrier three rotations on the arm; each of the three links takes one.
Composition integral_link(const Hardpoints& p) {
    Composition out;
    const std::size_t arm = out.hinge("lower arm", 0, p["arm_rear_m"], p["arm_front_m"]);
    const std::size_t carrier = out.join(TreeJoint::spherical, "carrier", arm, p["arm_ball_m"]);
    out.cut(CutJoint::distance, "integral link", carrier, p["integral_link_carrier_m"], arm, p["integral_link_arm_m"]);
    out.cut(CutJoint::distance, "camber link", carrier, p["camber_link_carrier_m"], 0, p["camber_link_body_m"]);
    auto& toe_link = out.cut(CutJoint::distance, "toe link", carrier, p["toe_link_carrier_m"], 0, p["toe_link_body_m"]);
    if (p.flag("steered")) toe_link.drive = p["rack_axis"];
    out.linkage.independent = {0};  // the arm's angle
    out.parts = {{"carrier", carrier, carrier, true, true}, {"lower_arm", arm, arm, true, false}};
    out.carriers = {carrier};
    out.adjusters = {{WheelAngle::toe, "toe link"}, {WheelAngle::camber, "camber link"}};
    return out;
}

}  // namespace

const Recipe integral_link_recipe{
    .keyword = "integral_link",
    .title = "Integral link",
    .keys = {{"arm_front_m", point, "lower arm's axis on the chassis, front bush"},
             {"arm_rear_m", point, "lower arm's axis on the chassis, rear bush"},
             {"arm_ball_m", point, "lower arm's ball on the carrier"},
             {"integral_link_arm_m", point, "integral link, end on the lower arm"},
             {"integral_link_carrier_m", point, "integral link, end on the carrier"},
             {"camber_link_body_m", point, "upper link, end on the chassis"},
             {"camber_link_carrier_m", point, "upper link, end on the carrier"},
             {"toe_link_body_m", point, "toe link, end on the chassis or rack"},
             {"toe_link_carrier_m", point, "toe link, end on the carrier"},
             one_for_both({"steered", HardpointKind::flag, "whether the rack moves the toe link's inner end", {0}}),
             one_for_both({"rack_axis",
                           HardpointKind::direction,
                           "in which a positive rack displacement moves that end",
                           {0, 1, 0}})},
    .spring_part = "lower_arm",
    .compose = integral_link,
    .typical = {.points = {{"arm_front_m", {0.289, 0.266, 0.225}},
                           {"arm_rear_m", {-0.171, 0.296, 0.204}},
                           {"arm_ball_m", {-0.086, 0.651, 0.182}},
                           {"integral_link_arm_m", {0.182, 0.612, 0.214}},
                           {"integral_link_carrier_m", {0.161, 0.641, 0.354}},
                           {"camber_link_body_m", {-0.021, 0.375, 0.493}},
                           {"camber_link_carrier_m", {0.021, 0.641, 0.471}},
                           {"toe_link_body_m", {-0.236, 0.326, 0.246}},
                           {"toe_link_carrier_m", {-0.214, 0.671, 0.236}}},
                .spring = {{{0.043, 0.513, 0.236}, {0.043, 0.493, 0.536}}},
                .damper = {{{0.086, 0.572, 0.214}, {0.107, 0.513, 0.664}}}}};

}  // namespace hamilcar
