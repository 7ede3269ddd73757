"""What a task is: a start, actions, observations, a reward and endings, for all cars at once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import Scenario, Vehicle
from ._randomization import Spread


@dataclass(frozen=True)
class Quantity:
    """An entry of the observation, in SI units and radians, held within ``low`` and ``high``; or one of the action, where -1 and 1
    mean ``low`` and ``high``."""

    name: str
    unit: str
    low: float
    high: float
    meaning: str


TIRE_RADIUS = 0.3  # by which a power is a torque at the wheels [m]
MOTION = (
    "chassis.position.x", "chassis.position.y", "chassis.angle.yaw",
    "chassis.speed", "chassis.lateral_speed", "chassis.yaw_rate",
)
SPEED = Quantity("speed", "m/s", 0.0, 40.0, "of the center of mass, along the heading")
LATERAL_SPEED = Quantity("lateral speed", "m/s", -5.0, 5.0, "of the center of mass, to the left")
YAW_RATE = Quantity("yaw rate", "rad/s", -1.5, 1.5, "to the left")


class Task:
    """Base of all tasks. A task holds the numbers of all its cars as arrays (n,); the environment makes a copy of it for itself.

    A step of the environment calls ``controls``, steps the cars, then ``update``, ``judge`` and ``observe``. ``update`` computes
    what follows from the channels and gives the same when it is called again; ``judge`` is called once a step and may remember.
    Where cars begin, ``begin``, ``update`` and ``started`` are called. A new task names ``channels``, ``observations`` and
    ``actions`` and overrides the methods below.
    """

    vehicle: Vehicle | str = "bmw_323i"
    scenario: Scenario | Mapping[str, Any] | None = None
    max_episode_steps = 500
    penalty = 10.0  # taken from the reward where a car ends badly
    tilt_limit = 0.6  # a car that leans further has rolled over [rad]
    randomize: Mapping[str, Spread] = {}
    channels: tuple[str, ...] = MOTION
    observations: tuple[Quantity, ...] = ()
    actions: tuple[Quantity, ...] = ()
    endings: tuple[str, ...] = ()  # reasons why episodes end before their time, numbered from 1 in ``judge``
    good_endings: tuple[str, ...] = ()
    draws = 0  # how many uniform numbers the start of an episode takes
    steering_rate = 12.0  # of the steering wheel at most [rad/s]
    torque = 1600.0  # at the driven wheels together, at most [N m]
    power = 100e3  # of the drive, at most [W]

    def start(self, random: np.random.Generator, number: int) -> dict[str, Any]:
        """Arguments of ``Batch.prepare`` for start ``number`` of the bank."""
        return {"speed": 20.0}

    def bind(self, car: Mapping[str, np.ndarray], columns: Mapping[str, int], period: float) -> None:
        """``car``: rows (n,) of the channels, in SI units and radians, that always hold the newest values; ``columns``: of the
        controls in what ``controls`` fills; ``period``: of control [s]."""
        self.car, self.columns, self.period = car, columns, period
        self.count = len(next(iter(car.values())))
        self.wheel = np.zeros(self.count)
        self.wheel_move = np.zeros(self.count)

    def begin(self, cars: np.ndarray, draws: np.ndarray) -> None:
        """Cars (m,), whose channels are those of their start already, begin an episode with ``draws`` (draws, m) from 0 to 1."""
        self.wheel[cars] = 0.0
        self.wheel_move[cars] = 0.0

    def started(self, cars: np.ndarray) -> None:
        """Cars (m,) have begun and ``update`` knows where: remembers what a first step is measured against."""

    def controls(self, actions: np.ndarray, out: np.ndarray) -> None:
        """From actions (k, n) from -1 to 1 to controls ``out`` (n, m)."""
        raise NotImplementedError

    def update(self) -> None:
        """Computes what rewards and observations need from the channels."""

    def judge(self, rewards: np.ndarray, endings: np.ndarray) -> None:
        """Writes rewards (n,), and to ``endings`` (n,), which holds zeros, the numbers of endings."""
        raise NotImplementedError

    def observe(self, out: np.ndarray) -> None:
        """Writes the rows (o, n) of ``observations``."""
        raise NotImplementedError

    def succeeded(self, endings: np.ndarray) -> np.ndarray:
        """Which cars (n,) did what was asked, asked at the end of episodes."""
        good = np.array([False] + [ending in self.good_endings for ending in self.endings] + [False])
        return good[endings]

    # What tasks share

    def turn_wheel(self, target: np.ndarray, out: np.ndarray) -> None:
        """The steering wheel goes to ``target`` (n,) [rad] as far as ``steering_rate`` lets it."""
        reach = self.steering_rate * self.period
        np.clip(target - self.wheel, -reach, reach, out=self.wheel_move)
        self.wheel += self.wheel_move
        out[:, self.columns["steering_wheel"]] = self.wheel

    def push_pedals(self, action: np.ndarray, out: np.ndarray) -> None:
        """One pedal (n,) from full brake at -1 to the most drive at 1: ``torque`` or, when that is less, what ``power`` gives at
        this speed."""
        limit = np.minimum(self.torque, self.power * TIRE_RADIUS / np.maximum(self.car["chassis.speed"], 1.0))
        out[:, self.columns["drive_torque"]] = limit * np.maximum(action, 0.0)
        out[:, self.columns["brake"]] = np.maximum(-action, 0.0)

    def hold_speed(self, wanted: np.ndarray, out: np.ndarray) -> None:
        """A speed controller: drive torque by how much the speed (n,) [m/s] is short of ``wanted``."""
        out[:, self.columns["drive_torque"]] = np.clip(600.0 * (wanted - self.car["chassis.speed"]), -900.0, 900.0)

    def unsteadiness(self) -> np.ndarray:
        """Of the steering: the square of its move, 1 where it went as fast as it may."""
        return (self.wheel_move * (1.0 / (self.steering_rate * self.period))) ** 2


class NamesOfTask:
    """What the columns of an environment's arrays are, by its ``task``."""

    task: Task

    @property
    def observation_names(self) -> list[str]:
        return [quantity.name for quantity in self.task.observations]

    @property
    def observation_units(self) -> list[str]:
        return [quantity.unit for quantity in self.task.observations]

    @property
    def action_names(self) -> list[str]:
        return [quantity.name for quantity in self.task.actions]


def steering(limit: float) -> Quantity:
    """The action that is a steering wheel's angle."""
    return Quantity("steering wheel", "rad", -limit, limit, "its angle to go to, to the left positive")


def wheel_angle(limit: float) -> Quantity:
    """The observation that is a steering wheel's angle."""
    return Quantity("steering wheel", "rad", -limit, limit, "its angle now, to the left positive")


def between(low: float, high: float, share: np.ndarray) -> np.ndarray:
    """From uniform numbers from 0 to 1."""
    return low + (high - low) * share
