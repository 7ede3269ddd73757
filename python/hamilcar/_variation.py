"""Numbers in which cars of one program may differ."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from ._documents import Scenario, Vehicle
from ._errors import InputError

FRICTION = "road.friction"  # the only number of the scenario among them


class Variation:
    """Names of numbers, their values in vehicle and scenario, and cars with others."""

    def __init__(self, vehicle: Vehicle, scenario: Scenario, names: Iterable[str]):
        if isinstance(names, str):
            raise TypeError("expected a list of names, not a text")
        self.vehicle = vehicle
        self.scenario = scenario
        self.nominal = {name: self._value(name) for name in names}
        self._numbers = vehicle.numbers() if self.nominal else {}

    def _value(self, name: str) -> float:
        if name != FRICTION:
            return float(self.vehicle[name])
        said = self.scenario.numbers().get(name)
        return said.value if said else 1.0

    def limits(self, name: str) -> tuple[float, float]:
        """What the reader of the file takes."""
        about = self._numbers.get(name)
        return (about.min, about.max) if about else (0.0, float("inf")) if name == FRICTION else (-float("inf"), float("inf"))

    def variants(self) -> list[dict[str, float]]:
        """Changes in all of them, each by shares of its own, so that a program takes from each car whatever number of the model moves
        with one of them, if only in its last digits."""
        if not self.nominal:
            return []
        out = []
        for size in (1, -1, 3.7, -2.3):
            changes: dict[str, float] = {}
            for i, (name, value) in enumerate(self.nominal.items()):
                about = self._numbers.get(name)
                if about is not None and about.is_whole:
                    raise ValueError(f"{name} counts something: cars of one program share it")
                share = size * 0.01 * (1 + 0.37 * i / (1 + i))
                other = value * (1 + share) if value != 0 else share
                low, high = self.limits(name)
                changes[name] = other if low <= other <= high else value
                try:
                    self.changed({name: changes[name]})
                except InputError as error:
                    raise ValueError(f"{name} cannot vary by itself: others must fit to it ({error})") from error
            out.append(changes)
        return out

    def changed(self, changes: Mapping[str, Any]) -> tuple[Vehicle, Scenario]:
        """Vehicle and scenario with other numbers."""
        of_road = {name: value for name, value in changes.items() if name == FRICTION}
        others = {name: value for name, value in changes.items() if name != FRICTION}
        return (
            self.vehicle.changed(others) if others else self.vehicle,
            self.scenario.changed(of_road) if of_road else self.scenario,
        )
