"""Vehicles and scenarios: the tables that people write, every number by its name."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from math import degrees
from pathlib import Path
from typing import Any, Union

from . import _core
from ._drawing import svg_of_scene
from ._errors import AccessError

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def _shipped(folder: str) -> list[str]:
    place = _core.find_shipped(folder)
    return sorted(path.stem for path in Path(place).glob("*.toml")) if place else []


def shipped_vehicles() -> list[str]:
    """Names of the vehicles that come with hamilcar."""
    return _shipped("vehicles")


def shipped_scenarios() -> list[str]:
    """Names of the scenarios that come with hamilcar."""
    return _shipped("scenarios")


def _path_of(source: Union[str, "os.PathLike[str]"], folder: str) -> str:
    text = os.fspath(source)
    if os.path.isfile(text):
        return text
    if shipped := _core.find_shipped(f"{folder}/{text}.toml"):
        return os.path.abspath(shipped)
    if os.sep in text or text.endswith(".toml"):
        return text  # whose reader says that it is not there
    near = get_close_matches(text, _shipped(folder), 1)
    hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(_shipped(folder))}, or a path"
    raise AccessError(f"there is no {folder[:-1]} {text!r}{hint}", 5)


class _Document:
    """Tables of a TOML file. A key goes by dots, lists by the names of their items or by numbers from 0 on:
    ``"axle.front.spring.rate_N_per_m"``; its unit is part of it. A value that is invalid is refused with the message that the
    file would get, and nothing is changed then.
    """

    _folder = ""
    _made: Any = None

    def __init__(self, source: Source | "_Document", changes: Mapping[str, Any] | None = None):
        changes = dict(changes or {})
        if isinstance(source, _Document):
            if type(source) is not type(self):
                raise TypeError(f"expected a {type(self).__name__.lower()}, not a {type(source).__name__.lower()}")
            self._core = source._core.copy()
            if changes:
                self._core.set(changes)
        elif isinstance(source, Mapping):
            self._core = self._made.from_dict(dict(source), type(self).__name__)
            if changes:
                self._core.set(changes)
        elif isinstance(source, (str, os.PathLike)):
            self._core = self._made.from_file(_path_of(source, self._folder), changes)
        else:
            raise TypeError(f"expected a name, a path or a dict, not {type(source).__name__}")

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def source(self) -> str:
        """The file that it was read from, or ""."""
        return self._core.source

    def __getitem__(self, key: str) -> Any:
        return self._core.get(key)

    def __setitem__(self, key: str, value: Any) -> None:
        self._core.set({key: value})

    def update(self, changes: Mapping[str, Any]) -> None:
        """Several values at once: all of them, or none if together they are invalid."""
        self._core.set(dict(changes))

    def changed(self, changes: Mapping[str, Any]) -> "_Document":
        """A copy with other values; this one stays as it is."""
        return type(self)(self, changes)

    def numbers(self, prefix: str = "") -> dict[str, _core.NamedNumber]:
        """Every number by its name, with ``value``, ``unit``, ``min``, ``max`` and ``meaning``; those that the file leaves out
        have their default and ``is_default``."""
        return {one.name: one for one in self._core.numbers() if one.name.startswith(prefix)}

    def to_dict(self) -> dict[str, Any]:
        """The tables, as a dict that makes the same again; paths of files in it are absolute."""
        tables = self._core.tables()
        return _anchored(tables, Path(self.source).resolve().parent) if self.source else tables

    def __iter__(self) -> Iterator[str]:
        return iter(self.to_dict())

    def __copy__(self) -> "_Document":
        return type(self)(self)

    def __deepcopy__(self, memo: Any) -> "_Document":
        return type(self)(self)

    def __reduce__(self) -> Any:
        return type(self), (self.to_dict(),)

    def __repr__(self) -> str:
        return f"hamilcar.{type(self).__name__}({self.name!r})"


def _anchored(tables: Any, folder: Path) -> Any:
    """Paths of files are relative to the file that they stand in; without it they need its folder."""
    if isinstance(tables, list):
        return [_anchored(one, folder) for one in tables]
    if not isinstance(tables, dict):
        return tables
    out = {}
    for key, value in tables.items():
        is_path = isinstance(value, str) and (key == "file" or key.endswith("_file") or key == "vehicle")
        out[key] = str(folder / value) if is_path and (folder / value).exists() else _anchored(value, folder)
    return out


class Vehicle(_Document):
    """A vehicle: from the name of one that comes with hamilcar, a file, a dict or another vehicle.

    >>> car = Vehicle("bmw_323i", {"chassis.mass_kg": 1300.0})
    >>> car["chassis.mass_kg"] = 1400.0
    """

    _folder = "vehicles"
    _made = _core.VehicleDocument

    def __init__(self, source: Source | "Vehicle" = "bmw_323i", changes: Mapping[str, Any] | None = None):
        super().__init__(source, changes)

    @property
    def wheels(self) -> list[str]:
        return self._core.wheels

    @property
    def total_mass(self) -> float:
        """Of everything, trailers too [kg]."""
        return self._core.total_mass

    @property
    def is_powered(self) -> bool:
        """Whether it has power units, so that throttle and gears can be used."""
        return self._core.is_powered

    @property
    def channels(self) -> dict[str, tuple[str, str]]:
        """Unit and meaning of everything that can be recorded, by its name."""
        return {name: (unit, meaning) for name, unit, meaning, _ in self._core.channels()}

    def maneuvers(self) -> dict[str, dict[str, Any]]:
        """The standard maneuvers, with the settings that this vehicle drives them with."""
        out = {}
        for name, title, standard, summary, reason, settings in _core.maneuvers(self._core):
            chosen = {
                s: {"default": default, "unit": unit, "meaning": meaning, "range": span}
                for s, unit, meaning, default, span in settings
            }
            out[name] = {
                "title": title, "standard": standard, "summary": summary, "unsupported": reason, "settings": chosen,
            }
        return out

    def scene(self) -> dict[str, Any]:
        """Frames, links and wheels at design, as pages draw them; points in vehicle axes [m]."""
        return json.loads(self._core.scene())

    def _repr_html_(self) -> str:
        return (
            f"<div><b>{self.name}</b> &middot; {self.total_mass:.0f} kg &middot; {len(self.wheels)} wheels</div>"
            + svg_of_scene(self.scene())
        )


class Scenario(_Document):
    """A scenario: road, start, inputs or a driver, and what is recorded; from a file or a dict."""

    _folder = "scenarios"
    _made = _core.ScenarioDocument

    @property
    def vehicle(self) -> str:
        """Path of the vehicle's file."""
        return self._core.vehicle

    @property
    def step(self) -> float:
        """Of the integration [s]."""
        return self._core.step

    @property
    def duration(self) -> float:
        return self._core.duration


def as_vehicle(vehicle: Vehicle | Source) -> Vehicle:
    return vehicle if isinstance(vehicle, Vehicle) else Vehicle(vehicle)


def as_scenario(
    vehicle: Vehicle,
    scenario: Scenario | Source | None,
    *,
    speed: float | None,
    position: tuple[float, float] | None,
    yaw: float | None,
    friction: float | None,
    step: float | None,
    integrator: str | None,
    powered: bool | None,
    energy_balance: bool | None,
    controllers: bool | None = None,
    steering_mechanics: bool | None = None,
) -> Scenario:
    """The scenario with what was asked for beside it; without one: a plane, straight ahead."""
    if scenario is None:
        size = 1e-3 if step is None else step
        tables: dict[str, Any] = {
            "name": "Python",
            "vehicle": vehicle.source or "vehicle",
            "duration_s": 9e8 * size,
            "solver": {"step_s": size},
        }
        if powered is None:
            powered = vehicle.is_powered
        if powered:
            tables["inputs"] = {"throttle": {"pedal": 0.0}}
            tables["driver"] = {"gear": {}}
        scenario = Scenario(tables)
    else:
        if powered is not None:
            raise TypeError("powered: a scenario says by its inputs and its driver whether power units run")
        scenario = Scenario(scenario)
    changes: dict[str, Any] = {}
    if speed is not None:
        changes["initial.velocity_m_per_s"] = speed
    if position is not None:
        changes["initial.position_m"] = list(position)
    if yaw is not None:
        changes["initial.yaw_deg"] = degrees(yaw)
    if friction is not None:
        changes["road.friction"] = friction
    if step is not None:
        changes["solver.step_s"] = step
    if integrator is not None:
        changes["solver.integrator"] = integrator
    if energy_balance is not None:
        changes["solver.energy_balance"] = energy_balance
    if controllers is not None:
        if not isinstance(controllers, bool):
            raise TypeError(f"controllers = {controllers!r}: expected True or False; controllers_off in a scenario names them")
        changes["controllers_off"] = [] if controllers else ["all"]
    if steering_mechanics is not None:
        changes["steering_mechanics"] = steering_mechanics
    if changes:
        scenario.update(changes)
    return scenario
