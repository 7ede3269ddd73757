"""One car, step by step."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import Any

import numpy as np

from . import _core
from ._commands import Commands, CommandTable, Controllers
from ._documents import Scenario, Source, Vehicle, as_scenario, as_vehicle
from ._results import channel_error


class ControlTargets:
    """Names of controls to rows of numbers, NaN where one is left alone."""

    def __init__(self, controls: list[tuple[str, str, str, float, float]]):
        self.entries = {name: (unit, meaning, low, high) for name, unit, meaning, low, high in controls}
        self.number = {name: i for i, name in enumerate(self.entries)}

    def __len__(self) -> int:
        return len(self.number)

    def place(self, name: str) -> int:
        if name in self.number:
            return self.number[name]
        near = get_close_matches(name, list(self.number), 1)
        hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(self.number)}"
        raise TypeError(f"this car has no control {name!r}{hint}")

    def row(self, targets: Mapping[str, float]) -> np.ndarray:
        out = np.full(len(self), np.nan)
        for name, value in targets.items():
            number = float(value)
            if number != number:
                raise ValueError(f"{name}: expected a number, not a NaN")
            out[self.place(name)] = number
        return out


class Channels:
    """Names of channels to their numbers."""

    def __init__(self, channels: list[tuple[str, str, str, bool]]):
        self.entries = {name: (unit, meaning) for name, unit, meaning, _ in channels}
        self.number = {name: i for i, name in enumerate(self.entries)}

    def places(self, names: Iterable[str]) -> list[int]:
        if isinstance(names, str):
            raise TypeError("expected a list of channels, not a text")
        out = []
        for name in names:
            if name not in self.number:
                raise channel_error(name, self.number)
            out.append(self.number[name])
        return out


class Simulation:
    """One car that is stepped by hand, with controls as numbers.

    Without a scenario it stands on an endless plane and rolls ahead at ``speed`` [m/s] (0 if left out); ``friction`` is the road's
    factor, ``step`` that of the integration [s], ``position`` where the vehicle's origin is on the ground [m] and ``yaw`` its
    heading [rad]. A vehicle with power units has a throttle and changes its gears by itself unless ``powered=False``, then a torque
    at the wheels drives it. ``energy_balance=False`` saves a tenth of a step and the channels of energy. ``controllers=False`` leaves
    all controllers out of the car, True keeps all that the vehicle has, whatever the scenario says. With ``steering_mechanics=True``
    the rack moves on its own and hands hold the steering wheel: controls ``hands`` and ``steering_torque`` [N m] are there then.

    >>> simulation = Simulation("bmw_323i", speed=20.0)
    >>> simulation.step(20, steering_wheel=0.3)
    >>> simulation["chassis.yaw_rate"]
    """

    def __init__(
        self,
        vehicle: Vehicle | Source = "bmw_323i",
        scenario: Scenario | Source | None = None,
        *,
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
        self.vehicle = as_vehicle(vehicle)
        self.scenario = as_scenario(
            self.vehicle, scenario, speed=speed, position=position, yaw=yaw, friction=friction, step=step,
            integrator=integrator, powered=powered, energy_balance=energy_balance, controllers=controllers,
            steering_mechanics=steering_mechanics,
        )
        self._car = _core.Car(self.vehicle._core, self.scenario._core)
        self._controls = ControlTargets(self._car.controls)
        self._channels = Channels(self._car.channels)
        self._command_table = CommandTable(self._car.commands)
        self._commands = Commands(self._car, self._command_table)
        self._controllers = Controllers(self._car)

    @property
    def time(self) -> float:
        """Since the start [s]."""
        return self._car.time

    @property
    def steps_taken(self) -> int:
        return self._car.steps_taken

    @property
    def step_size(self) -> float:
        return self._car.step_size

    @property
    def controls(self) -> dict[str, float]:
        """Where the controls are now; ``control_info`` has their units and ranges."""
        return dict(zip(self._controls.number, self._car.control_values()))

    @property
    def control_info(self) -> dict[str, tuple[str, str, float, float]]:
        """Unit, meaning and range of every control."""
        return dict(self._controls.entries)

    @property
    def commands(self) -> Commands:
        """What actuators are told, by the names of the channels without ``command.``:
        ``commands["front_left.brake.inlet"] = 0.0``. One that is set holds from the next step on, until it is set anew or one of
        the car's controllers changes it; ``update`` sets several at once. Without controllers there are none; with
        ``kind = "external"`` alone nothing in the car changes them. ``command_info`` has their units and ranges."""
        return self._commands

    @property
    def command_info(self) -> dict[str, tuple[str, str, float, float, float]]:
        """Unit, meaning, value at rest and range of every command."""
        return dict(self._command_table.entries)

    @property
    def controllers(self) -> Controllers:
        """Which of the car's controllers are on, by their keywords, in the order in which they decide. ``controllers["esc"] = False``
        switches one off: it forgets what it knew, and all commands go to rest until the others ask anew, at their next decisions.
        How much each intervenes is a channel, ``"esc.activity"``."""
        return self._controllers

    @property
    def channels(self) -> dict[str, tuple[str, str]]:
        """Unit and meaning of everything that can be read, by its name."""
        return dict(self._channels.entries)

    @property
    def ended(self) -> str | None:
        """Which ending of the scenario's driver came true; further steps do nothing then."""
        return self._car.ending

    @property
    def warnings(self) -> list[str]:
        return self._car.warnings

    def step(self, steps: int = 1, **controls: float) -> None:
        """Steps on while the named controls move to their targets, reached at the end of these steps: the steering from
        rest to rest, so that the rack's velocity never jumps, pedals evenly, a gear at once. A control that is not
        named stays where it is or, if it never was named, follows the scenario. Raises NumericalError where the car cannot go
        on; it stands at its last good state then.
        """
        self._car.step(steps, self._controls.row(controls))

    def __getitem__(self, channel: str) -> float:
        return float(self._car.values(self._channels.places([channel]))[0])

    def read(self, channels: Iterable[str]) -> np.ndarray:
        """Several channels at once, in that order; they share what they are computed from."""
        return self._car.values(self._channels.places(channels))

    @property
    def state(self) -> np.ndarray:
        """Everything that is integrated; a copy. ``state_names`` says what each number is."""
        return self._car.state()

    @property
    def state_names(self) -> list[str]:
        """Of the numbers of ``state``; in SI units and radians."""
        return self._car.state_names()

    def save(self) -> _core.Snapshot:
        """This place in the run, to come back to; controls, commands, what controllers remember and the method's memory too."""
        return self._car.save()

    def restore(self, snapshot: _core.Snapshot) -> None:
        """Goes back; the same steps from there give the same bits."""
        self._car.restore(snapshot)

    def reset(self) -> None:
        """Back to the start, with all controllers on and commands at rest."""
        self._car.reset()

    def __repr__(self) -> str:
        return f"<hamilcar.Simulation of {self.vehicle.name!r} at {self.time:g} s>"

    def _repr_html_(self) -> str:
        return f"<div>at {self.time:g} s</div>" + self.vehicle._repr_html_()
