"""Tractor and semi-trailer: not a sketch of parts, but two plain drawings of the whole vehicle, one below the other.

From the side it shows what belongs to which unit, from above the yaw angle at the hitch.
"""

import math
import tomllib

from suspension_sketches.elements import COLORS, INK, LABEL, SOFT, THIN, TIRE, TITLE, circle, page, polygon, text
from suspension_sketches.hardpoints import ROOT

SCALE = 46  # [px/m]
YAW = math.radians(15)
ORIGIN = 70 + SCALE * 1.4  # of x, in both views [px]
GROUND = 245  # of the side view [px]
MIDDLE = GROUND + 262  # line of the top view [px]
PULLING, PULLED = COLORS["carrier"], COLORS["rod"]


class Train:
    """What the drawings need of the vehicle file [m]."""

    def __init__(self, truck):
        trailer = truck["trailer"][0]
        self.hitch = trailer["hitch_m"]
        self.radius = truck["tire"]["truck"]["radius_m"]
        # Each with whether it is on the trailer.
        self.axles = [(axle, False) for axle in truck["axle"]] + [(axle, True) for axle in trailer["axle"]]
        first, last = (self.axles[i][0]["wheel"]["center_m"][0] for i in (0, -1))
        self.first, self.last = first, last
        self.right_edge = side_view(last - 2.2, 0)[0]  # behind the trailer [px]
        # Cab, frame and trailer: front, rear, lower, upper, half the width, whether on the trailer.
        self.boxes = [(first + 1.2, first - 1.3, 0.6, 3.0, 1.15, False),
                      (first - 1.3, self.hitch[0] - 1.6, 0.72, 1.08, 0.43, False),
                      (self.hitch[0] + 1.0, last - 1.6, 1.3, 4.0, 1.27, True)]

    def top_view(self, x, y, turned):
        """Place of a point that turns about the hitch if it is on the trailer."""
        dx, dy = x - self.hitch[0], y
        if turned:
            dx, dy = dx * math.cos(YAW) - dy * math.sin(YAW), dx * math.sin(YAW) + dy * math.cos(YAW)
        return (ORIGIN - SCALE * (self.hitch[0] + dx), MIDDLE + SCALE * dy)


def side_view(x, z):
    return (ORIGIN - SCALE * x, GROUND - SCALE * z)


def dash_dotted(a, b):
    return (f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{SOFT}" '
            f'stroke-width="1.1" stroke-dasharray="9 3 2 3"/>')


def hitch_mark(at):
    return circle(at, 5.5, "#ffffff", INK, 2)


def box_from_side(front, rear, lower, upper, color):
    a, b = side_view(front, upper), side_view(rear, lower)
    return (f'<rect x="{a[0]:.1f}" y="{a[1]:.1f}" width="{b[0] - a[0]:.1f}" height="{b[1] - a[1]:.1f}" rx="5" '
            f'fill="{color}" fill-opacity="0.13" stroke="{color}" stroke-width="2.2"/>')


def from_side(train):
    hitch, first, last, edge = train.hitch, train.first, train.last, train.right_edge
    out = [f'<line x1="24" y1="{GROUND}" x2="{edge + 20:.1f}" y2="{GROUND}" stroke="{SOFT}" stroke-width="1.4"/>']
    for axle, _ in train.axles:
        center = side_view(axle["wheel"]["center_m"][0], train.radius)
        out.append(circle(center, SCALE * train.radius, TIRE, SOFT, THIN))
    for front, rear, lower, upper, _, on_trailer in train.boxes:
        out.append(box_from_side(front, rear, lower, upper, PULLED if on_trailer else PULLING))
    x, y = side_view(hitch[0], hitch[2])
    out += [hitch_mark((x, y)), dash_dotted((x, y - 108), (x, y + 34)),
            text((x + 8, y - 92), "yaw axis, on the unit that pulls", INK, LABEL, "start", True),
            text((x - 12, y - 12), "hitch, pitch axis", INK, LABEL, "end", True),
            text(side_view(first + 1.1, 3.15), "unit 0: the hub", PULLING, LABEL, "start"),
            text(side_view(0.5 * (hitch[0] + last), 2.5), "unit 1: a trailer, itself a hub with spokes", PULLED, LABEL,
                 "middle", True)]
    for axle, on_trailer in (train.axles[1], train.axles[-2]):
        under = side_view(axle["wheel"]["center_m"][0] - 0.66, 0)[0]
        out.append(text((under, GROUND + 18), "its spokes", PULLED if on_trailer else PULLING, LABEL, "middle"))
    out.append(text((0.5 * edge + 20, 28), "side view, from the left", SOFT, TITLE, "middle"))
    return out


def wheels_from_above(train):
    for axle, on_trailer in train.axles:
        x, y, _ = axle["wheel"]["center_m"]
        spacing = axle["wheel"].get("dual_spacing_m", 0)
        for sign in (1, -1):
            for offset in ((spacing / 2, -spacing / 2) if spacing else (0,)):
                left, right = sign * y + offset + 0.13, sign * y + offset - 0.13
                corners = [(x + train.radius, left), (x - train.radius, left), (x - train.radius, right),
                           (x + train.radius, right)]
                yield polygon([train.top_view(*p, on_trailer) for p in corners], SOFT, SOFT, 1.2, 0.12)


def yaw_angle(train, hitch):
    """The middle lines of both units behind the hitch, and the angle from one to the other."""
    behind = train.hitch[0] - 6.9
    radius, color = SCALE * 6.4, COLORS["driven"]
    a, b = (hitch[0] + radius, hitch[1]), (hitch[0] + radius * math.cos(YAW), hitch[1] - radius * math.sin(YAW))
    return [*(dash_dotted(hitch, train.top_view(behind, 0, turned)) for turned in (False, True)),
            f'<path d="M {a[0]:.1f} {a[1]:.1f} A {radius:.1f} {radius:.1f} 0 0 0 {b[0]:.1f} {b[1]:.1f}" fill="none" '
            f'stroke="{color}" stroke-width="2"/>',
            f'<polygon points="{b[0]:.1f},{b[1]:.1f} {b[0] - 0.5:.1f},{b[1] + 10:.1f} {b[0] + 8:.1f},{b[1] + 7:.1f}" '
            f'fill="{color}"/>',
            text((a[0] - 6, hitch[1] + 20), "yaw angle", color, LABEL, "middle", True)]


def from_above(train):
    out = list(wheels_from_above(train))
    for front, rear, _, _, half, on_trailer in train.boxes:
        corners = [(front, half), (rear, half), (rear, -half), (front, -half)]
        color = PULLED if on_trailer else PULLING
        out.append(polygon([train.top_view(*p, on_trailer) for p in corners], color, color, 2.2, 0.13))
    hitch = train.top_view(train.hitch[0], 0, False)
    return out + yaw_angle(train, hitch) + [
        hitch_mark(hitch), text((hitch[0], hitch[1] + 40), "hitch", INK, LABEL, "middle", True),
        text((0.5 * train.right_edge + 20, GROUND + 52), "top view, turned to the left at the hitch", SOFT, TITLE,
             "middle")]


def trailers():
    """The whole picture."""
    with open(ROOT / "vehicles/truck_semitrailer.toml", "rb") as file:
        train = Train(tomllib.load(file))
    return page("Trailers", train.right_edge + 46, MIDDLE + 96, from_side(train) + from_above(train))
