"""Vectors of any length as tuples, and what the plane of a picture needs besides: hulls, crossings, boxes.

A box is (left, upper, right, lower) in a picture, whose y points down.
"""

import math


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
