"""Points as cars of one batch: the same controls for all, each with its own numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from typing import Any

import numpy as np

from .._batch import Batch
from .._documents import Scenario, Vehicle
from .._errors import Error
from ._cases import Rows, channels_of, reduced
from ._figures import Wanted, reduction_columns
from ._parameters import Parameter, owner_of

_OPTIONS = (
    "speed", "position", "yaw", "friction", "step", "integrator", "powered", "energy_balance", "precision", "tilt_limit", "threads",
)
_AT_ONCE = 1024  # cars of one batch: what they record must fit in memory


class BatchCase:
    """Cars of a batch under rows of controls, ``steps`` steps each; channels are recorded after each row and reduced over the rows.

    ``told``: ``controls``, by name a number or a list with a number for each row; ``rows``, where none is a list; ``steps`` of each
    row; the rest goes to Batch. A function among the figures gets the channels of one car, ``(rows,)`` each, by name.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        parameters: Sequence[Parameter],
        scenario: Scenario | None,
        told: Mapping[str, Any],
        figures: list[Wanted],
        record: Sequence[str],
    ):
        options = dict(told)
        self.controls = {name: np.asarray(values, dtype=np.float64) for name, values in options.pop("controls", {}).items()}
        self.steps = options.pop("steps", 1)
        self.rows = _count_rows(self.controls, options.pop("rows", None))
        for name in options:
            if name not in _OPTIONS:
                near = get_close_matches(name, ["controls", "rows", "steps", *_OPTIONS], 1)
                hint = f"; did you mean {near[0]!r}?" if near else f": expected controls, rows, steps, {', '.join(_OPTIONS)}"
                raise TypeError(f"batch[{name!r}] is unknown{hint}")
        self.vehicle, self.scenario, self.options = vehicle, scenario, {"threads": 1, **options}
        self.parameters = parameters
        self.names = [(i, _varied_name(key)) for i, p in enumerate(parameters) for key in p.keys]
        self.batches: dict[int, Batch] = {}
        first = self._batch(1)  # names that cannot vary are refused here
        self._rows_of(first)
        self.columns = reduction_columns(figures, first.channels)
        self.channels = channels_of(self.columns, record)

    def _batch(self, count: int) -> Batch:
        if count not in self.batches:
            if len(self.batches) > 1:  # chunks of one size, and the last one
                self.batches.clear()
            self.batches[count] = Batch(
                self.vehicle, count, self.scenario, vary=[name for _, name in self.names], **self.options
            )
        return self.batches[count]

    def _rows_of(self, batch: Batch) -> np.ndarray:
        names = batch.control_names
        out = np.full((self.rows, len(batch), len(names)), np.nan)
        for name, values in self.controls.items():
            if name not in names:
                near = get_close_matches(name, names, 1)
                hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(names)}"
                raise TypeError(f"this car has no control {name!r}{hint}")
            out[:, :, names.index(name)] = values.reshape(-1, 1) if values.ndim else values
        return out

    def __call__(self, X: np.ndarray) -> Rows:
        parts = [self._evaluate(X[i : i + _AT_ONCE]) for i in range(0, len(X), _AT_ONCE)]
        Y = np.concatenate([Y for Y, _ in parts]) if parts else np.empty((0, len(self.columns)))
        return Y, [reason for _, reasons in parts for reason in reasons]

    def _evaluate(self, X: np.ndarray) -> Rows:
        batch = self._batch(len(X))
        reasons = _begin(batch, {name: X[:, i] for i, name in self.names})
        recorded = batch.rollout(self._rows_of(batch), self.steps, self.channels)
        Y = np.full((len(X), len(self.columns)), np.nan)
        for car in range(len(X)):
            if not reasons[car] and batch.ended[car]:
                reasons[car] = batch.why(car)
            if reasons[car]:
                continue
            try:
                Y[car] = reduced(self.columns, {name: values[:, car] for name, values in recorded.items()})
            except Exception as error:  # noqa: BLE001  of a function, for this point alone
                reasons[car] = f"{type(error).__name__}: {error}"
        return Y, reasons


def _begin(batch: Batch, numbers: Mapping[str, np.ndarray]) -> list[str]:
    """Every car at its start with its numbers. Why one cannot have them, or "": it keeps those that it had."""
    for name, values in numbers.items():
        batch.expand(name)[:] = values
    reasons = [""] * len(batch)
    try:
        batch.reset()
    except (Error, ValueError):  # none is reset then: each by itself, to find which it is
        for car in range(len(batch)):
            try:
                batch.reset([car])
            except (Error, ValueError) as error:
                reasons[car] = str(error)
    return reasons


def _count_rows(controls: Mapping[str, np.ndarray], rows: Any) -> int:
    counts = {name: len(values) for name, values in controls.items() if values.ndim == 1}
    for name, values in controls.items():
        if values.ndim > 1:
            raise ValueError(f"controls[{name!r}] of shape {values.shape}: expected a number or a list, a number for each row")
    if rows is not None:
        counts["rows"] = rows
    if len(set(counts.values())) != 1 or min(counts.values()) < 1:
        told = ", ".join(f"{name}: {count}" for name, count in counts.items()) or "none"
        raise ValueError(f"batch: rows of controls ({told}): expected a list of one length, or rows=... where all are numbers")
    return int(next(iter(counts.values())))


def _varied_name(key: str) -> str:
    owner, name = owner_of(key)
    if owner == "vehicle":
        return name
    if key == "scenario.road.friction":
        return name
    raise ValueError(f"{key}: cars of a batch share their scenario, but for scenario.road.friction")
