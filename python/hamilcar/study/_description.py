"""What a study is made of, checked, and as JSON has it, so that other processes and machines make the same again."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Union

import numpy as np

from .. import _core
from .._documents import Scenario, Vehicle
from ._batch_case import BatchCase
from ._cases import FunctionCase, ManeuverCase, PointCase, ScenarioCase
from ._figures import FigureColumn, check_figures, reference_to, wanted_from
from ._parameters import Parameter, check_names, owner_of, resolved

Case = Union[PointCase, BatchCase]


@dataclass(frozen=True)
class StudyDescription:
    """All but the figures. With a maneuver or a batch, the scenario is what they drive with."""

    vehicle: Vehicle | None
    parameters: tuple[Parameter, ...]
    maneuver: str | None
    settings: dict[str, Any]
    scenario: Scenario | None
    batch: dict[str, Any] | None
    function: Callable[[dict[str, float]], Any] | None
    record: list[str]

    @property
    def kind(self) -> str:
        for kind in ("maneuver", "batch", "function"):
            if getattr(self, kind) is not None:
                return kind
        return "scenario"

    def to_dict(self, columns: Sequence[FigureColumn]) -> dict[str, Any]:
        return {
            "vehicle": None if self.vehicle is None else self.vehicle.to_dict(),
            "parameters": [p.to_dict() for p in self.parameters],
            "figures": [c.to_dict() for c in columns],
            "maneuver": self.maneuver,
            "settings": self.settings,
            "scenario": None if self.scenario is None else self.scenario.to_dict(),
            "batch": self.batch,
            "function": None if self.function is None else reference_to(self.function),
            "record": self.record,
        }


def described(
    vehicle: Any, parameters: Iterable[Parameter | Mapping[str, Any]], maneuver: str | None, settings: Mapping[str, Any] | None,
    scenario: Any, batch: Mapping[str, Any] | None, function: Any, record: Sequence[str],
) -> StudyDescription:
    """Raises TypeError, ValueError and InputError with what was expected."""
    kinds = [kind for kind, given in (("maneuver", maneuver), ("batch", batch), ("function", function)) if given is not None]
    if len(kinds) > 1 or (not kinds and scenario is None) or (kinds == ["function"] and scenario is not None):
        raise TypeError("a study: expected one of maneuver=..., scenario=..., batch={...} and function=...")
    if settings and maneuver is None:
        raise TypeError("settings: are those of a maneuver, and this study drives none")
    if isinstance(record, str):
        raise TypeError("record: expected a list of channels, not a text")
    named = check_names(parameters)
    if function is not None:
        if vehicle is not None or not callable(function):
            raise TypeError("a study with a function: expected one that can be called, and None in the place of the vehicle")
        return StudyDescription(None, named, None, {}, None, None, function, [])
    conditions = None if scenario is None else Scenario(scenario)
    if vehicle is None and conditions is None:
        raise TypeError("vehicle: expected one; None only with a function, or for the one that the scenario names")
    own = Vehicle(conditions.vehicle if vehicle is None and conditions else vehicle)  # a copy: theirs may change
    if maneuver is not None:
        _check_maneuver(own, maneuver)
    wants_scenario = any(owner_of(key)[0] == "scenario" for p in named for key in p.keys)
    if conditions is None and (wants_scenario or batch is not None):
        conditions = _plane(maneuver)
    made = tuple(resolved(p, own, conditions, maneuver) for p in named)
    return StudyDescription(
        own, made, maneuver, plain("settings", settings or {}), None if scenario is None and batch is not None else conditions,
        plain("batch", batch), None, list(record),
    )


def _plane(maneuver: str | None) -> Scenario:
    """What a study without a scenario drives in."""
    tables: dict[str, Any] = {"name": "study", "vehicle": "of the study"}
    return Scenario({**tables, "maneuver": {"name": maneuver}} if maneuver else {**tables, "duration_s": 1.0})


def case_of(told: StudyDescription, figures: Any) -> Case:
    """What is done with points. ``figures``: as Study takes them, or columns that were found out before."""
    if told.function is not None:
        return FunctionCase(told.parameters, told.function, _named(figures))
    assert told.vehicle is not None
    known = figures if isinstance(figures, list) and figures and isinstance(figures[0], FigureColumn) else []
    wanted = [c.wanted for c in known] or check_figures(figures)
    if told.maneuver is not None:
        case = ManeuverCase(told.vehicle, told.parameters, told.maneuver, told.settings, told.scenario, told.record)
        case.columns = known or case.find_columns(wanted)
        return case
    if not wanted:
        raise ValueError("figures: expected at least one, such as 'max chassis.speed'")
    if told.batch is not None:
        return BatchCase(told.vehicle, told.parameters, told.scenario, told.batch, wanted, told.record)
    assert told.scenario is not None
    return ScenarioCase(told.vehicle, told.parameters, told.scenario, wanted, told.record)


def _named(figures: Any) -> list[FigureColumn]:
    """Of a function: names, or names with units."""
    if isinstance(figures, str):
        raise TypeError("figures: expected a list")
    named = figures.items() if isinstance(figures, Mapping) else [(one, "") for one in figures]
    columns = [one if isinstance(one, FigureColumn) else FigureColumn(one, unit, one) for one, unit in named]
    if not columns or not all(isinstance(c.name, str) for c in columns):
        raise TypeError("figures: expected the names of what the function returns")
    return columns


def columns_from(told: Sequence[Mapping[str, str]]) -> list[FigureColumn]:
    return [FigureColumn(one["name"], one["unit"], wanted_from(one["wanted"])) for one in told]


def _check_maneuver(vehicle: Vehicle, name: str) -> None:
    known = vehicle.maneuvers()
    if name not in known:
        near = get_close_matches(str(name), list(known), 1)
        hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(known)}"
        raise ValueError(f"there is no maneuver {name!r}{hint}")
    if known[name]["unsupported"]:
        raise ValueError(f"{vehicle.name} cannot do the maneuver {name!r}: {known[name]['unsupported']}")


def plain(what: str, told: Any) -> Any:
    """The same in what JSON has: lists for arrays and tuples."""

    def of_numpy(value: Any) -> Any:
        if isinstance(value, (np.ndarray, np.generic)):
            return value.tolist()
        raise TypeError(f"{what}: {value!r}: expected numbers, texts and lists of them")

    return json.loads(json.dumps(told, default=of_numpy))


def fingerprint(told: Mapping[str, Any]) -> str:
    """A checksum of all that the figures of a study, as a dict, depend on: the files that it names and the version too."""
    text = json.dumps([_core.version, told, _files_in([told["vehicle"], told["scenario"]])], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _files_in(tables: Any) -> dict[str, str]:
    """Checksums of the files that tables name, by path."""
    if isinstance(tables, Mapping):
        tables = list(tables.values())
    if isinstance(tables, list):
        return {path: sum_ for one in tables for path, sum_ in _files_in(one).items()}
    if isinstance(tables, str) and os.path.isabs(tables) and os.path.isfile(tables):
        return {tables: hashlib.sha256(Path(tables).read_bytes()).hexdigest()}
    return {}
