"""Parameters of a study: what is varied, from where to where, in the unit of its key."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from difflib import get_close_matches
from math import isfinite
from typing import Any

import numpy as np

from .._documents import Scenario, Vehicle
from .._errors import InputError

_SPAN = re.compile(r"(-?\d[\d.e+-]*) to (-?\d[\d.e+-]*)")


@dataclass(frozen=True)
class Parameter:
    """A number that a study varies from ``min`` to ``max``.

    ``name`` is a key of the vehicle (``"chassis.mass_kg"``), of the scenario (``"scenario.road.friction"``) or a setting of the
    maneuver (``"maneuver.speed"``). ``keys``: several such keys that all get the value, under a free name. ``unit`` is that of the
    key; where it is given it is compared with that. ``whole``: it counts something, so that designs round it.
    """

    name: str
    min: float
    max: float
    unit: str = ""
    keys: tuple[str, ...] = ()
    whole: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name:
            raise TypeError(f"a parameter's name = {self.name!r}: expected a text")
        if isinstance(self.keys, str):
            raise TypeError(f"{self.name}: keys = {self.keys!r}: expected a list of keys, not a text")
        object.__setattr__(self, "keys", tuple(self.keys) or (self.name,))
        for end in ("min", "max"):
            value = getattr(self, end)
            try:
                object.__setattr__(self, end, float(value))
            except (TypeError, ValueError) as error:
                raise TypeError(f"{self.name}: {end} = {value!r}: expected a number") from error
        if not (isfinite(self.min) and isfinite(self.max) and self.min < self.max):
            raise ValueError(f"{self.name} from {self.min:g} to {self.max:g}: expected min < max, both finite")

    def to_dict(self) -> dict[str, Any]:
        return {**asdict(self), "keys": list(self.keys)}


@dataclass(frozen=True)
class _Permitted:
    """What a key takes."""

    unit: str = ""
    min: float = -float("inf")
    max: float = float("inf")
    min_included: bool = True
    whole: bool = False

    def takes(self, value: float) -> bool:
        return (value >= self.min if self.min_included else value > self.min) and value <= self.max

    def __str__(self) -> str:
        low = f"{self.min:g}" if self.min_included else f"more than {self.min:g}"
        return f"{low} to {self.max:g} [{self.unit or 1}]"


def owner_of(key: str) -> tuple[str, str]:
    """Whose key it is, "vehicle", "scenario" or "maneuver", and the key there."""
    for owner in ("scenario", "maneuver"):
        if key.startswith(owner + "."):
            return owner, key[len(owner) + 1 :]
    return "vehicle", key


def _permitted_by_document(document: Vehicle | Scenario, key: str, parameter: Parameter) -> _Permitted:
    numbers = document.numbers()
    if key in numbers:
        about = numbers[key]
        return _Permitted(about.unit, about.min, about.max, about.min_included, about.is_whole)
    for value in (parameter.min, parameter.max):  # keys that a file may have and this one leaves out
        try:
            document.changed({key: value})
        except InputError as error:
            raise InputError(f"parameter {parameter.name!r}: {error}", 3, key) from error
    return _Permitted()


def _permitted_by_maneuver(vehicle: Vehicle, maneuver: str, key: str) -> _Permitted:
    settings = vehicle.maneuvers()[maneuver]["settings"]
    if key not in settings:
        near = get_close_matches(key, list(settings), 1)
        hint = f"; did you mean 'maneuver.{near[0]}'?" if near else f": expected one of {', '.join(settings)}"
        raise InputError(f"the maneuver {maneuver!r} has no setting {key!r}{hint}", 3, key)
    span = settings[key]["range"]
    found = _SPAN.search(span)
    if not found:
        raise InputError(f"maneuver.{key} is one of {span}: expected a setting that is a number", 3, key)
    return _Permitted(settings[key]["unit"], float(found[1]), float(found[2]), whole=span.startswith("a whole number"))


def resolved(parameter: Parameter, vehicle: Vehicle, scenario: Scenario | None, maneuver: str | None) -> Parameter:
    """The same with its key's unit. Raises InputError for keys that are none and for ends that the key does not take."""
    for name in parameter.keys:
        owner, key = owner_of(name)
        if owner == "vehicle":
            permitted = _permitted_by_document(vehicle, key, parameter)
        elif owner == "scenario":
            if scenario is None:
                raise InputError(f"{name}: this study has no scenario", 3, name)
            permitted = _permitted_by_document(scenario, key, parameter)
        else:
            if maneuver is None:
                raise InputError(f"{name}: this study drives no maneuver", 3, name)
            permitted = _permitted_by_maneuver(vehicle, maneuver, key)
        if parameter.unit and permitted.unit and parameter.unit != permitted.unit:
            raise InputError(f"{parameter.name} in {parameter.unit!r}: expected {permitted.unit!r}, the unit of {name}", 3, name)
        if not (permitted.takes(parameter.min) and permitted.takes(parameter.max)):
            raise InputError(f"{parameter.name} from {parameter.min:g} to {parameter.max:g}: {name} takes {permitted}", 3, name)
        parameter = replace(
            parameter, unit=parameter.unit or permitted.unit, whole=parameter.whole or permitted.whole
        )
    return parameter


def check_names(parameters: Iterable[Parameter | Mapping[str, Any]]) -> tuple[Parameter, ...]:
    """Parameters, made of dicts where they are such; each name and each key once."""
    if isinstance(parameters, (str, Mapping)):
        raise TypeError("parameters: expected a list of Parameter")
    made = []
    for one in parameters:
        if not isinstance(one, (Parameter, Mapping)):
            raise TypeError(f"parameters: expected Parameter(name, min, max), not {one!r}")
        made.append(one if isinstance(one, Parameter) else Parameter(**one))
    if not made:
        raise ValueError("parameters: expected at least one")
    for what in ([p.name for p in made], [key for p in made for key in p.keys]):
        twice = {name for name in what if what.count(name) > 1}
        if twice:
            raise ValueError(f"{sorted(twice)[0]!r} is varied twice")
    return tuple(made)


def check_points(X: Any, parameters: Sequence[Parameter]) -> np.ndarray:
    """``X`` as an array ``(n, d)`` of floats, a column for each parameter. Ranges are those of designs: points may lie beyond."""
    given = np.asarray(X, dtype=np.float64)
    if given.ndim != 2 or given.shape[1] != len(parameters):
        names = ", ".join(p.name for p in parameters)
        raise ValueError(f"X of shape {given.shape}: expected (n, {len(parameters)}), columns {names}")
    if not np.isfinite(given).all():
        row, column = (int(i) for i in np.argwhere(~np.isfinite(given))[0])
        raise ValueError(f"X[{row}, {column}] = {given[row, column]}: expected a finite {parameters[column].name}")
    return np.ascontiguousarray(given)


def values_by_owner(parameters: Sequence[Parameter], point: np.ndarray) -> dict[str, dict[str, Any]]:
    """What a point ``(d,)`` sets of the vehicle, of the scenario and of the maneuver, by key."""
    out: dict[str, dict[str, Any]] = {"vehicle": {}, "scenario": {}, "maneuver": {}}
    for parameter, value in zip(parameters, point):
        number = float(value)
        for name in parameter.keys:
            owner, key = owner_of(name)
            out[owner][key] = int(number) if parameter.whole and number.is_integer() else number
    return out
