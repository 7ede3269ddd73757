"""A sketch: the parts of a suspension in space [m], before any view of it."""

import math

from suspension_sketches.elements import COLORS, LINK_WIDTH
from suspension_sketches.vectors import add, sub, unit


class Sketch:
    """Parts in space. Every part is drawn in every view; `only` restricts its label to some views.

    `scale` is in pixels per meter, `views` are the kinds to draw, the main one first.
    """

    def __init__(self, name, views, scale):
        self.name, self.views, self.scale, self.parts = name, views, scale, []

    def wheel(self, wheel, radius, label="wheel"):
        if "spin_axis" in wheel:
            axis = unit(wheel["spin_axis"])
        else:
            camber, toe = math.radians(wheel["camber_deg"]), math.radians(wheel["toe_in_deg"])
            axis = (math.cos(camber) * math.sin(toe), math.cos(camber) * math.cos(toe), -math.sin(camber))
        width = min(max(0.6 * radius, 0.15), 0.26)
        self.parts.append(("wheel", tuple(wheel["center_m"]), axis, radius, width, label))
        return tuple(wheel["center_m"])

    def body(self, points, label="", color="carrier", only=None):
        """A rigid part as the hull of what it holds."""
        self.parts.append(("body", [tuple(p) for p in points], label, COLORS[color], only))

    def bar(self, a, b, label="", color="link", only=None, width=LINK_WIDTH):
        self.parts.append(("bar", tuple(a), tuple(b), label, COLORS[color], only, width))

    def curve(self, points, label="", only=None):
        self.parts.append(("curve", [tuple(p) for p in points], label, COLORS["spring"], only))

    def spring(self, top, seat, label="spring", views=("front", "side"), color="spring"):
        """From the chassis to the suspension; seen from above it would only be in the way."""
        self.parts.append(("spring", tuple(top), tuple(seat), label, views, color))

    def axis(self, a, b, label="", only=None, beyond=0.05):
        """A line of rotation or of a middle plane: thin, dash-dotted, a little longer than from a to b."""
        along = unit(sub(b, a))
        self.parts.append(("axis", add(a, along, -beyond), add(b, along, beyond), label, only))

    def ball(self, p, chassis=False, label="", only=None):
        self.parts.append(("joint", tuple(p), True, chassis, label, only))

    def hinge(self, p, chassis=False, label="", only=None):
        self.parts.append(("joint", tuple(p), False, chassis, label, only))

    # What many suspensions have.
    def link(self, inner, outer, label="", color="link", only=None, inner_on_chassis=True):
        self.bar(inner, outer, label, color, only)
        self.ball(inner, inner_on_chassis)
        self.ball(outer)

    def wishbone(self, front, rear, ball, label):
        self.body([front, rear, ball], label, "arm")
        self.axis(front, rear, beyond=0.04)
        self.hinge(front, True)
        self.hinge(rear, True)
        self.ball(ball)
