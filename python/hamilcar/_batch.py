"""Many cars of one structure, stepped together."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np

from . import _core
from ._commands import CommandTable
from ._documents import Scenario, Source, Vehicle, as_scenario, as_vehicle
from ._simulation import Channels, ControlTargets
from ._variation import FRICTION, Variation

Which = Union[None, int, Sequence[int], np.ndarray]


@dataclass(frozen=True)
class Start:
    """A car at its start, made by ``Batch.prepare``; ``numbers``: what it has of those that ``vary`` names."""

    _core: _core.Start
    numbers: Mapping[str, float]
    _scenario: Scenario
    _batch: object


class Batch:
    """``count`` cars that share vehicle, scenario and step; each has its own controls, time and, of what ``vary`` names, its own
    numbers. A car has the same bits here as in a Simulation of its own.

    >>> batch = Batch("bmw_323i", 1024, speed=20.0, vary=["chassis.mass_kg"])
    >>> batch.expand("chassis.mass_kg")[:] = np.random.uniform(1100, 1400, 1024)
    >>> batch.reset()
    >>> batch.step(20, steering_wheel=np.linspace(-1, 1, 1024))
    >>> batch["chassis.yaw_rate"]

    ``vary`` names numbers of the vehicle, and ``"road.friction"``. ``threads``: 0 for all of the machine.
    ``precision``: "double", or "single" for twice as many cars a second with seven digits in the place of sixteen. ``tilt_limit``: a car ends when it leans further [rad]; 0 for never. The rest is as in Simulation.
    """

    def __init__(
        self,
        vehicle: Vehicle | Source = "bmw_323i",
        count: int = 1,
        scenario: Scenario | Source | None = None,
        *,
        vary: Iterable[str] = (),
        threads: int = 0,
        precision: str = "double",
        tilt_limit: float = 0.0,
        speed: float | None = None,
        position: tuple[float, float] | None = None,
        yaw: float | None = None,
        friction: float | None = None,
        step: float | None = None,
        integrator: str | None = None,
        powered: bool | None = None,
        energy_balance: bool | None = None,
        controllers: bool | None = None,
        steering_mechanics: bool | None = None,
    ):
        if count < 1:
            raise ValueError(f"count = {count}: expected at least one car")
        if precision not in ("double", "single"):
            raise ValueError(f"precision = {precision!r}: expected 'double' or 'single'")
        self.vehicle = as_vehicle(vehicle)
        self.scenario = as_scenario(
            self.vehicle, scenario, speed=speed, position=position, yaw=yaw, friction=friction, step=step,
            integrator=integrator, powered=powered, energy_balance=energy_balance, controllers=controllers,
            steering_mechanics=steering_mechanics,
        )
        self._variation = Variation(self.vehicle, self.scenario, vary)
        self._varied = {name: np.full(count, value) for name, value in self._variation.nominal.items()}
        self._applied = {name: values.copy() for name, values in self._varied.items()}
        start = self.prepare()
        variants = [self.prepare(changes)._core for changes in self._variation.variants()]
        self._fleet = _core.Fleet([start._core] * count, variants, threads, precision == "single", tilt_limit)
        self._begun = [start] * count
        self._count = count
        self._controls = ControlTargets(self._fleet.controls)
        self._channels = Channels(self._fleet.channels)
        self._command_table = CommandTable(self._fleet.commands)

    def prepare(
        self,
        changes: Mapping[str, Any] | None = None,
        *,
        scenario: Mapping[str, Any] | None = None,
        speed: float | None = None,
        position: tuple[float, float] | None = None,
        yaw: float | None = None,
        friction: float | None = None,
    ) -> Start:
        """A car at its start, for ``reset(which, starts=[...])``: with ``changes`` of what ``vary`` names, of the scenario's start
        and of its road. Made once, in some milliseconds; cars then begin there at no cost."""
        numbers = dict(changes or {})
        if friction is not None:
            numbers[FRICTION] = friction
        for name in numbers:
            if name not in self._varied:
                raise KeyError(f"{name!r} is not varied: name it in Batch(vary=[...])")
        vehicle, own = self._variation.changed(numbers)
        own = as_scenario(
            vehicle, own.changed(scenario or {}), speed=speed, position=position, yaw=yaw, friction=None, step=None,
            integrator=None, powered=None, energy_balance=None,
        )
        return self._made(vehicle, own, numbers)

    def _made(self, vehicle: Vehicle, scenario: Scenario, numbers: Mapping[str, Any]) -> Start:
        told = {name: float(numbers.get(name, value)) for name, value in self._variation.nominal.items()}
        return Start(_core.Start(vehicle._core, scenario._core), told, scenario, self._variation)

    def _prepare_again(self, car: int) -> Start:
        """Where the car began last, with the numbers that it has now."""
        numbers = self._row(car)
        vehicle, _ = self._variation.changed(numbers)
        scenario = self._begun[car]._scenario
        if FRICTION in numbers:
            scenario = scenario.changed({FRICTION: numbers[FRICTION]})
        return self._made(vehicle, scenario, numbers)

    def __len__(self) -> int:
        return self._count

    @property
    def engine(self) -> str:
        """What the program was compiled for: avx512, avx2, sse2 or portable."""
        return self._fleet.engine

    @property
    def step_size(self) -> float:
        return self._fleet.step_size

    @property
    def control_names(self) -> list[str]:
        """The columns of ``step`` and ``rollout``."""
        return list(self._controls.number)

    @property
    def control_info(self) -> dict[str, tuple[str, str, float, float]]:
        """Unit, meaning and range of every control."""
        return dict(self._controls.entries)

    @property
    def command_names(self) -> list[str]:
        """The columns of ``commands`` and ``set_commands``; none without controllers."""
        return list(self._command_table.number)

    @property
    def command_info(self) -> dict[str, tuple[str, str, float, float, float]]:
        """Unit, meaning, value at rest and range of every command."""
        return dict(self._command_table.entries)

    @property
    def commands(self) -> np.ndarray:
        """What the actuators of all cars are told now, ``(n, k)`` with columns ``command_names``; a copy."""
        return self._fleet.command_values()

    def set_commands(self, values: Any, which: Which = None) -> None:
        """Tells actuators of all cars, or of those of a mask or a list, from the next step on: an array ``(n, k)`` with a row for
        each of these cars, or ``(k,)`` for all of them, columns ``command_names``, NaN for one that is left alone; or a dict of
        single ones by name, a number or one for each of these cars. They hold as in Simulation.commands; ``command_info`` has their
        units."""
        cars = self._cars(which)
        self._fleet.set_commands(cars, self._command_table.array(values, len(cars)))

    @property
    def channels(self) -> dict[str, tuple[str, str]]:
        """Unit and meaning of everything that can be read, by its name."""
        return dict(self._channels.entries)

    def _cars(self, which: Which) -> list[int]:
        if which is None:
            return list(range(self._count))
        chosen = np.atleast_1d(np.asarray(which))
        if chosen.dtype == bool:
            if chosen.shape != (self._count,):
                raise ValueError(f"a mask of {chosen.shape}: expected one truth value for each of {self._count} cars")
            return [int(i) for i in np.flatnonzero(chosen)]
        if chosen.size and not np.issubdtype(chosen.dtype, np.integer):
            raise TypeError("expected numbers of cars or a mask")
        if chosen.ndim != 1 or np.any(chosen < 0) or np.any(chosen >= self._count):
            raise IndexError(f"expected numbers of cars from 0 to {self._count - 1}")
        return [int(i) for i in chosen]

    def _targets(self, rows: tuple[int, ...], controls: Any, named: Mapping[str, Any]) -> np.ndarray:
        shape = (*rows, self._count, len(self._controls))
        if controls is not None:
            if named:
                raise TypeError("expected an array of all controls or single ones by their names, not both")
            given = np.asarray(controls, dtype=np.float64)
            if given.shape != shape:
                raise ValueError(f"controls of shape {given.shape}: expected {shape}, columns {self.control_names}")
            return np.ascontiguousarray(given)
        out = np.full(shape, np.nan)
        for name, values in named.items():
            try:
                out[..., self._controls.place(name)] = np.broadcast_to(np.asarray(values, dtype=np.float64), shape[:-1])
            except ValueError as error:
                raise ValueError(f"{name}: expected a number or an array of shape {shape[:-1]}") from error
        return out

    def step(self, steps: int = 1, controls: np.ndarray | None = None, **named: Any) -> None:
        """Steps all cars on, the controls moving to their targets as in Simulation.step: an array ``(n, m)`` with columns
        ``control_names``, NaN for one that is left alone, or single ones by name, a number or one for each car. Cars that have
        ended stay where they are: see ``ended``."""
        self._fleet.step(steps, self._targets((), controls, named))

    def rollout(
        self, controls: np.ndarray, steps: int = 1, record: Iterable[str] = ()
    ) -> dict[str, np.ndarray]:
        """Rows of controls ``(t, n, m)`` one after the other, ``steps`` steps each. Returns each channel of ``record`` after each row,
        ``(t, n)``."""
        given = np.asarray(controls, dtype=np.float64)
        if given.ndim != 3:
            raise ValueError(f"controls of shape {given.shape}: expected (t, {self._count}, {len(self._controls)})")
        names = list(record)
        out = self._fleet.rollout(
            steps, self._targets((given.shape[0],), given, {}), given.shape[0], self._channels.places(names)
        )
        return {name: out[:, :, i] for i, name in enumerate(names)}

    def expand(self, name: str) -> np.ndarray:
        """The number of every car, of one that ``vary`` names: an array ``(n,)`` to write to. A car takes it at its next reset."""
        if name not in self._varied:
            raise KeyError(f"{name!r} is not varied: name it in Batch(vary=[...])")
        return self._varied[name]

    def vehicle_of(self, car: int) -> Vehicle:
        """The vehicle that a car has after its next reset."""
        return self._variation.changed(self._row(car))[0]

    def _row(self, car: int) -> dict[str, float]:
        return {name: float(values[car]) for name, values in self._varied.items()}

    def reset(self, which: Which = None, starts: Start | Sequence[Start] | None = None) -> None:
        """Cars are again at their start, at time 0 of their own, with the numbers that ``expand`` holds; all of them, or those of
        a mask or a list. ``starts``: where they begin instead, and with which numbers, from then on; one for each car or one for
        all."""
        cars = self._cars(which)
        if starts is not None:
            return self._begin(cars, [starts] * len(cars) if isinstance(starts, Start) else list(starts))
        changed: list[int] = []
        same: list[int] = []
        for car in cars:
            differs = any(values[car] != self._applied[name][car] for name, values in self._varied.items())
            (changed if differs else same).append(car)
        self._begin(changed, [self._prepare_again(car) for car in changed])
        self._fleet.restart(same)

    def _begin(self, cars: list[int], starts: list[Start]) -> None:
        if len(starts) != len(cars):
            raise ValueError(f"{len(starts)} starts: expected one for each of {len(cars)} cars")
        if not all(isinstance(start, Start) for start in starts):
            raise TypeError("starts: expected what Batch.prepare made")
        if not all(start._batch is self._variation for start in starts):
            raise ValueError("starts: expected those that this batch prepared, found another's")
        self._fleet.replace(cars, [start._core for start in starts])  # all of them or none
        for car, start in zip(cars, starts):
            self._begun[car] = start
        for name, values in self._varied.items():
            values[cars] = [start.numbers[name] for start in starts]
            self._applied[name][cars] = values[cars]

    def __getitem__(self, channel: str) -> np.ndarray:
        return self._fleet.values(self._channels.places([channel]))[:, 0]

    def read(self, channels: Iterable[str]) -> np.ndarray:
        """Channels of all cars, ``(n, c)``."""
        return self._fleet.values(self._channels.places(channels))

    @property
    def states(self) -> np.ndarray:
        """Everything that is integrated, ``(n, s)``; a copy. Of a car that has ended the last good state."""
        return self._fleet.states()

    @property
    def times(self) -> np.ndarray:
        """Of each car since its own start [s]."""
        return self._fleet.times()

    @property
    def ended(self) -> np.ndarray:
        """Which cars cannot go on until they are reset."""
        return np.array(self._fleet.ended(), dtype=bool)

    def why(self, car: int) -> str:
        """Why a car has ended, or ""."""
        return self._fleet.why(self._cars(car)[0])

    def save(self, which: Which = None) -> list[_core.Snapshot]:
        """Places in the runs of these cars, to come back to."""
        return self._fleet.save(self._cars(which))

    def restore(self, snapshots: Sequence[_core.Snapshot], which: Which = None) -> None:
        """Cars go back to where they, or others with the same numbers, once were."""
        self._fleet.restore(self._cars(which), list(snapshots))

    def __repr__(self) -> str:
        return f"<hamilcar.Batch of {self._count} {self.vehicle.name!r}>"
