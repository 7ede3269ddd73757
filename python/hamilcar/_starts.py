"""Cars of a rollout at their starts, by the parameters that they have, and how what they are changes with these."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator, Mapping

import numpy as np

from . import _core
from ._variation import Variation

_MOST_KEPT = 1024


class Starts:
    """Prepared cars by parameters ``(p,)``, of which the latest are kept.

    Derivatives by the parameters are differences of fourth order: a file's numbers pass its reader, linkages are assembled and the
    car settles, which is no list of operations."""

    def __init__(self, variation: Variation):
        self._variation = variation
        self._nominal = np.array(list(variation.nominal.values()))
        self._made: OrderedDict[bytes, _core.Start] = OrderedDict()
        self._known: OrderedDict[bytes, tuple[np.ndarray, np.ndarray]] = OrderedDict()

    def made(self, changes: Mapping[str, float]) -> _core.Start:
        vehicle, scenario = self._variation.changed(changes)
        return _core.Start(vehicle._core, scenario._core)

    def at(self, values: np.ndarray) -> _core.Start:
        key = values.tobytes()
        if key not in self._made:
            named = zip(self._variation.nominal.items(), values)
            self._made[key] = self.made({name: float(value) for (name, usual), value in named if value != usual})
            if len(self._made) > _MOST_KEPT:
                self._made.popitem(last=False)
        self._made.move_to_end(key)
        return self._made[key]

    def _beside(self, values: np.ndarray) -> Iterator[tuple[list[_core.Start], list[float]]]:
        """For each parameter the cars beside the one with these values, and their weights in the derivative."""
        for j, name in enumerate(self._variation.nominal):
            low, high = self._variation.limits(name)
            spacing = 1e-3 * max(abs(values[j]), 1e-3 * abs(self._nominal[j]), 1e-3)
            places, weights = _stencil(values[j], 10.0 ** np.floor(np.log10(spacing)), low, high)
            step = np.eye(len(values))[j]
            yield [self.at(values + place * step) for place in places], weights

    def sensitivity(self, core: _core.Runner, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How the numbers of the model and the starting state change: a column for each parameter."""
        key = values.tobytes()
        if key not in self._known:
            of_numbers, of_start = [], []
            for cars, weights in self._beside(values):
                of_numbers.append(sum(w * core.parameters_of(car) for w, car in zip(weights, cars)))
                of_start.append(sum(w * core.state_of(car) for w, car in zip(weights, cars)))
            self._known[key] = np.array(of_numbers).T, np.array(of_start).T
            if len(self._known) > _MOST_KEPT:
                self._known.popitem(last=False)
        return self._known[key]

    def targets_by_parameters(self, core: _core.Runner, values: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """Changes ``(p, t + 1, m)`` of the targets ``rows`` that act as the parameters do: the steering's ratio stands
        between wheel and rack, and is no number of the model."""
        _, slopes = core.scheduled(self.at(values), rows)
        out = np.zeros((len(values), *rows.shape))
        for j, (cars, weights) in enumerate(self._beside(values)):
            out[j] = sum(w * core.scheduled(car, rows)[0] for w, car in zip(weights, cars)) / slopes
        return out


def _stencil(value: float, spacing: float, low: float, high: float) -> tuple[list[float], list[float]]:
    """Offsets and weights of a first derivative of fourth order, to one side where a limit is near."""
    to_one_side = (0, 1, 2, 3, 4), (-25 / 12, 4, -3, 4 / 3, -1 / 4)
    for sign, (offsets, weights) in ((1, ((-2, -1, 1, 2), (1 / 12, -8 / 12, 8 / 12, -1 / 12))), (1, to_one_side), (-1, to_one_side)):
        places = [sign * offset * spacing for offset in offsets]
        if all(low <= value + place <= high for place in places):
            return places, [sign * weight / spacing for weight in weights]
    raise ValueError(f"{value}: expected a parameter with room of {4 * spacing} between {low} and {high}")
