"""Cars that differ: a bank of prepared starts, from which episodes begin."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .. import Batch
from .._batch import Start
from .._variation import FRICTION

if TYPE_CHECKING:
    from ._task import Task

Spread = Union[Sequence[float], Callable[[np.random.Generator], float]]


class Randomization:
    """Numbers by their names: ``{"chassis.mass_kg": (0.9, 1.1)}`` multiplies what the vehicle has by a factor from that range,
    ``{"road.friction": lambda random: random.normal(0.8, 0.05)}`` gives the number itself. None leaves a number as it is."""

    def __init__(self, spreads: Mapping[str, Spread | None]):
        self.spreads = {name: self._checked(name, spread) for name, spread in spreads.items() if spread is not None}

    @staticmethod
    def _checked(name: str, spread: Any) -> Spread:
        if name.startswith("road.") and name != FRICTION:
            raise KeyError(f"randomize: there is no {name!r} that varies; did you mean {FRICTION!r}?")
        if callable(spread):
            return spread
        try:
            low, high = (float(limit) for limit in spread)
        except (TypeError, ValueError):
            wanted = "expected (low, high) factors or a function of a generator"
            raise ValueError(f"randomize[{name!r}] = {spread!r}: {wanted}") from None
        if not 0 < low <= high < np.inf:
            raise ValueError(f"randomize[{name!r}] = ({low}, {high}): expected factors with 0 < low <= high")
        return low, high

    @property
    def names(self) -> list[str]:
        return list(self.spreads)

    def draw(self, nominal: Mapping[str, float], random: np.random.Generator) -> dict[str, float]:
        """A number for each name."""
        out = {}
        for name, spread in self.spreads.items():
            out[name] = float(spread(random)) if callable(spread) else nominal[name] * random.uniform(*spread)
            if not np.isfinite(out[name]):
                raise ValueError(f"randomize[{name!r}] gave {out[name]}: expected a finite number")
        return out


class Bank:
    """``size`` cars at their starts, with their numbers and, of ``channels``, their values (size, c).

    Made by a generator of its own with ``seed``, so that two environments have the same bank whatever their sizes."""

    def __init__(
        self, batch: Batch, task: Task, randomization: Randomization, channels: Sequence[str], size: int, seed: int
    ):
        if size < 1:
            raise ValueError(f"bank = {size}: expected at least one start")
        random = np.random.default_rng(seed)
        nominal = {name: float(batch.expand(name)[0]) for name in randomization.names}
        self.starts: list[Start] = []
        for number in range(size):
            changes = randomization.draw(nominal, random)
            friction = changes.pop(FRICTION, None)
            self.starts.append(batch.prepare(changes, friction=friction, **task.start(random, number)))
        self.values = self._read(batch, channels)

    def _read(self, batch: Batch, channels: Sequence[str]) -> np.ndarray:
        rows = []
        for first in range(0, len(self.starts), len(batch)):
            some = self.starts[first : first + len(batch)]
            batch.reset(np.arange(len(some)), some)
            rows.append(batch.read(channels)[: len(some)])
        return np.concatenate(rows)

    def __len__(self) -> int:
        return len(self.starts)
