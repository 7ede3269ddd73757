"""One view of a sketch: projects its parts on the paper and draws them.

Axes are ISO 8855. Front view: y to the right, z up (seen from ahead, the left wheel is on the right). Side view: from
the left, x to the left. Top view: y to the right as in the front view above it, hence x down.
"""

import itertools
import math

from suspension_sketches.elements import (COLORS, INK, JOINT, SOFT, THIN, TIRE, TITLE, chassis_mark, circle, polygon,
                                          polyline, text)
from suspension_sketches.labels import place_labels
from suspension_sketches.vectors import add, between, dot, hull, sub, unit

# What points right and what up on the paper; the coordinates drawn for it, and which way they grow.
VIEWS = {"front": ((0, 1, 0), (0, 0, 1)), "side": ((-1, 0, 0), (0, 0, 1)), "top": ((0, 1, 0), (-1, 0, 0))}
TITLES = {"front": "front view", "side": "side view, from the left", "top": "top view"}
AXES = {"front": ("y", "z", 1, 1), "side": ("x", "z", -1, 1), "top": ("y", "x", 1, -1)}
MARGIN = (64, 40)  # [px]


class View:
    """Projects a sketch, draws it and places its labels."""

    def __init__(self, sketch, kind):
        self.sketch, self.kind = sketch, kind
        self.right, self.up = VIEWS[kind]
        self.shapes, self.joints, self.lines, self.outlines, self.discs, self.wants = [], [], [], [], [], []
        self.draw_parts()
        xs = [p[0] for p in self.extent()]
        ys = [p[1] for p in self.extent()]
        self.box = (min(xs) - MARGIN[0], min(ys) - MARGIN[1], max(xs) + MARGIN[0], max(ys) + MARGIN[1])
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
        self.shapes.append(polygon(outline, TIRE, SOFT, THIN))
        if self.kind == "side":
            self.shapes.append(polygon(hull(rims[2]), "#ffffff", SOFT, 1.0, 0.6))
        self.outlines += [(outline[i - 1], outline[i]) for i in range(len(outline))]
        self.discs.append(self.at(center))
        if self.kind == self.sketch.views[0]:
            self.want(label, [self.at(add(center, upright, t * radius)) for t in (0.75, -0.75, 0.5)], None, SOFT)

    def draw_body(self, points, label, color, only):
        corners = hull([self.at(p) for p in points])
        self.shapes.append(polygon(corners, color, color, 2.2, 0.13))
        self.lines += [(corners[i - 1], corners[i]) for i in range(len(corners))]
        middle = tuple(sum(p[i] for p in corners) / len(corners) for i in (0, 1))
        self.want(label, [middle] + [between(corners[i - 1], corners[i]) for i in range(len(corners))], only, color)

    def draw_bar(self, a, b, label, color, only, width):
        a, b = self.at(a), self.at(b)
        self.shapes.append(polyline([a, b], color, width))
        self.lines.append((a, b))
        self.want(label, [between(a, b, t) for t in (0.5, 0.35, 0.65, 0.2, 0.8)], only, color)

    def draw_curve(self, points, label, color, only):
        flat = [self.at(p) for p in points]
        self.shapes.append(polyline(flat, color, 2.2, "7 4"))
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
            self.shapes.append(polyline(points, COLORS["spring"], 1.6))
        else:
            for shift in (-2.5, 2.5):
                self.shapes.append(polyline([add(a, aside, shift), add(b, aside, shift)], COLORS["spring"], 1.4))
        for x, y in (a, b):
            self.shapes.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.2" fill="{COLORS["spring"]}"/>')
        self.lines.append((a, b))
        self.discs += [a, b]
        self.want(label, [between(a, b, t) for t in (0.5, 0.7, 0.3)], None, COLORS["spring"])

    def draw_axis(self, a, b, label, only):
        a, b = self.at(a), self.at(b)
        if math.dist(a, b) > 14:
            self.shapes.append(polyline([a, b], SOFT, 1.1, "9 3 2 3"))
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
        self.shapes.append(circle((x, y), JOINT, fill, INK, 1.8))
        self.discs.append((x, y))
        self.want(label, [(x, y)], only)

    def triad_box(self):
        x0, _, x1, y1 = self.box
        return (x0, y1 - 56, x0 + 66, y1) if AXES[self.kind][2] > 0 else (x1 - 66, y1 - 56, x1, y1)

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
        out.append(text((0.5 * (self.box[0] + self.box[2]), self.box[1] + 2), TITLES[self.kind], SOFT, TITLE,
                        "middle"))
        return out + self.draw_triad() + ["</g>"]
