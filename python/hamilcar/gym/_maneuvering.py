"""Tasks that end with the car at rest: parking in reverse and braking with one side on ice."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import Vehicle
from ._circuit import ACCELERATIONS
from ._paths import Placement, wrapped
from ._task import LATERAL_SPEED, MOTION, SPEED, YAW_RATE, Quantity, Task, between, steering, wheel_angle


class Parking(Task):
    """Reverse into a slot, 3 m wide and 5.2 m deep, across an aisle, left or right of the car, and stop in it.

    Axes of the slot: x out of it, in whose direction the car looks in the end, y to the left, origin in the middle of its mouth.
    Reward of a step: by how much distance [m] + 1.5 |heading| [rad] to the pose wanted has become less, - 0.01; and 20 when parked:
    the car's middle within 0.4 m and 0.1 rad of the slot's and slower than 0.15 m/s. An episode ends there, or where the car
    touches what is around the slot, leaves the aisle or is faster than 3 m/s.
    """

    half_width, depth, aisle = 1.5, 5.2, (12.0, 12.0)  # of the slot, and how far the aisle reaches in x and to both sides [m]
    car_half = (2.15, 0.8)  # of the rectangle that the car covers, around its middle [m]
    middle = -0.1  # of that rectangle ahead of the center of mass [m]
    torque = 400.0  # at the driven wheels together [N m]
    max_episode_steps = 750
    draws = 4
    actions = (
        steering(10.0),
        Quantity("drive torque", "N m", -400.0, 400.0, "at the driven wheels together, negative in reverse"),
        Quantity("brake", "1", -1.0, 1.0, "brake pedal; below 0 it is released"),
    )
    endings = ("parked", "touched an obstacle", "left the aisle", "too fast")
    good_endings = ("parked",)
    observations = (
        Quantity("x", "m", -6.0, 15.0, "of the car's middle, slot axes"),
        Quantity("y", "m", -15.0, 15.0, "of the car's middle, slot axes"),
        Quantity("heading", "rad", -np.pi, np.pi, "against the slot's, to the left"),
        Quantity("speed", "m/s", -4.0, 4.0, "of the center of mass, along the heading"),
        YAW_RATE, wheel_angle(10.0),
    )

    def start(self, random: np.random.Generator, number: int) -> dict[str, Any]:
        return {"speed": 0.0}

    def bind(self, car: Mapping[str, np.ndarray], columns: Mapping[str, int], period: float) -> None:
        super().bind(car, columns, period)
        self.placement = Placement(self.count)
        self.left = np.zeros(self.count)

    def begin(self, cars: np.ndarray, draws: np.ndarray) -> None:
        super().begin(cars, draws)
        side = np.where(draws[0] < 0.5, 1.0, -1.0)
        x, y = between(6.0, 7.5, draws[1]), -side * between(6.0, 8.0, draws[2])
        heading = side * between(-1.65, -1.3, draws[3])
        start = self.car["chassis.position.x"][cars], self.car["chassis.position.y"][cars]
        self.placement.put(cars, x, y, heading, *start)

    def started(self, cars: np.ndarray) -> None:
        self.left[cars] = self._to_go()[cars]

    def _to_go(self) -> np.ndarray:
        return np.hypot(self.x + 0.5 * self.depth, self.y) + 1.5 * np.abs(self.heading)

    def controls(self, actions: np.ndarray, out: np.ndarray) -> None:
        self.turn_wheel(10.0 * actions[0], out)
        out[:, self.columns["drive_torque"]] = self.torque * actions[1]
        out[:, self.columns["brake"]] = np.maximum(actions[2], 0.0)

    def update(self) -> None:
        x, y = self.placement(self.car["chassis.position.x"], self.car["chassis.position.y"])
        self.heading = wrapped(self.placement.heading + self.car["chassis.angle.yaw"])
        self.cos, self.sin = np.cos(self.heading), np.sin(self.heading)
        self.x, self.y = x + self.middle * self.cos, y + self.middle * self.sin

    def touches(self) -> np.ndarray:
        """Which cars (n,) cover a part of the slot's walls: a corner of the car or the middle of a side in them, or a corner of
        them in the car."""
        half_length, half_width = self.car_half
        out = np.zeros(self.count, dtype=bool)
        for ahead in (-half_length, 0.0, half_length):
            for left in (-half_width, half_width):
                x, y = self.x + ahead * self.cos - left * self.sin, self.y + ahead * self.sin + left * self.cos
                out |= (x < 0) & ((np.abs(y) > self.half_width) | (x < -self.depth))
        for edge in (-self.half_width, self.half_width):
            dx, dy = -self.x, edge - self.y
            ahead, left = dx * self.cos + dy * self.sin, dy * self.cos - dx * self.sin
            out |= (np.abs(ahead) < half_length) & (np.abs(left) < half_width)
        return out

    def judge(self, rewards: np.ndarray, endings: np.ndarray) -> None:
        left = self._to_go()
        rewards[:] = self.left - left - 0.01
        self.left[:] = left
        speed = np.abs(self.car["chassis.speed"])
        endings[speed > 3.0] = 4
        endings[(self.x > self.aisle[0]) | (np.abs(self.y) > self.aisle[1])] = 3
        endings[self.touches()] = 2
        near = np.hypot(self.x + 0.5 * self.depth, self.y) < 0.4
        endings[near & (np.abs(self.heading) < 0.1) & (speed < 0.15) & (endings == 0)] = 1
        rewards[endings == 1] += 20.0

    def observe(self, out: np.ndarray) -> None:
        out[0], out[1], out[2], out[5] = self.x, self.y, self.heading, self.wheel
        out[3], out[4] = self.car["chassis.speed"], self.car["chassis.yaw_rate"]


class SplitFrictionBraking(Task):
    """Stop in one's lane from 18 to 28 m/s with the wheels of one side, left or right, on ice from 5 m ahead on.

    Reward of a step: - distance gone / 10 m - 0.1 (offset / 1.75 m)^2 - 0.1 (heading / 0.2 rad)^2, and 10 when it has stopped.
    An episode ends when the car has stopped (below 0.3 m/s), its center of mass leaves the lane, 3.5 m wide, or it spins (beyond
    0.8 rad).
    """

    half_width = 1.75
    penalty = 30.0
    speeds = (18.0, 28.0)
    ice = (0.1, 0.3)  # factor on the tires' friction
    max_episode_steps = 750
    slips = tuple(f"{wheel}.tire.longitudinal_slip" for wheel in ("front_left", "front_right", "rear_left", "rear_right"))
    channels = (*MOTION, *ACCELERATIONS, *slips)
    actions = (steering(4.0), Quantity("brake", "1", 0.0, 1.0, "brake pedal"))
    endings = ("stopped", "left the lane", "spun")
    good_endings = ("stopped",)
    observations = (
        Quantity("offset", "m", -4.0, 4.0, "of the center of mass from the lane's middle, to the left"),
        Quantity("heading", "rad", -1.0, 1.0, "against the lane's direction, to the left"),
        SPEED, LATERAL_SPEED, YAW_RATE, wheel_angle(4.0),
        Quantity("longitudinal acceleration", "m/s^2", -15.0, 15.0, "of the center of mass, ahead"),
        Quantity("lateral acceleration", "m/s^2", -15.0, 15.0, "of the center of mass, to the left"),
        *(Quantity(f"{s.split('.')[0].replace('_', ' ')} slip", "1", -2.0, 2.0, "longitudinal, brake negative") for s in slips),
    )

    def __init__(self, vehicle: Vehicle | str = "bmw_323i"):
        self.vehicle = Vehicle(vehicle) if isinstance(vehicle, str) else vehicle
        self.scenario = {
            "name": "split friction", "vehicle": self.vehicle.source or "vehicle", "duration_s": 1e5,
            "road": {"friction": 1.0, "friction_patch": [self._ice(1.0, 0.2)]},
        }

    @staticmethod
    def _ice(side: float, friction: float) -> dict[str, float]:
        return {"friction": friction, "start_m": 5.0, "right_m" if side > 0 else "left_m": 0.0}

    def start(self, random: np.random.Generator, number: int) -> dict[str, Any]:
        ice = self._ice(1.0 if number % 2 else -1.0, float(random.uniform(*self.ice)))
        return {
            "speed": float(random.uniform(*self.speeds)), "position": (0.0, float(random.uniform(-0.2, 0.2))),
            "scenario": {"road.friction_patch": [ice]},
        }

    def bind(self, car: Mapping[str, np.ndarray], columns: Mapping[str, int], period: float) -> None:
        super().bind(car, columns, period)
        self.reached = np.zeros(self.count)

    def started(self, cars: np.ndarray) -> None:
        self.reached[cars] = self.car["chassis.position.x"][cars]

    def controls(self, actions: np.ndarray, out: np.ndarray) -> None:
        self.turn_wheel(4.0 * actions[0], out)
        out[:, self.columns["brake"]] = 0.5 + 0.5 * actions[1]

    def judge(self, rewards: np.ndarray, endings: np.ndarray) -> None:
        x, y, heading = (self.car[name] for name in MOTION[:3])
        rewards[:] = 0.1 * (self.reached - x) - 0.1 * (y / self.half_width) ** 2 - 0.1 * (5 * heading) ** 2
        self.reached[:] = x
        endings[np.abs(heading) > 0.8] = 3
        endings[np.abs(y) > self.half_width] = 2
        endings[(self.car["chassis.speed"] < 0.3) & (endings == 0)] = 1
        rewards[endings == 1] += 10.0

    def observe(self, out: np.ndarray) -> None:
        out[0], out[1] = self.car["chassis.position.y"], self.car["chassis.angle.yaw"]
        out[2], out[3], out[4] = (self.car[name] for name in MOTION[3:])
        out[5] = self.wheel
        for row, name in enumerate(self.channels[6:], 6):
            out[row] = self.car[name]
