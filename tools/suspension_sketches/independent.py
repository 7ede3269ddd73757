"""Suspensions of one wheel: a carrier on arms, on links or on a strut. Each function returns its sketch."""

from suspension_sketches.hardpoints import add_spring, page_axle, points_of, vehicle_axle
from suspension_sketches.sketch import Sketch
from suspension_sketches.vectors import between


def macpherson():
    axle, radius = vehicle_axle("bmw_323i.toml", "front")
    p, s = points_of(axle), Sketch("MacPherson strut", ["front", "side"], 520)
    center = s.wheel(axle["wheel"], radius)
    s.body([p["slide_point_m"], p["ball_joint_m"], p["tie_rod_outer_m"], center], "carrier")
    s.wishbone(p["arm_front_m"], p["arm_rear_m"], p["ball_joint_m"], "control arm")
    s.bar(p["slide_point_m"], between(p["slide_point_m"], p["strut_top_m"], 0.62), "strut", "carrier", width=7)
    s.bar(p["slide_point_m"], p["strut_top_m"], "", "carrier")
    s.spring(p["strut_top_m"], between(p["slide_point_m"], p["strut_top_m"], 0.62))
    s.ball(p["strut_top_m"], True, "top mount")
    s.hinge(p["slide_point_m"], False, "slide point")
    s.link(p["rack_end_m"], p["tie_rod_outer_m"], "tie rod", "driven")
    return s


def arm_on_hinge(s, axle, radius, first, second, label):
    p = points_of(axle)
    center = s.wheel(axle["wheel"], radius)
    s.body([p[first], p[second], center], label)
    s.axis(p[first], p[second], "pivot axis")
    s.hinge(p[first], True, "inner bush" if first.startswith("inner") else "rear bush", ["top"])
    s.hinge(p[second], True, "outer bush" if second.startswith("outer") else "front bush", ["top"])
    return p


def semi_trailing_arm():
    axle, radius = vehicle_axle("bmw_323i.toml", "rear")
    s = Sketch("Semi-trailing arm", ["top", "side"], 560)
    p = arm_on_hinge(s, axle, radius, "inner_bush_m", "outer_bush_m", "arm, the carrier")
    s.spring(p["spring_body_m"], p["spring_arm_m"])
    s.spring(p["damper_body_m"], p["damper_arm_m"], "damper", color="damper")
    return s


def trailing_arm():
    axle, radius = page_axle("trailing_arm")
    s = Sketch("Trailing arm", ["top", "side"], 560)
    arm_on_hinge(s, axle, radius, "inner_bush_m", "outer_bush_m", "arm, the carrier")
    add_spring(s, axle)
    return s


def swing_axle():
    axle, radius = page_axle("swing_axle")
    s = Sketch("Swing axle", ["front", "top"], 480)
    p = arm_on_hinge(s, axle, radius, "rear_bush_m", "front_bush_m", "half-axle, the carrier")
    add_spring(s, axle)
    s.axis((p["front_bush_m"][0], 0, 0.12), (p["front_bush_m"][0], 0, 0.5), "middle plane", ["front"])
    return s


def h_arm():
    axle, radius = page_axle("h_arm")
    p, s = points_of(axle), Sketch("H-arm with camber link", ["front", "top"], 560)
    center = s.wheel(axle["wheel"], radius)
    s.body([p["outer_front_m"], p["outer_rear_m"], p["camber_link_carrier_m"], center], "carrier")
    s.body([p["arm_front_m"], p["arm_rear_m"], p["outer_front_m"], p["outer_rear_m"]], "H-arm", "arm")
    s.axis(p["arm_rear_m"], p["arm_front_m"], "hinge on the chassis")
    s.axis(p["outer_rear_m"], p["outer_front_m"])
    s.hinge(p["arm_front_m"], True)
    s.hinge(p["arm_rear_m"], True)
    s.hinge(p["outer_front_m"], False, "hinge on the carrier", ["top"])
    s.hinge(p["outer_rear_m"])
    s.link(p["camber_link_body_m"], p["camber_link_carrier_m"], "camber link")
    add_spring(s, axle)
    return s


def integral_link():
    axle, radius = page_axle("integral_link")
    p, s = points_of(axle), Sketch("Integral link", ["front", "top"], 560)
    center = s.wheel(axle["wheel"], radius)
    ends = [p[f"{name}_carrier_m"] for name in ("integral_link", "camber_link", "toe_link")]
    s.body([p["arm_ball_m"], *ends, center], "carrier")
    s.body([p["arm_front_m"], p["arm_rear_m"], p["arm_ball_m"], p["integral_link_arm_m"]], "lower arm", "arm")
    s.axis(p["arm_rear_m"], p["arm_front_m"], "hinge on the chassis")
    s.hinge(p["arm_front_m"], True)
    s.hinge(p["arm_rear_m"], True)
    s.ball(p["arm_ball_m"])
    s.bar(p["integral_link_arm_m"], p["integral_link_carrier_m"], "integral link", "rod")
    s.ball(p["integral_link_arm_m"])
    s.ball(p["integral_link_carrier_m"])
    s.link(p["camber_link_body_m"], p["camber_link_carrier_m"], "camber link")
    s.link(p["toe_link_body_m"], p["toe_link_carrier_m"], "toe link")
    add_spring(s, axle)
    return s


def double_wishbone():
    axle, radius = vehicle_axle("formula.toml", "front")
    p, s = points_of(axle), Sketch("Double wishbone with push rod", ["front", "side"], 690)
    center = s.wheel(axle["wheel"], radius)
    s.body([p["lower_ball_m"], p["upper_ball_m"], p["tie_rod_outer_m"], center], "carrier")
    s.wishbone(p["lower_front_m"], p["lower_rear_m"], p["lower_ball_m"], "lower arm")
    s.bar(p["lower_ball_m"], axle["rocker"]["rod_end_m"], "", "arm", width=2)
    s.wishbone(p["upper_front_m"], p["upper_rear_m"], p["upper_ball_m"], "upper arm")
    s.link(p["tie_rod_body_m"], p["tie_rod_outer_m"], "tie rod", "driven")
    rocker = axle["rocker"]
    s.body([rocker["pivot_m"], rocker["rod_rocker_m"], axle["spring"]["at_m"]], "rocker", "rod")
    s.bar(rocker["rod_end_m"], rocker["rod_rocker_m"], "push rod", "rod")
    s.ball(rocker["rod_end_m"])
    s.ball(rocker["rod_rocker_m"])
    s.hinge(rocker["pivot_m"], True)
    add_spring(s, axle, views=["front"])
    return s


def five_link():
    axle, radius = vehicle_axle("bmw_e90_330i.toml", "rear")
    p, s = points_of(axle), Sketch("Five links", ["front", "top"], 560)
    center = s.wheel(axle["wheel"], radius)
    s.body([p[f"link_{i}_carrier_m"] for i in range(1, 6)] + [center], "carrier")
    for i in range(1, 6):
        s.link(p[f"link_{i}_body_m"], p[f"link_{i}_carrier_m"], f"link {i}", "arm" if i == 1 else "link")
    add_spring(s, axle)
    return s


def linkage():
    axle, radius = page_axle("linkage")
    s = Sketch("Strut with two lateral links and a trailing link", ["front", "top"], 500)
    center = s.wheel(axle["wheel"], radius)
    top = axle["joint"][0]["point_m"]
    slide = axle["joint"][1]["point_m"]
    s.body([cut["tip_m"] for cut in axle["cut"]] + [slide, center], "carrier")
    s.bar(slide, between(slide, top, 0.6), "strut", "carrier", ["front"], width=7)
    s.bar(slide, top, "", "carrier")
    s.ball(top, True, "top mount", ["front"])
    s.hinge(slide)
    for cut in axle["cut"]:
        s.link(cut["foot_m"], cut["tip_m"], cut["name"], "arm" if "trailing" in cut["name"] else "link")
    add_spring(s, axle)
    return s
