"""A run of a Rollout as a linear map for each row, in coordinates that are free."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import _core

_FIRST_ANGLE = 3  # of the state: position, then a quaternion


@dataclass(frozen=True)
class LinearSteps:
    """``dz_k+1 = A[k] dz_k + B_before[k] du_k-1 + B[k] du_k`` for the rows of a run: ``du_k`` moves the targets of row k,
    ``du_k-1`` where the controls stand before it, so that what a row before did to the rack is not forgotten.

    ``A (t, nz, nz)``, ``B`` and ``B_before (t, nz, m)``; z is named by ``states`` with ``units``: position on the ground, a small
    rotation in chassis axes [rad], momenta in ground axes, and all that is free in suspensions, wheels, tires, hitches and power units.
    ``points (t + 1, s)`` are the states that the maps lie between, in all numbers of the simulation."""

    A: np.ndarray
    B_before: np.ndarray
    B: np.ndarray
    states: list[str]
    units: list[str]
    controls: list[str]
    points: np.ndarray


def _to_state(state: np.ndarray, places: list[int]) -> np.ndarray:
    """``(s, nz)``: how the numbers of a state change with z, dependent coordinates aside."""
    out = np.zeros((state.size, len(places) - 1))
    w, v = state[_FIRST_ANGLE], state[_FIRST_ANGLE + 1 : _FIRST_ANGLE + 4]
    out[:3, :3] = np.eye(3)
    out[_FIRST_ANGLE, 3:6] = -v / 2
    out[_FIRST_ANGLE + 1 : _FIRST_ANGLE + 4, 3:6] = (w * np.eye(3) + _cross(v)) / 2
    for column, place in enumerate(places[7:], 6):
        out[place, column] = 1
    return out


def _from_state(state: np.ndarray, places: list[int]) -> np.ndarray:
    """``(nz, s)``: how z changes with the numbers of a state."""
    out = np.zeros((len(places) - 1, state.size))
    w, v = state[_FIRST_ANGLE], state[_FIRST_ANGLE + 1 : _FIRST_ANGLE + 4]
    out[:3, :3] = np.eye(3)
    out[3:6, _FIRST_ANGLE] = -2 * v
    out[3:6, _FIRST_ANGLE + 1 : _FIRST_ANGLE + 4] = 2 * (w * np.eye(3) - _cross(v))
    for row, place in enumerate(places[7:], 6):
        out[row, place] = 1
    return out


def _cross(v: np.ndarray) -> np.ndarray:
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def linear_steps(
    runner: _core.Runner,
    numbers: list[tuple[str, str, bool]],
    start: _core.Start,
    rows: np.ndarray,
    state: np.ndarray,
    controls: list[str],
) -> LinearSteps:
    """``rows (t + 1, m)``, the first of them where the controls are held."""
    t, m = len(rows) - 1, rows.shape[1]
    places = [i for i, (_, _, is_free) in enumerate(numbers) if is_free]
    points = [state]
    for k in range(t):
        points.append(runner.run([start], rows[None, k : k + 2], points[-1][None])[1][0])
    z = len(places) - 1
    directions = z + 2 * m
    along_states = np.zeros((t, directions, state.size))
    along_rows = np.zeros((t, directions, 2, m))
    for k in range(t):
        along_states[k, :z] = _to_state(points[k], places).T
        along_rows[k, z : z + m, 0] = np.eye(m)
        along_rows[k, z + m :, 1] = np.eye(m)
    count = t * directions
    starts = [start] * count
    all_rows = np.repeat(np.stack([rows[:-1], rows[1:]], axis=1), directions, axis=0)
    all_states = np.repeat(np.stack(points[:-1]), directions, axis=0)
    flat_rows = along_rows.reshape(count, 2, m)
    closed = runner.closed(starts, all_rows, all_states, flat_rows, along_states.reshape(count, -1))
    parameters = np.zeros((count, runner.parameters_of(start).size))
    ends = runner.tangents(starts, all_rows, all_states, flat_rows, closed, parameters)[3].reshape(t, directions, -1)
    maps = np.stack([_from_state(points[k + 1], places) @ ends[k].T for k in range(t)])
    angles = ["rotation.x", "rotation.y", "rotation.z"]
    return LinearSteps(
        A=maps[:, :, :z], B_before=maps[:, :, z : z + m], B=maps[:, :, z + m :],
        states=[numbers[i][0] for i in places[:3]] + angles + [numbers[i][0] for i in places[7:]],
        units=[numbers[i][1] for i in places[:3]] + ["rad"] * 3 + [numbers[i][1] for i in places[7:]],
        controls=list(controls), points=np.stack(points),
    )
