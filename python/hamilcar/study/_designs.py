"""Designs: where in the ranges of its parameters a study looks. Each returns points ``X (n, d)`` in the units of the parameters."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import Union

import numpy as np

from ._parameters import Parameter


def scaled(unit_points: np.ndarray, parameters: Sequence[Parameter]) -> np.ndarray:
    """Points of the unit cube ``(n, d)`` in the parameters' ranges; what counts something gets every value equally often."""
    out = np.empty(unit_points.shape)
    for i, p in enumerate(parameters):
        if p.whole:
            low, high = np.ceil(p.min), np.floor(p.max)
            out[:, i] = np.minimum(low + np.floor(unit_points[:, i] * (high - low + 1)), high)
        else:
            out[:, i] = np.minimum(p.min + unit_points[:, i] * (p.max - p.min), p.max)
    return out


def rounded(X: np.ndarray, parameters: Sequence[Parameter]) -> np.ndarray:
    """Points with the columns rounded of what counts something."""
    whole = np.array([p.whole for p in parameters])
    return np.where(whole, np.round(X), X)


def _check_count(name: str, count: int) -> int:
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
        raise ValueError(f"{name} = {count!r}: expected a whole number, at least 1")
    return int(count)


def latin_hypercube(parameters: Sequence[Parameter], points: int, seed: int = 1) -> np.ndarray:
    """``points`` points ``(n, d)``: each range is cut into n equal parts and each part used once (McKay, Beckman and Conover,
    Technometrics 21, 1979); which goes with which, and where in it, is drawn by ``seed``."""
    count = _check_count("points", points)
    random = np.random.default_rng(seed)
    parts = np.column_stack([random.permutation(count) for _ in parameters])
    return scaled((parts + random.random(parts.shape)) / count, parameters)


def full_factorial(parameters: Sequence[Parameter], levels: Union[int, Sequence[int]]) -> np.ndarray:
    """Every combination ``(n, d)`` of evenly spaced levels from end to end of each range, the last parameter fastest.
    ``levels``: how many, one number or one for each parameter; a single level is the middle."""
    counts = [levels] * len(parameters) if isinstance(levels, (int, np.integer)) else list(levels)
    if len(counts) != len(parameters):
        raise ValueError(f"{len(counts)} levels: expected one number or one for each of {len(parameters)} parameters")
    columns = []
    for p, count in zip(parameters, counts):
        _check_count(f"levels of {p.name}", count)
        columns.append(np.linspace(p.min, p.max, count) if count > 1 else np.array([(p.min + p.max) / 2]))
    return rounded(np.array(list(product(*columns))), parameters)


def sobol(parameters: Sequence[Parameter], points: int, seed: int = 1, scramble: bool = True) -> np.ndarray:
    """``points`` points ``(n, d)`` of Sobol's sequence: powers of two fill the ranges evenly, and more points with the same seed
    keep those before. ``scramble``: at random by ``seed``, after Owen; else the sequence begins with all at their min."""
    try:
        from scipy.stats import qmc
    except ImportError as error:
        raise ImportError("Sobol's sequence needs SciPy: pip install 'hamilcar[study]'") from error
    count = _check_count("points", points)
    sequence = qmc.Sobol(len(parameters), scramble=scramble, seed=seed)
    drawn = sequence.random(1 << (count - 1).bit_length())[:count]  # of a power of two, as the sequence wants it
    return scaled(drawn, parameters)


def one_at_a_time(
    parameters: Sequence[Parameter], levels: int = 3, base: Sequence[float] | np.ndarray | None = None
) -> np.ndarray:
    """The base point, then each parameter alone at ``levels`` values from end to end while the others stay: ``(1 + d levels, d)``.
    ``base``: a value for each parameter; the middles of the ranges if left out."""
    count = _check_count("levels", levels)
    middle = np.array([(p.min + p.max) / 2 for p in parameters])
    start = middle if base is None else np.asarray(base, dtype=np.float64)
    if start.shape != (len(parameters),):
        raise ValueError(f"base of shape {start.shape}: expected ({len(parameters)},), a value for each parameter")
    out = np.tile(start, (1 + count * len(parameters), 1))
    for i, p in enumerate(parameters):
        out[1 + i * count : 1 + (i + 1) * count, i] = np.linspace(p.min, p.max, count) if count > 1 else p.max
    return rounded(out, parameters)
