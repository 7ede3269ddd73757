"""Labels that look for a free place by themselves: each tries places around its anchors and takes the cheapest.

Later sweeps move a label again once it knows where the others went.
"""

import math

from suspension_sketches.elements import LABEL, text
from suspension_sketches.vectors import add, crossed, holds, overlap, segment_in_box, segments_cross, sub


class Label:
    """Words, where they stand, and the anchor they belong to."""

    def __init__(self, words, color):
        self.words, self.color = words, color
        self.size = (0.56 * LABEL * len(words) + 4, LABEL + 3)
        self.anchor = self.middle = (0, 0)

    def box(self, pad=0.0):
        x, y = self.middle
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


def cost(view, label, others, bound):
    """Lines and joints under a label and other labels touched are bad, far from its part a little."""
    box, wide, edge = label.box(), label.box(pad=3), label.edge()
    inside = holds(label.box(pad=0.1), label.anchor)
    reach = 0 if inside else math.dist(edge, label.anchor)
    total = 0.06 * reach + (0.6 if reach > 11 else 0)
    x0, y0, x1, y1 = view.box
    if total > bound or box[0] < x0 or box[2] > x1 or box[1] < y0 + 12 or box[3] > y1 - 2:
        return math.inf
    total += 500 * overlap(box, view.triad_box())
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
