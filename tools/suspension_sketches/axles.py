"""Suspensions that join both wheels: solid axles and the twist beam. Each function returns its sketch."""

from suspension_sketches.hardpoints import add_spring, page_axle, points_of, vehicle_axle
from suspension_sketches.sketch import Sketch
from suspension_sketches.vectors import add, between, mirrored


def rigid_axle(s, axle, radius, attachments):
    """Both wheels and the axle between them, with a bracket to every joint on it."""
    center = s.wheel(axle["wheel"], radius)
    s.wheel({**axle["wheel"], "center_m": mirrored(center)}, radius, "")
    s.bar(mirrored(center), center, "axle", "carrier", width=6)
    for p in attachments:
        s.bar(p, (center[0], p[1], center[2]), "", "carrier", width=2)


def lower_links(s, p):
    s.link(p["lower_body_m"], p["lower_axle_m"], "lower link", only=["side", "top"])
    s.link(mirrored(p["lower_body_m"]), mirrored(p["lower_axle_m"]))


def four_link_axle():
    axle, radius = vehicle_axle("offroader.toml", "rear")
    p, s = points_of(axle), Sketch("Solid axle on four links", ["front", "side", "top"], 235)
    sides = [p["lower_axle_m"], p["upper_axle_m"]]
    rigid_axle(s, axle, radius, sides + [mirrored(q) for q in sides])
    lower_links(s, p)
    s.link(p["upper_body_m"], p["upper_axle_m"], "upper link", "arm", ["side", "top"])
    s.link(mirrored(p["upper_body_m"]), mirrored(p["upper_axle_m"]), color="arm")
    add_spring(s, axle, both=True)
    return s


def panhard_axle():
    axle, radius = vehicle_axle("offroader.toml", "front")
    p, s = points_of(axle), Sketch("Steered solid axle on three links with Panhard rod", ["front", "side", "top"], 235)
    center = s.wheel(axle["wheel"], radius)
    s.wheel({**axle["wheel"], "center_m": mirrored(center)}, radius, "")
    lower, upper = p["kingpin_lower_m"], p["kingpin_upper_m"]
    middle = between(lower, upper)
    s.bar(mirrored(middle), middle, "axle", "carrier", width=6)
    for q in (p["lower_axle_m"], mirrored(p["lower_axle_m"]), p["upper_axle_m"], p["panhard_axle_m"]):
        s.bar(q, (middle[0], q[1], middle[2]), "", "carrier", width=2)
    for side in (lambda q: q, mirrored):
        own = [p["drag_link_knuckle_m"]] if side is not mirrored else []
        s.body([side(q) for q in (lower, upper, p["tie_rod_m"], center)] + own,
               "" if side is mirrored else "knuckle", "rod", ["front", "top"])
        s.axis(side(lower), side(upper), "" if side is mirrored else "kingpin", ["front"], beyond=0.09)
    lower_links(s, p)
    s.link(p["upper_body_m"], p["upper_axle_m"], "upper link", "arm", ["side", "top"])
    s.link(p["panhard_body_m"], p["panhard_axle_m"], "Panhard rod", "arm", ["front", "top"])
    s.link(p["tie_rod_m"], mirrored(p["tie_rod_m"]), "tie rod", only=["front", "top"], inner_on_chassis=False)
    s.link(p["drag_link_body_m"], p["drag_link_knuckle_m"], "drag link", "driven", ["front", "top"])
    return s


def watt_axle():
    axle, radius = page_axle("watt_axle")
    p, s = points_of(axle), Sketch("Solid axle on three links with Watt linkage", ["front", "side", "top"], 235)
    rigid_axle(s, axle, radius, [p["lower_axle_m"], mirrored(p["lower_axle_m"]), p["upper_axle_m"], p["watt_pivot_m"]])
    lower_links(s, p)
    s.link(p["upper_body_m"], p["upper_axle_m"], "upper link", "arm", ["side", "top"])
    s.bar(p["watt_left_crank_m"], p["watt_right_crank_m"], "bell crank", "rod", ["front"], width=5)
    s.link(p["watt_left_body_m"], p["watt_left_crank_m"], "left Watt rod", "rod", ["front"])
    s.link(p["watt_right_body_m"], p["watt_right_crank_m"], "right Watt rod", "rod", ["front", "top"])
    s.hinge(p["watt_pivot_m"])
    return s


def leaf_axle():
    axle, radius = vehicle_axle("pickup.toml", "rear")
    p, s = points_of(axle), Sketch("Solid axle on leaf springs", ["front", "side", "top"], 235)
    eye, seat = p["front_eye_m"], p["seat_m"]
    pivot = between(seat, eye, axle["hardpoints"].get("link_share", 0.75))
    raised = [add((q[0], 0, q[2]), (0, 0, 0.15)) for q in (pivot, seat)]
    rigid_axle(s, axle, radius, [seat, mirrored(seat), raised[1]])
    leaf = [(seat[0] + u * (eye[0] - seat[0]), eye[1], seat[2] + u * u * (eye[2] - seat[2]))
            for u in (i / 12 for i in range(-12, 13))]
    s.curve(leaf, "leaf", ["side", "top"])
    s.curve([mirrored(q) for q in leaf])
    s.link(pivot, seat, "link of the leaf", only=["side", "top"])
    s.link(mirrored(pivot), mirrored(seat))
    s.link(*raised, "wind-up link", "arm")
    s.hinge(eye, True, "front eye", ["side", "top"])
    s.hinge(mirrored(eye), True)
    return s


def twist_beam():
    axle, radius = vehicle_axle("hatchback.toml", "rear")
    p, s = points_of(axle), Sketch("Twist beam", ["top", "side"], 330)
    center = s.wheel(axle["wheel"], radius)
    s.wheel({**axle["wheel"], "center_m": mirrored(center), "camber_deg": -axle["wheel"]["camber_deg"],
             "toe_in_deg": -axle["wheel"]["toe_in_deg"]}, radius, "")
    bush, beam = p["bush_m"], p["beam_m"]
    end = (beam[0], bush[1] - 0.03, beam[2])
    s.body([bush, end, center], "left arm, a carrier")
    s.body([mirrored(q) for q in (bush, end, center)], "right arm, a carrier", only=["top"])
    s.bar(mirrored(end), end, "beam, twists", "rod", width=6)
    s.hinge((beam[0], 0, beam[2]), False, "stays in the middle plane", ["top"])
    s.axis(mirrored(bush), bush, "bushes slide along this line", ["top"], beyond=0.12)
    s.ball(bush, True, "bush")
    s.ball(mirrored(bush), True)
    add_spring(s, axle, views=["side"])
    return s
