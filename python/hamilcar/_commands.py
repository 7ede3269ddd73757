"""Controllers of a car, and the commands that its actuators take."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches
from typing import Any

import numpy as np

from . import _core


def _unknown(name: str, known: Iterable[str], what: str, otherwise: str) -> KeyError:
    near = get_close_matches(name, list(known), 1)
    return KeyError(f"{name!r} is no {what} of this car" + (f"; did you mean {near[0]!r}?" if near else otherwise))


class CommandTable:
    """Names of commands to rows of numbers, NaN where one is left alone."""

    def __init__(self, commands: list[tuple[str, str, str, float, float, float]]):
        self.entries = {name: (unit, meaning, rest, low, high) for name, unit, meaning, rest, low, high in commands}
        self.number = {name: i for i, name in enumerate(self.entries)}

    def __len__(self) -> int:
        return len(self.number)

    def expect_some(self) -> None:
        if not self.number:
            raise KeyError(
                'this car takes no commands: expected a [[controller]] in the vehicle, kind = "external" to set them from outside,'
                " and actuators for it"
            )

    def place(self, name: str) -> int:
        self.expect_some()
        if name not in self.number:
            raise _unknown(name, self.number, "command", "; command_info has their names")
        return self.number[name]

    def rows(self, values: Mapping[str, Any], shape: tuple[int, ...] = ()) -> np.ndarray:
        """``(*shape, k)`` of numbers or arrays of that shape by their names."""
        self.expect_some()
        out = np.full((*shape, len(self)), np.nan)
        for name, value in values.items():
            place = self.place(name)
            expected = f"{name}: expected a number" + (f" or an array of shape {shape}" if shape else "")
            try:
                numbers = np.broadcast_to(np.asarray(value, dtype=np.float64), shape)
            except (TypeError, ValueError) as error:
                raise type(error)(expected) from error
            if np.isnan(numbers).any():
                raise ValueError(f"{expected}, not a NaN")
            out[..., place] = numbers
        return out

    def array(self, values: Any, count: int) -> np.ndarray:
        """``(count, k)`` of an array ``(count, k)`` or ``(k,)``, or of what ``rows`` takes."""
        if isinstance(values, Mapping):
            return self.rows(values, (count,))
        self.expect_some()
        given = np.asarray(values, dtype=np.float64)
        if given.shape not in ((count, len(self)), (len(self),)):
            shapes = f"{(count, len(self))} or {(len(self),)}"
            raise ValueError(f"commands of shape {given.shape}: expected {shapes}, a column for each of command_names")
        return np.ascontiguousarray(np.broadcast_to(given, (count, len(self))))


class Commands(Mapping):
    """What the actuators of a car are told, by name: see ``Simulation.commands``."""

    def __init__(self, car: _core.Car, table: CommandTable):
        self._car = car
        self._table = table

    def __getitem__(self, name: str) -> float:
        return float(self._car.command_values()[self._table.place(name)])

    def __setitem__(self, name: str, value: float) -> None:
        self.update({name: value})

    def update(self, values: Mapping[str, float]) -> None:
        """Several at once, all of them or, where one is refused, none."""
        self._car.set_commands(self._table.rows(values))

    def __iter__(self) -> Iterator[str]:
        return iter(self._table.number)

    def __len__(self) -> int:
        return len(self._table)

    def __repr__(self) -> str:
        return repr(dict(self))


class Controllers(Mapping):
    """Which controllers of a car are on, by keyword: see ``Simulation.controllers``."""

    def __init__(self, car: _core.Car):
        self._car = car
        self._number = {keyword: i for i, keyword in enumerate(car.controllers)}

    def _place(self, keyword: str) -> int:
        if keyword not in self._number:
            known = f": expected one of {', '.join(self._number)}" if self._number else ": it has none"
            raise _unknown(keyword, self._number, "controller", known)
        return self._number[keyword]

    def __getitem__(self, keyword: str) -> bool:
        return self._car.controller_is_on(self._place(keyword))

    def __setitem__(self, keyword: str, on: bool) -> None:
        place = self._place(keyword)
        if not isinstance(on, (bool, np.bool_)):
            raise TypeError(f"controllers[{keyword!r}] = {on!r}: expected True or False")
        self._car.switch_controller(place, bool(on))

    def __iter__(self) -> Iterator[str]:
        return iter(self._number)

    def __len__(self) -> int:
        return len(self._number)

    def __repr__(self) -> str:
        return repr(dict(self))
