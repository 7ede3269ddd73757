"""Closed paths on the ground, and where cars are along them.

A path is a table of short arcs of equal length: point, direction and curvature in the middle of each. To find a car again one tests
the arc that it was at last and goes to its neighbours, so a step costs the same whatever the length of the path.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def wrapped(angle: np.ndarray) -> np.ndarray:
    """The same angle from -pi to pi [rad]."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _second_derivatives(values: np.ndarray, gaps: np.ndarray) -> np.ndarray:
    """Of the periodic cubic spline through ``values`` (n, 2) at parameters that are ``gaps`` (n,) apart, at its knots."""
    n = len(values)
    before = np.roll(gaps, 1)
    slopes = (np.roll(values, -1, axis=0) - values) / gaps[:, None]
    matrix = np.zeros((n, n))
    rows = np.arange(n)
    matrix[rows, rows] = 2 * (before + gaps)
    matrix[rows, rows - 1] += before
    matrix[rows, (rows + 1) % n] += gaps
    return np.linalg.solve(matrix, 6 * (slopes - np.roll(slopes, 1, axis=0)))


class Path:
    """A closed curve through ``points`` (n, 2) [m], n >= 3, a periodic cubic spline.

    ``length`` [m], a whole number of pieces of ``spacing`` [m]; ``x``, ``y`` [m], ``heading`` [rad], not wrapped, and ``curvature``
    [1/m], positive to the left, of each piece.
    """

    def __init__(self, points: Sequence[Sequence[float]] | np.ndarray, spacing: float = 1.0):
        knots = np.asarray(points, dtype=np.float64)
        if knots.ndim != 2 or knots.shape[1] != 2 or len(knots) < 3 or not np.isfinite(knots).all():
            raise ValueError(f"points of shape {knots.shape}: expected (n, 2) finite numbers [m], at least three points")
        if not spacing > 0:
            raise ValueError(f"spacing = {spacing}: expected more than 0 m")
        gaps = np.hypot(*(np.roll(knots, -1, axis=0) - knots).T)
        if gaps.min() <= 0:
            raise ValueError("points: expected no point twice in a row; the last joins the first by itself")
        bends = _second_derivatives(knots, gaps)
        # Arc length over the parameter, by chords far shorter than a piece.
        per_gap = int(np.ceil(20 * gaps.max() / spacing))
        at = (np.arange(len(knots))[:, None] + np.arange(per_gap) / per_gap).ravel()
        dense = self._evaluated(knots, gaps, bends, np.append(at, len(knots)))[0]
        run = np.append(0.0, np.cumsum(np.hypot(*np.diff(dense, axis=0).T)))
        pieces = max(int(round(run[-1] / spacing)), 3)
        self.length = float(run[-1])
        self.spacing = self.length / pieces
        place = np.interp(np.arange(pieces) * self.spacing, run, np.append(at, len(knots)))
        point, first, second = self._evaluated(knots, gaps, bends, place)
        speed = np.hypot(first[:, 0], first[:, 1])
        self.x, self.y = point.T.copy()
        self.heading = np.unwrap(np.arctan2(first[:, 1], first[:, 0]))
        self.curvature = (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / speed**3
        self._table = np.column_stack([self.x, self.y, np.cos(self.heading), np.sin(self.heading), self.heading, self.curvature])

    @staticmethod
    def _evaluated(
        knots: np.ndarray, gaps: np.ndarray, bends: np.ndarray, at: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Point and derivatives by the chord's length; ``at``: number of the knot plus the share of the way to the next."""
        i = np.floor(at).astype(int) % len(knots)
        j = (i + 1) % len(knots)
        h, b = gaps[i, None], (at - np.floor(at))[:, None]
        a = 1 - b
        point = a * knots[i] + b * knots[j] + ((a**3 - a) * bends[i] + (b**3 - b) * bends[j]) * h**2 / 6
        first = (knots[j] - knots[i]) / h + ((3 * b**2 - 1) * bends[j] - (3 * a**2 - 1) * bends[i]) * h / 6
        return point, first, a * bends[i] + b * bends[j]

    def __len__(self) -> int:
        return len(self.x)

    def at(self, distance: np.ndarray, offset: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Ground point ``x``, ``y`` [m] beside the path, ``offset`` [m] to its left, the path's heading there [rad] and the piece;
        all (n,)."""
        piece = np.rint(distance / self.spacing).astype(np.int64) % len(self)
        along = distance - np.rint(distance / self.spacing) * self.spacing
        heading = self.heading[piece] + self.curvature[piece] * along
        half = self.heading[piece] + 0.5 * self.curvature[piece] * along  # the arc's chord
        x = self.x[piece] + along * np.cos(half) - offset * np.sin(heading)
        y = self.y[piece] + along * np.sin(half) + offset * np.cos(heading)
        return x, y, heading, piece

    def locate(
        self, x: np.ndarray, y: np.ndarray, piece: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Distance along the path [m], offset to its left [m], the path's heading [rad] and curvature [1/m] at points (n,), and
        their pieces; ``piece`` (n,) says where to search: within some pieces of it. Pieces count on over laps, and the distance
        with them."""
        for last in (False, True):
            rows = self._table.take(piece % len(self), axis=0)
            dx, dy = x - rows[:, 0], y - rows[:, 1]
            offset = dy * rows[:, 2] - dx * rows[:, 3]
            curvature = rows[:, 5]
            along = (dx * rows[:, 2] + dy * rows[:, 3]) / np.maximum(1 - curvature * offset, 0.2)
            if not last:
                piece = piece + np.rint(along / self.spacing).astype(np.int64)
        # The arc bends away from its tangent.
        offset -= 0.5 * curvature * along**2 * np.maximum(1 - curvature * offset, 0.2)
        return piece * self.spacing + along, offset, rows[:, 4] + curvature * along, curvature, piece

    def preview(self, piece: np.ndarray, ahead: np.ndarray) -> np.ndarray:
        """Curvature [1/m] at ``ahead`` (k,) pieces before each car, (k, n)."""
        return self.curvature.take(piece + ahead[:, None], mode="wrap")


class Placement:
    """Where the ground of each car lies in the coordinates of a path or a slot: turned and moved, so that a car that the simulation
    starts at its one point begins anywhere."""

    def __init__(self, count: int):
        self.heading = np.zeros(count)
        self._cos, self._sin = np.ones(count), np.zeros(count)
        self._x, self._y = np.zeros(count), np.zeros(count)

    def put(
        self, cars: np.ndarray, x: np.ndarray, y: np.ndarray, heading: np.ndarray, start_x: np.ndarray, start_y: np.ndarray
    ) -> None:
        """Cars whose center of mass starts at ``start_x``, ``start_y`` of the simulation's ground, with yaw 0, are at ``x``, ``y``
        with ``heading``; all (m,), [m] and [rad]."""
        cos, sin = np.cos(heading), np.sin(heading)
        self.heading[cars], self._cos[cars], self._sin[cars] = heading, cos, sin
        self._x[cars] = x - cos * start_x + sin * start_y
        self._y[cars] = y - sin * start_x - cos * start_y

    def __call__(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The point (n,) in those coordinates [m]."""
        return self._x + self._cos * x - self._sin * y, self._y + self._sin * x + self._cos * y
