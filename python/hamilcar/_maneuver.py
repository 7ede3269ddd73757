"""Standard maneuvers with their figures."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from . import _core
from ._documents import Scenario, Source, Vehicle, as_vehicle
from ._results import Results


@dataclass(frozen=True)
class Figure:
    """A characteristic value; NaN where the drive did not show it."""

    value: float
    unit: str
    meaning: str

    def __float__(self) -> float:
        return self.value


@dataclass(frozen=True)
class Verdict:
    criterion: str
    passed: bool
    found: str


class Outcome:
    """What a maneuver found out: ``outcome["roll gradient"]`` is a figure's value, ``outcome.runs`` what was driven."""

    def __init__(self, driven: _core.Driven):
        self._driven = driven
        self.maneuver: str = driven.maneuver
        self.title: str = driven.title
        self.figures = {name: Figure(value, unit, meaning) for name, value, unit, meaning in driven.figures}
        self.verdicts = [Verdict(*one) for one in driven.verdicts]
        self.passed: bool = driven.passed
        self.failed: str | None = driven.failed
        self.notes: list[str] = driven.notes
        self.runs = [Results(rows) for rows in driven.runs]

    def __getitem__(self, name: str) -> float:
        if name not in self.figures:
            from difflib import get_close_matches

            near = get_close_matches(name, list(self.figures), 1)
            raise KeyError(f"there is no figure {name!r}" + (f"; did you mean {near[0]!r}?" if near else ""))
        return self.figures[name].value

    def to_dict(self) -> dict[str, Any]:
        """As the command line writes it to outcome.json."""
        return json.loads(self._driven.json())

    def to_html(self, path: str | os.PathLike[str]) -> None:
        """A page with figures, verdicts, diagrams and the replay."""
        Path(path).write_text(self._driven.page(), encoding="utf-8")

    def _repr_html_(self) -> str:
        return f'<iframe style="width:100%;height:720px;border:0" srcdoc="{escape(self._driven.page())}"></iframe>'

    def __repr__(self) -> str:
        state = "failed" if self.failed else "passed" if self.passed else "not passed"
        return f"<hamilcar.Outcome {self.maneuver!r}: {len(self.figures)} figures, {state if self.verdicts or self.failed else 'no verdicts'}>"


def maneuver(
    name: str,
    vehicle: Vehicle | Source = "bmw_323i",
    *,
    scenario: Scenario | Source | None = None,
    channels: Sequence[str] = (),
    record: bool = True,
    **settings: Any,
) -> Outcome:
    """Drives a standard maneuver: ``maneuver("step_steer", car, speed=80)``.

    ``settings`` are in the units that ``vehicle.maneuvers()`` tells, km/h and degrees as standards have them; flags are True or False,
    choices words. ``scenario``: whose road and solver to drive with. ``record``: keep the runs, with ``channels`` or the
    default set.
    """
    chosen = scenario if scenario is None or isinstance(scenario, Scenario) else Scenario(scenario)
    driven = _core.drive(
        name, as_vehicle(vehicle)._core, settings, chosen._core if chosen else None, list(channels), record
    )
    return Outcome(driven)
