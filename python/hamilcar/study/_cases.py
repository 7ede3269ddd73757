"""What a study does with its points: a maneuver, a scenario, cars of a batch, or a function of one's own.

Each case turns points ``(n, d)`` into figures ``(n, m)`` and a reason for every row, "" where it went well. Rows do not depend
on which points they are evaluated with, so that chunks can be cut anywhere and repeated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from .._documents import Scenario, Vehicle
from .._errors import InputError, NumericalError
from .._maneuver import maneuver as drive
from .._run import run
from ._figures import REDUCTIONS, FigureColumn, Wanted, outcome_columns, reduction_columns, split_reduction
from ._parameters import Parameter, owner_of, values_by_owner

Rows = tuple[np.ndarray, list[str]]
Document = TypeVar("Document", Vehicle, Scenario)


def _with(document: Document, values: Mapping[str, Any]) -> Document:
    return type(document)(document, values) if values else document


def reduced(columns: Sequence[FigureColumn], recorded: Any) -> list[float]:
    """Figures of what was recorded, by channel; functions get all of it."""
    out = []
    for column in columns:
        if callable(column.wanted):
            out.append(float(column.wanted(recorded)))
        else:
            word, channel = split_reduction(column.wanted)
            out.append(float(REDUCTIONS[word](recorded[channel])))
    return out


def channels_of(columns: Sequence[FigureColumn], more: Sequence[str]) -> list[str]:
    """That are recorded for these figures, each once."""
    named = [split_reduction(c.wanted)[1] for c in columns if isinstance(c.wanted, str)]
    return list(dict.fromkeys([*named, *more]))


class PointCase:
    """Points one by one. A subclass has ``values``, the figures of one point; whatever is wrong with it is the row's reason."""

    columns: list[FigureColumn]

    def values(self, point: np.ndarray) -> list[float]:
        raise NotImplementedError

    def __call__(self, X: np.ndarray) -> Rows:
        Y = np.full((len(X), len(self.columns)), np.nan)
        reasons = [""] * len(X)
        for i, point in enumerate(X):
            try:
                Y[i] = self.values(point)
            except Exception as error:  # noqa: BLE001  of this point alone
                reasons[i] = f"{type(error).__name__}: {error}" if not str(error) else str(error)
        return Y, reasons


class ManeuverCase(PointCase):
    """A standard maneuver, its figures by their names; a function gets the Outcome, with its runs."""

    def __init__(
        self,
        vehicle: Vehicle,
        parameters: Sequence[Parameter],
        name: str,
        settings: Mapping[str, Any],
        scenario: Scenario | None,
        record: Sequence[str],
    ):
        self.vehicle, self.parameters, self.name = vehicle, parameters, name
        self.settings, self.scenario, self.channels = dict(settings), scenario, list(record)
        self.columns = []
        for parameter in parameters:
            for key in parameter.keys:
                owner, of_owner = owner_of(key)
                if owner == "scenario" and of_owner.split(".")[0] not in ("road", "solver"):
                    raise InputError(f"{key}: a maneuver takes road and solver alone of a scenario", 3, key)
                if owner == "maneuver" and of_owner in self.settings:
                    raise ValueError(f"{key} is both a parameter and a setting")

    def find_columns(self, figures: list[Wanted]) -> list[FigureColumn]:
        """Drives once, in the middle of the ranges: whatever is wrong shows before the sweep, and figures tell their units."""
        middle = np.array([(p.min + p.max) / 2 for p in self.parameters])
        whole = np.array([p.whole for p in self.parameters])
        outcome = self._outcome(np.where(whole, np.floor(middle), middle), any(map(callable, figures)))
        return outcome_columns(figures, outcome.figures, outcome.failed)

    def _outcome(self, point: np.ndarray, record: bool) -> Any:
        values = values_by_owner(self.parameters, point)
        vehicle = _with(self.vehicle, values["vehicle"])
        scenario = None if self.scenario is None else _with(self.scenario, values["scenario"])
        settings = {**self.settings, **values["maneuver"]}
        return drive(self.name, vehicle, scenario=scenario, channels=self.channels, record=record, **settings)

    def values(self, point: np.ndarray) -> list[float]:
        outcome = self._outcome(point, any(callable(c.wanted) for c in self.columns))
        if outcome.failed:
            raise NumericalError(outcome.failed, 4)
        out = []
        for column in self.columns:
            if callable(column.wanted):
                out.append(float(column.wanted(outcome)))
            else:  # NaN where the drive did not show it: a rear axle that never locks has no time of locking
                out.append(outcome.figures[column.wanted].value if column.wanted in outcome.figures else np.nan)
        return out


class ScenarioCase(PointCase):
    """A scenario to its end, its channels reduced over the rows of its output; a function gets the Results."""

    def __init__(
        self, vehicle: Vehicle, parameters: Sequence[Parameter], scenario: Scenario, figures: list[Wanted], record: Sequence[str]
    ):
        if scenario._core.maneuver:
            raise ValueError(f"this scenario is the maneuver {scenario._core.maneuver!r}: use Study(maneuver=...)")
        self.vehicle, self.parameters, self.scenario = vehicle, parameters, scenario
        self.columns = reduction_columns(figures, vehicle.channels)
        self.channels = channels_of(self.columns, record)

    def values(self, point: np.ndarray) -> list[float]:
        values = values_by_owner(self.parameters, point)
        vehicle, scenario = _with(self.vehicle, values["vehicle"]), _with(self.scenario, values["scenario"])
        return reduced(self.columns, run(scenario, vehicle, channels=self.channels, picture=False))


class FunctionCase(PointCase):
    """A function of one point, a dict of values by name, that returns a dict of figures or their numbers in order."""

    def __init__(self, parameters: Sequence[Parameter], function: Callable[[dict[str, float]], Any], columns: list[FigureColumn]):
        self.parameters, self.function, self.columns = parameters, function, columns

    def values(self, point: np.ndarray) -> list[float]:
        found = self.function({p.name: float(value) for p, value in zip(self.parameters, point)})
        numbers = [found[c.name] for c in self.columns] if isinstance(found, Mapping) else np.atleast_1d(found)
        if len(numbers) != len(self.columns):
            raise ValueError(f"the function returned {len(numbers)} numbers: expected {len(self.columns)}, one for each figure")
        return [float(number) for number in numbers]
