#!/usr/bin/env python3
"""Draws docs/suspensions/pictures/*.svg from hardpoints; --check fails where a picture is not what it would draw.

Hardpoints are those of a shipped vehicle, or of the example on the suspension's own page where no vehicle has that
kind. A sketch is a list of parts in space; each of its views projects them, and labels look for a free place by
themselves.

Axes are ISO 8855. Front view: y to the right, z up (seen from ahead, the left wheel is on the right). Side view: from
the left, x to the left. Top view: y to the right as in the front view above it, hence x down.
"""

import itertools
import math
import pathlib
import re
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs/suspensions"

VIEWS = {"front": ((0, 1, 0), (0, 0, 1)), "side": ((-1, 0, 0), (0, 0, 1)), "top": ((0, 1, 0), (-1, 0, 0))}
TITLES = {"front": "front view", "side": "side view, from the left", "top": "top view"}
AXES = {"front": ("y", "z", 1, 1), "side": ("x", "z", -1, 1), "top": ("y", "x", 1, -1)}

FONT, LABEL, TITLE = "Helvetica, Arial, 'DejaVu Sans', sans-serif", 13, 14
INK, SOFT, CHASSIS, TIRE = "#24292f", "#6e7781", "#c4cad1", "#eceff2"
COLORS = {"carrier": "#1f6feb", "arm": "#1a7f37", "link": "#24292f", "driven": "#bc4c00", "rod": "#8250df",
          "spring": "#8c6d1f"}
LINK_WIDTH, THIN, JOINT = 3.2, 1.4, 4.6


# ------------------------------------------------------------------------------------------------- small vectors

def add(a, b, t=1.0):
    return tuple(x + t * y for x, y in zip(a, b))


def sub(a, b):
    return add(a, b, -1.0)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def between(a, b, t=0.5):
    return add(a, sub(b, a), t)


def mirrored(p):
    return (p[0], -p[1], p[2])


def hull(points):
    """Convex hull of points in the plane, counterclockwise."""
    points = sorted(set(points))
    if len(points) < 3:
        return points

    def half(sequence):
        chain = []
        for p in sequence:
            while len(chain) > 1 and cross2(sub(chain[-1], chain[-2]), sub(p, chain[-1])) <= 1e-9:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return half(points) + half(reversed(points))


def cross2(a, b):
    return a[0] * b[1] - a[1] * b[0]


def segments_cross(a, b, c, d):
    def side(p, q, r):
        return cross2(sub(q, p), sub(r, p))

    return side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0


def segment_in_box(a, b, box):
    x0, y0, x1, y1 = box
    if any(x0 <= p[0] <= x1 and y0 <= p[1] <= y1 for p in (a, b)):
        return True
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return any(segments_cross(a, b, corners[i], corners[i - 1]) for i in range(4))


# ------------------------------------------------------------------------------------------------------- a sketch

class Sketch:
    """Parts in space. Every part is drawn in every view; `only` restricts its label to some views."""

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

    def bar(self, a, b, label="", color="link", only=None, width=LINK_WIDTH, dash=""):
        self.parts.append(("bar", tuple(a), tuple(b), label, COLORS[color], only, width, dash))

    def curve(self, points, label="", only=None, color="spring"):
        self.parts.append(("curve", [tuple(p) for p in points], label, COLORS[color], only))

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

    def wishbone(self, front, rear, ball, label, only=None, color="arm"):
        self.body([front, rear, ball], label, color, only)
        self.axis(front, rear, beyond=0.04)
        self.hinge(front, True)
        self.hinge(rear, True)
        self.ball(ball)


# ------------------------------------------------------------------------------------------------------ one view

class View:
    """Projects a sketch, draws it and places its labels."""

    def __init__(self, sketch, kind, margin=(64, 40)):
        self.sketch, self.kind = sketch, kind
        self.right, self.up = VIEWS[kind]
        self.shapes, self.joints, self.lines, self.outlines, self.discs, self.wants = [], [], [], [], [], []
        self.draw_parts()
        xs = [p[0] for p in self.extent()]
        ys = [p[1] for p in self.extent()]
        self.box = (min(xs) - margin[0], min(ys) - margin[1], max(xs) + margin[0], max(ys) + margin[1])
        self.labels = place_labels(self)

    def at(self, p):
        s = self.sketch.scale
        return (round(s * dot(self.right, p), 3), round(-s * dot(self.up, p), 3))

    def extent(self):
        yield from (p for line in self.lines + self.outlines for p in line)
        yield from self.discs

    def want(self, label, anchors, only, color=INK):
        if label and (only is None or self.kind in only):
            self.wants.append((label, anchors, color))

    def draw_parts(self):
        drawers = {"wheel": self.draw_wheel, "body": self.draw_body, "bar": self.draw_bar, "curve": self.draw_curve,
                   "spring": self.draw_spring, "axis": self.draw_axis, "joint": self.draw_joint}
        order = ["wheel", "axis", "body", "curve", "spring", "bar", "joint"]
        for kind in order:
            for part in self.sketch.parts:
                if part[0] == kind:
                    drawers[kind](*part[1:])

    def polygon(self, points, fill, stroke, width, opacity=1.0):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.shapes.append(f'<polygon points="{text}" fill="{fill}" fill-opacity="{opacity}" stroke="{stroke}" '
                           f'stroke-width="{width}" stroke-linejoin="round"/>')

    def path(self, points, stroke, width, dash="", fill="none"):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.shapes.append(f'<polyline points="{text}" fill="{fill}" stroke="{stroke}" stroke-width="{width}" '
                           f'stroke-linecap="round" stroke-linejoin="round"{dashes}/>')

    def draw_wheel(self, center, axis, radius, width, label):
        """The outline of a cylinder: the hull of its two discs."""
        across = unit(sub((1, 0, 0), tuple(axis[0] * a for a in axis)))
        upright = unit((axis[1] * across[2] - axis[2] * across[1], axis[2] * across[0] - axis[0] * across[2],
                        axis[0] * across[1] - axis[1] * across[0]))
        rims = []
        for side, r in ((width / 2, radius), (-width / 2, radius), (width / 2, 0.62 * radius)):
            ring = [add(add(add(center, axis, side), across, r * math.cos(a)), upright, r * math.sin(a))
                    for a in (math.tau * i / 72 for i in range(72))]
            rims.append([self.at(p) for p in ring])
        outline = hull(rims[0] + rims[1])
        self.polygon(outline, TIRE, SOFT, THIN)
        if self.kind == "side":
            self.polygon(hull(rims[2]), "#ffffff", SOFT, 1.0, 0.6)
        self.outlines += [(outline[i - 1], outline[i]) for i in range(len(outline))]
        self.discs.append(self.at(center))
        if self.kind == self.sketch.views[0]:
            self.want(label, [self.at(add(center, upright, t * radius)) for t in (0.75, -0.75, 0.5)], None, SOFT)

    def draw_body(self, points, label, color, only):
        corners = hull([self.at(p) for p in points])
        self.polygon(corners, color, color, 2.2, 0.13)
        self.lines += [(corners[i - 1], corners[i]) for i in range(len(corners))]
        middle = tuple(sum(p[i] for p in corners) / len(corners) for i in (0, 1))
        self.want(label, [middle] + [between(corners[i - 1], corners[i]) for i in range(len(corners))], only, color)

    def draw_bar(self, a, b, label, color, only, width, dash):
        a, b = self.at(a), self.at(b)
        self.path([a, b], color, width, dash)
        self.lines.append((a, b))
        self.want(label, [between(a, b, t) for t in (0.5, 0.35, 0.65, 0.2, 0.8)], only, color)

    def draw_curve(self, points, label, color, only):
        flat = [self.at(p) for p in points]
        self.path(flat, color, 2.2, "7 4")
        self.lines += list(itertools.pairwise(flat))
        self.want(label, [flat[len(flat) // 4], flat[3 * len(flat) // 4], flat[-2]], only, color)

    def draw_spring(self, a, b, label, views, color):
        if self.kind not in views:
            return
        a, b = self.at(a), self.at(b)
        self.shapes.append(chassis_mark(a))
        length = math.dist(a, b)
        along = tuple(x / length for x in sub(b, a))
        aside = (-along[1], along[0])
        if color == "spring":
            turns = max(4, round(length / 14))
            points = [a] + [add(add(a, along, length * (i + 0.5) / turns), aside, 7 if i % 2 else -7)
                            for i in range(turns)] + [b]
            self.path(points, COLORS["spring"], 1.6)
        else:
            for shift in (-2.5, 2.5):
                self.path([add(a, aside, shift), add(b, aside, shift)], COLORS["spring"], 1.4)
        for x, y in (a, b):
            self.shapes.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.2" fill="{COLORS["spring"]}"/>')
        self.lines.append((a, b))
        self.discs += [a, b]
        self.want(label, [between(a, b, t) for t in (0.5, 0.7, 0.3)], None, COLORS["spring"])

    def draw_axis(self, a, b, label, only):
        a, b = self.at(a), self.at(b)
        if math.dist(a, b) > 14:
            self.path([a, b], SOFT, 1.1, "9 3 2 3")
            self.lines.append((a, b))
            self.want(label, [b, a, between(a, b, 0.85), between(a, b, 0.15)], only, SOFT)

    def draw_joint(self, p, is_ball, on_chassis, label, only):
        x, y = self.at(p)
        key = (round(x), round(y))
        if key in self.joints:
            return
        self.joints.append(key)
        if on_chassis:
            self.shapes.append(chassis_mark((x, y)))
        fill = INK if is_ball else "#ffffff"
        self.shapes.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{JOINT}" fill="{fill}" stroke="{INK}" '
                           f'stroke-width="1.8"/>')
        self.discs.append((x, y))
        self.want(label, [(x, y)], only)

    def draw_triad(self):
        """The two axes of this view, in the lower left corner or, where that axis points left, in the lower right."""
        first, second, to_right, to_up = AXES[self.kind]
        x = self.box[0] + 16 if to_right > 0 else self.box[2] - 16
        y = self.box[3] - 12 if to_up > 0 else self.box[3] - 38
        out = []
        for name, dx, dy in ((first, 26 * to_right, 0), (second, 0, -26 * to_up)):
            tip = (x + dx, y + dy)
            back = (tip[0] - 6 * (dx > 0) + 6 * (dx < 0), tip[1] - 6 * (dy > 0) + 6 * (dy < 0))
            wing = (3.5 if dy else 0, 3.5 if dx else 0)
            out.append(f'<line x1="{x:.1f}" y1="{y:.1f}" x2="{back[0]:.1f}" y2="{back[1]:.1f}" stroke="{SOFT}" '
                       f'stroke-width="1.4"/>')
            out.append(f'<polygon points="{tip[0]:.1f},{tip[1]:.1f} {back[0] + wing[0]:.1f},{back[1] + wing[1]:.1f} '
                       f'{back[0] - wing[0]:.1f},{back[1] - wing[1]:.1f}" fill="{SOFT}"/>')
            place = (tip[0] + (8 if dx > 0 else -8 if dx < 0 else 9 * to_right), tip[1] + (4 if dx else 5))
            out.append(text(place, name, SOFT, 12, "middle"))
        return out

    def svg(self, x, y):
        """Everything, with the upper left corner of the view at x, y."""
        out = [f'<g transform="translate({x - self.box[0]:.1f} {y - self.box[1]:.1f})">'] + self.shapes
        for label in self.labels:
            out += label.leader()
        for label in self.labels:
            out += label.svg()
        out.append(text((0.5 * (self.box[0] + self.box[2]), self.box[1] + 2), TITLES.get(self.kind, self.kind), SOFT,
                        TITLE, "middle"))
        return out + self.draw_triad() + ["</g>"]


def chassis_mark(at):
    return f'<rect x="{at[0] - 8.5:.1f}" y="{at[1] - 8.5:.1f}" width="17" height="17" rx="4" fill="{CHASSIS}"/>'


def text(at, words, color, size, anchor, halo=False):
    head = f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" font-family="{FONT}" font-size="{size}" text-anchor="{anchor}"'
    line = f'{head} fill="{color}">{words}</text>'
    if halo:
        around = 'fill="#ffffff" stroke="#ffffff" stroke-width="3.5" stroke-linejoin="round"'
        line = f"{head} {around}>{words}</text>\n" + line
    return line


# -------------------------------------------------------------------------------------------------------- labels

class Label:
    def __init__(self, words, color):
        self.words, self.color = words, color
        self.size = (0.56 * LABEL * len(words) + 4, LABEL + 3)
        self.anchor = self.middle = (0, 0)

    def box(self, middle=None, pad=0.0):
        x, y = middle or self.middle
        w, h = self.size[0] / 2 + pad, self.size[1] / 2 + pad
        return (x - w, y - h, x + w, y + h)

    def edge(self):
        """Where a leader leaves the box toward the anchor."""
        dx, dy = sub(self.anchor, self.middle)
        if holds(self.box(pad=0.1), self.anchor):
            return self.anchor
        w, h = self.size[0] / 2, self.size[1] / 2
        t = min(w / abs(dx) if dx else math.inf, h / abs(dy) if dy else math.inf)
        return add(self.middle, (dx, dy), t)

    def leader(self):
        start = self.edge()
        if math.dist(start, self.anchor) < 9:
            return []
        return [f'<line x1="{start[0]:.1f}" y1="{start[1]:.1f}" x2="{self.anchor[0]:.1f}" y2="{self.anchor[1]:.1f}" '
                f'stroke="{self.color}" stroke-width="0.9" stroke-opacity="0.75"/>']

    def svg(self):
        return [text((self.middle[0], self.middle[1] + 0.35 * LABEL), self.words, self.color, LABEL, "middle", True)]


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def holds(box, p):
    return box[0] < p[0] < box[2] and box[1] < p[1] < box[3]


def crossed(lines, box):
    """How many of the lines touch the box."""
    x0, y0, x1, y1 = box
    return sum(1 for a, b in lines
               if not (a[0] < x0 and b[0] < x0 or a[0] > x1 and b[0] > x1 or a[1] < y0 and b[1] < y0
                       or a[1] > y1 and b[1] > y1) and segment_in_box(a, b, box))


def cost(view, label, others, bound):
    """Lines and joints under a label and other labels touched are bad, far from its part a little."""
    box, wide, edge = label.box(), label.box(pad=3), label.edge()
    inside = holds(label.box(pad=0.1), label.anchor)
    reach = 0 if inside else math.dist(edge, label.anchor)
    total = 0.06 * reach + (0.6 if reach > 11 else 0)
    x0, y0, x1, y1 = view.box
    if total > bound or box[0] < x0 or box[2] > x1 or box[1] < y0 + 12 or box[3] > y1 - 2:
        return math.inf
    corner = (x0, y1 - 56, x0 + 66, y1) if AXES[view.kind][2] > 0 else (x1 - 66, y1 - 56, x1, y1)
    total += 500 * overlap(box, corner)
    total += sum(1000 for other in others if overlap(wide, other.box(pad=2)))
    around = label.box(pad=9)
    total += sum(30 for p in view.discs if holds(around, p))
    if total > bound:
        return math.inf
    total += 9 * crossed(view.lines, wide) + 0.75 * crossed(view.outlines, box)
    if total > bound:
        return math.inf
    total += sum(20 for other in others if segment_in_box(other.edge(), other.anchor, wide))
    if not inside:
        total += sum(2.5 for a, b in view.lines if segments_cross(edge, label.anchor, a, b))
        total += sum(40 for other in others if segment_in_box(edge, label.anchor, other.box(pad=2)))
        total += sum(20 for other in others if segments_cross(edge, label.anchor, other.edge(), other.anchor))
    return total


def candidates(label, anchor):
    """Places around an anchor, near ones first: so far from it to the nearest point of the box."""
    for distance in (0, 6, 12, 20, 30, 44, 60, 80, 104):
        for k in range(16 if distance else 1):
            c, s = math.cos(math.tau * k / 16), math.sin(math.tau * k / 16)
            half = (label.size[0] / 2, label.size[1] / 2) if distance else (0, 0)
            yield add(anchor, (c * distance + max(-1, min(1, 1.5 * c)) * half[0],
                               s * distance + max(-1, min(1, 1.5 * s)) * half[1]))


def place_labels(view):
    labels = [Label(words, color) for words, _, color in view.wants]
    for sweep in range(4):
        for i, (label, want) in enumerate(zip(labels, view.wants)):
            others = labels[:i] + (labels[i + 1:] if sweep else [])
            best = (math.inf, want[1][0], want[1][0])
            for order, anchor in enumerate(want[1]):
                label.anchor = anchor
                for label.middle in candidates(label, anchor):
                    price = cost(view, label, others, best[0] - 0.3 * order) + 0.3 * order
                    if price < best[0] - 1e-9:
                        best = (price, label.anchor, label.middle)
            label.anchor, label.middle = best[1], best[2]
    return labels


# ---------------------------------------------------------------------------------------------------- whole picture

def legend(x, y, driven):
    out = []

    def entry(shape, words, room):
        nonlocal x
        out.append(shape)
        out.append(text((x + 14, y + 4), words, SOFT, 12, "start"))
        x += room

    entry(f'<circle cx="{x}" cy="{y}" r="{JOINT}" fill="{INK}"/>', "ball", 58)
    entry(f'<circle cx="{x}" cy="{y}" r="{JOINT}" fill="#ffffff" stroke="{INK}" stroke-width="1.8"/>', "hinge", 66)
    entry(f'<rect x="{x - 8}" y="{y - 8}" width="16" height="16" rx="4" fill="{CHASSIS}"/>', "on the chassis", 130)
    if driven:
        entry(f'<line x1="{x - 8}" y1="{y}" x2="{x + 8}" y2="{y}" stroke="{COLORS["driven"]}" '
              f'stroke-width="{LINK_WIDTH}"/>', "moved by the rack", 0)
    return out


def picture(sketch):
    """Views side by side; a third one stands below the first."""
    views = [View(sketch, kind) for kind in sketch.views]
    gap, top, bottom = 14, 30, 34  # [px]
    widths, heights = [v.box[2] - v.box[0] for v in views], [v.box[3] - v.box[1] for v in views]
    width, row = sum(widths[:2]) + 3 * gap, max(heights[:2])
    height = row + top + bottom + (heights[2] + gap if len(views) > 2 else 0)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
           f'viewBox="0 0 {width:.0f} {height:.0f}">',
           f"<title>{sketch.name}</title>",
           f'<rect x="0.5" y="0.5" width="{width - 1:.0f}" height="{height - 1:.0f}" rx="12" fill="#ffffff" '
           f'stroke="#d0d7de"/>']
    level = all(view.kind in ("front", "side") for view in views[:2])  # on the same ground
    places = [(gap, top + (row - heights[0] if level else (row - heights[0]) / 2)),
              (2 * gap + widths[0], top + (row - heights[1] if level else (row - heights[1]) / 2)),
              (gap + views[-1].box[0] - views[0].box[0], top + row + gap)]
    for view, place in zip(views, places):
        out += view.svg(*place)
    driven = any(part[0] == "bar" and part[4] == COLORS["driven"] for part in sketch.parts)
    out += legend(26, height - 18, driven)
    return "\n".join(out + ["</svg>", ""])


# ------------------------------------------------------------------------------------------- where points come from

def vehicle_axle(vehicle, name):
    with open(ROOT / "vehicles" / vehicle, "rb") as file:
        car = tomllib.load(file)
    axle = next(axle for axle in car["axle"] if axle["name"] == name)
    return axle, car["tire"][axle["tire"]]["radius_m"]


def page_axle(keyword):
    """The first example on the page that is a whole axle."""
    blocks = re.findall(r"^```toml\n(.*?)^```", (PAGES / f"{keyword}.md").read_text(), re.M | re.S)
    for block in blocks:
        axles = tomllib.loads(block).get("axle", [])
        if axles and "wheel" in axles[0]:
            return axles[0], axles[0]["wheel"]["center_m"][2] + 0.012
    raise SystemExit(f"docs/suspensions/{keyword}.md: no example with [axle.wheel]")


def points_of(axle):
    return {key: tuple(value) for key, value in axle["hardpoints"].items() if isinstance(value, list)}


def add_spring(sketch, axle, both=False, views=("front", "side")):
    spring = axle["spring"]
    sketch.spring(spring["body_m"], spring["at_m"], views=views)
    if both and "front" in views:
        sketch.spring(mirrored(spring["body_m"]), mirrored(spring["at_m"]), "", ["front"])


# ------------------------------------------------------------------------------------------------------ suspensions

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


def rigid_axle(s, axle, radius, attachments, label="axle"):
    """Both wheels and the axle between them, with a bracket to every joint on it."""
    center = s.wheel(axle["wheel"], radius)
    s.wheel({**axle["wheel"], "center_m": mirrored(center), "camber_deg": axle["wheel"]["camber_deg"]}, radius, "")
    s.bar(mirrored(center), center, label, "carrier", width=6)
    for p in attachments:
        s.bar(p, (center[0], p[1], center[2]), "", "carrier", width=2)
    return center


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


# --------------------------------------------------------------------------------------------------------- trailers

def trailers():
    """Tractor and semi-trailer from the side, and from above with a yaw angle at the hitch."""
    with open(ROOT / "vehicles/truck_semitrailer.toml", "rb") as file:
        truck = tomllib.load(file)
    trailer, scale, yaw = truck["trailer"][0], 46, math.radians(15)
    hitch = trailer["hitch_m"]
    wheels = [(axle, False) for axle in truck["axle"]] + [(axle, True) for axle in trailer["axle"]]
    radius = truck["tire"]["truck"]["radius_m"]
    left, ground = 70, 245
    shift = left + scale * 1.4

    def side(x, z):
        return (shift - scale * x, ground - scale * z)

    def box(x0, x1, z0, z1, color):
        a, b = side(x0, z1), side(x1, z0)
        return (f'<rect x="{a[0]:.1f}" y="{a[1]:.1f}" width="{b[0] - a[0]:.1f}" height="{b[1] - a[1]:.1f}" rx="5" '
                f'fill="{color}" fill-opacity="0.13" stroke="{color}" stroke-width="2.2"/>')

    blue, violet = COLORS["carrier"], COLORS["rod"]
    first, last = wheels[0][0]["wheel"]["center_m"][0], wheels[-1][0]["wheel"]["center_m"][0]
    out = []
    end = side(last - 2.2, 0)[0]
    out.append(f'<line x1="24" y1="{ground}" x2="{end + 20:.1f}" y2="{ground}" stroke="{SOFT}" stroke-width="1.4"/>')
    for axle, _ in wheels:
        c = side(axle["wheel"]["center_m"][0], radius)
        out.append(f'<circle cx="{c[0]:.1f}" cy="{c[1]:.1f}" r="{scale * radius:.1f}" fill="{TIRE}" stroke="{SOFT}" '
                   f'stroke-width="{THIN}"/>')
    out += [box(first + 1.2, first - 1.3, 0.6, 3.0, blue), box(first - 1.3, hitch[0] - 1.6, 0.72, 1.08, blue),
            box(hitch[0] + 1.0, last - 1.6, 1.3, 4.0, violet)]
    h = side(hitch[0], hitch[2])
    out += [f'<circle cx="{h[0]:.1f}" cy="{h[1]:.1f}" r="5.5" fill="#ffffff" stroke="{INK}" stroke-width="2"/>',
            f'<line x1="{h[0]:.1f}" y1="{h[1] - 108:.1f}" x2="{h[0]:.1f}" y2="{h[1] + 34:.1f}" stroke="{SOFT}" '
            f'stroke-width="1.1" stroke-dasharray="9 3 2 3"/>',
            text((h[0] + 8, h[1] - 92), "yaw axis, on the unit that pulls", INK, LABEL, "start", True),
            text((h[0] - 12, h[1] - 12), "hitch, pitch axis", INK, LABEL, "end", True),
            text(add(side(first + 1.1, 3.15), (0, 0)), "unit 0: the hub", blue, LABEL, "start"),
            text(side(0.5 * (hitch[0] + last), 2.5), "unit 1: a trailer, itself a hub with spokes", violet, LABEL,
                 "middle", True)]
    for label, axle in (("its spokes", wheels[1][0]), ("its spokes", wheels[-2][0])):
        x = side(axle["wheel"]["center_m"][0] - 0.66, 0)[0]
        color = blue if axle is wheels[1][0] else violet
        out.append(text((x, ground + 18), label, color, LABEL, "middle"))
    out.append(text((0.5 * end + 20, 28), "side view, from the left", SOFT, TITLE, "middle"))
    middle = ground + 262

    def top(x, y, turned):
        dx, dy = x - hitch[0], y
        if turned:
            dx, dy = dx * math.cos(yaw) - dy * math.sin(yaw), dx * math.sin(yaw) + dy * math.cos(yaw)
        return (shift - scale * (hitch[0] + dx), middle + scale * dy)

    def shape(corners, turned, color, fill=0.13, width=2.2):
        points = " ".join("{:.1f},{:.1f}".format(*top(x, y, turned)) for x, y in corners)
        return (f'<polygon points="{points}" fill="{color}" fill-opacity="{fill}" stroke="{color}" '
                f'stroke-width="{width}" stroke-linejoin="round"/>')

    def rectangle(x0, x1, y):
        return [(x0, y), (x1, y), (x1, -y), (x0, -y)]

    for axle, turned in wheels:
        x, y, _ = axle["wheel"]["center_m"]
        for sign in (1, -1):
            spacing = axle["wheel"].get("dual_spacing_m", 0)
            for offset in ((spacing / 2, -spacing / 2) if spacing else (0,)):
                yy = sign * y + offset
                corners = [(x + radius, yy + 0.13), (x - radius, yy + 0.13), (x - radius, yy - 0.13),
                           (x + radius, yy - 0.13)]
                out.append(shape(corners, turned, SOFT, 0.12, 1.2))
    out += [shape(rectangle(first + 1.2, first - 1.3, 1.15), False, blue),
            shape(rectangle(first - 1.3, hitch[0] - 1.6, 0.43), False, blue),
            shape(rectangle(hitch[0] + 1.0, last - 1.6, 1.27), True, violet)]
    h = top(hitch[0], 0, False)
    reach = 6.9
    straight, turned_line = top(hitch[0] - reach, 0, False), top(hitch[0] - reach, 0, True)
    for end_point in (straight, turned_line):
        out.append(f'<line x1="{h[0]:.1f}" y1="{h[1]:.1f}" x2="{end_point[0]:.1f}" y2="{end_point[1]:.1f}" '
                   f'stroke="{SOFT}" stroke-width="1.1" stroke-dasharray="9 3 2 3"/>')
    r = scale * 6.4
    a, b = (h[0] + r, h[1]), (h[0] + r * math.cos(yaw), h[1] - r * math.sin(yaw))
    out += [f'<path d="M {a[0]:.1f} {a[1]:.1f} A {r:.1f} {r:.1f} 0 0 0 {b[0]:.1f} {b[1]:.1f}" fill="none" '
            f'stroke="{COLORS["driven"]}" stroke-width="2"/>',
            f'<polygon points="{b[0]:.1f},{b[1]:.1f} {b[0] - 0.5:.1f},{b[1] + 10:.1f} {b[0] + 8:.1f},{b[1] + 7:.1f}" '
            f'fill="{COLORS["driven"]}"/>',
            text((a[0] - 6, h[1] + 20), "yaw angle", COLORS["driven"], LABEL, "middle", True),
            f'<circle cx="{h[0]:.1f}" cy="{h[1]:.1f}" r="5.5" fill="#ffffff" stroke="{INK}" stroke-width="2"/>',
            text((h[0], h[1] + 40), "hitch", INK, LABEL, "middle", True),
            text((0.5 * end + 20, ground + 52), "top view, turned to the left at the hitch", SOFT, TITLE, "middle")]
    width, height = end + 46, middle + 96
    head = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
            f'viewBox="0 0 {width:.0f} {height:.0f}">', "<title>Trailers</title>",
            f'<rect x="0.5" y="0.5" width="{width - 1:.0f}" height="{height - 1:.0f}" rx="12" fill="#ffffff" '
            f'stroke="#d0d7de"/>']
    return "\n".join(head + out + ["</svg>", ""])


SKETCHES = [macpherson, double_wishbone, five_link, semi_trailing_arm, trailing_arm, swing_axle, h_arm, twist_beam,
            four_link_axle, panhard_axle, watt_axle, leaf_axle, linkage]


def main():
    stale = []
    for make in [*SKETCHES, trailers]:
        svg = trailers() if make is trailers else picture(make())
        file = PAGES / "pictures" / f"{make.__name__}.svg"
        if "--check" in sys.argv[1:]:
            if not file.is_file() or file.read_text() != svg:
                stale.append(file.relative_to(ROOT))
        else:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(svg)
    for file in stale:
        print(f"{file}: stale; run tools/draw_suspensions.py", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
