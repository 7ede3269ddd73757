"""Tasks with steering and pedals: a lap of a circuit and a steady drift."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ._lanes import HEADING, curvature_at
from ._paths import Path, Placement, wrapped
from ._task import LATERAL_SPEED, MOTION, YAW_RATE, Quantity, Task, between, steering, wheel_angle

PEDALS = Quantity("pedals", "1", -1.0, 1.0, "drive torque where positive, brake where negative")
SPEED = Quantity("speed", "m/s", -5.0, 50.0, "of the center of mass, along the heading")
ACCELERATIONS = ("chassis.longitudinal_acceleration", "chassis.lateral_acceleration")

# A circuit of 936 m, driven to the left, with bends of 26 m radius and more both ways; points on its middle line [m].
CIRCUIT = (
    (0, 0), (60, 0), (120, 2), (180, 0), (230, 12), (252, 50), (238, 88), (200, 100), (166, 112), (150, 140),
    (160, 178), (146, 214), (110, 222), (80, 200), (66, 160), (30, 138), (-20, 136), (-62, 112), (-78, 66), (-62, 22),
)


class RacingLine(Task):
    """Drive a circuit, 10 m wide, as fast as possible.

    Reward of a step: progress along the middle line / 0.4 m (1 at 20 m/s) - 0.05 (steering move / largest move)^2. An episode
    ends where the center of mass leaves the track. It begins anywhere on the middle line, at 5 to 15 m/s, and has succeeded with a
    whole lap driven.
    """

    half_width = 5.0
    speeds = (5.0, 15.0)
    max_episode_steps = 3000
    preview = (0.0, 6.0, 12.0, 20.0, 30.0, 45.0, 60.0, 90.0)  # where curvature is observed [m ahead]
    draws = 1
    channels = (*MOTION, *ACCELERATIONS)
    actions = (steering(4.0), PEDALS)
    endings = ("left the track",)

    def __init__(self, track: Path | None = None):
        self.track = track or Path(CIRCUIT)
        self.observations = (
            Quantity("offset", "m", -8.0, 8.0, "of the center of mass from the track's middle, to the left"),
            HEADING, SPEED, LATERAL_SPEED, YAW_RATE, wheel_angle(4.0),
            Quantity("longitudinal acceleration", "m/s^2", -15.0, 15.0, "of the center of mass, ahead"),
            Quantity("lateral acceleration", "m/s^2", -15.0, 15.0, "of the center of mass, to the left"),
            *(curvature_at(ahead, 0.1) for ahead in self.preview),
        )
        self._ahead = np.rint(np.array(self.preview) / self.track.spacing).astype(np.int64)

    def start(self, random: np.random.Generator, number: int) -> dict[str, Any]:
        return {"speed": float(random.uniform(*self.speeds))}

    def bind(self, car: Mapping[str, np.ndarray], columns: Mapping[str, int], period: float) -> None:
        super().bind(car, columns, period)
        self.placement = Placement(self.count)
        self.piece = np.zeros(self.count, dtype=np.int64)
        self.began, self.reached = np.zeros(self.count), np.zeros(self.count)

    def begin(self, cars: np.ndarray, draws: np.ndarray) -> None:
        super().begin(cars, draws)
        x, y, heading, self.piece[cars] = self.track.at(draws[0] * self.track.length, np.zeros(len(cars)))
        start = self.car["chassis.position.x"][cars], self.car["chassis.position.y"][cars]
        self.placement.put(cars, x, y, heading, *start)

    def started(self, cars: np.ndarray) -> None:
        self.began[cars] = self.reached[cars] = self.distance[cars]
        self.piece[cars] = self.found[cars]

    def controls(self, actions: np.ndarray, out: np.ndarray) -> None:
        self.turn_wheel(4.0 * actions[0], out)
        self.push_pedals(actions[1], out)

    def update(self) -> None:
        x, y = self.placement(self.car["chassis.position.x"], self.car["chassis.position.y"])
        self.distance, self.offset, direction, _, self.found = self.track.locate(x, y, self.piece)
        self.heading = wrapped(self.placement.heading + self.car["chassis.angle.yaw"] - direction)

    def judge(self, rewards: np.ndarray, endings: np.ndarray) -> None:
        rewards[:] = (self.distance - self.reached) * (1 / (20.0 * self.period)) - 0.05 * self.unsteadiness()
        self.reached[:], self.piece[:] = self.distance, self.found
        endings[np.abs(self.offset) > self.half_width] = 1

    def observe(self, out: np.ndarray) -> None:
        out[0], out[1], out[5] = self.offset, self.heading, self.wheel
        out[2], out[3], out[4] = (self.car[name] for name in MOTION[3:])
        out[6], out[7] = (self.car[name] for name in ACCELERATIONS)
        out[8:] = self.track.preview(self.found, self._ahead)

    def succeeded(self, endings: np.ndarray) -> np.ndarray:
        return self.distance - self.began >= self.track.length


class Drift(Task):
    """Drift around a circle of 15 to 22 m radius, left or right, on a wet road, with the rear wheels driven.

    Reward of a step: (0.2 + 0.8 exp(-((sideslip - wanted) / 0.2 rad)^2)) exp(-(offset / 2.5 m)^2); what is wanted is 0.5 rad with
    the nose into the circle. An episode ends where the car spins (sideslip beyond 1.4 rad), stops (below 2 m/s) or is 8 m off the
    circle. It begins with the car on the circle and already turning, at a sideslip of 0.15 to 0.4 rad; it has succeeded within
    0.2 rad of the sideslip and 2 m of the circle when its time is over.
    """

    wanted = 0.5  # sideslip, nose into the circle [rad]
    torque = 1200.0
    max_episode_steps = 500
    randomize = {"road.friction": (0.45, 0.6)}
    steering_rate = 16.0
    draws = 1
    channels = (*MOTION, "rear_left.tire.longitudinal_slip", "rear_right.tire.longitudinal_slip")
    actions = (steering(9.0), PEDALS)
    endings = ("spun", "stopped", "left the circle")
    observations = (
        Quantity("offset", "m", -10.0, 10.0, "of the center of mass from the circle, outward"),
        Quantity("course error", "rad", -np.pi, np.pi, "direction of travel against the circle's, to the left"),
        Quantity("sideslip", "rad", -np.pi, np.pi, "direction of travel against the heading, to the left"),
        SPEED, YAW_RATE, wheel_angle(9.0),
        Quantity("rear left slip", "1", -2.0, 2.0, "longitudinal, drive positive"),
        Quantity("rear right slip", "1", -2.0, 2.0, "longitudinal, drive positive"),
        Quantity("curvature", "1/m", -0.1, 0.1, "of the circle, positive to the left"),
    )

    def start(self, random: np.random.Generator, number: int) -> dict[str, Any]:
        side = 1.0 if number % 2 else -1.0
        speed, slip = random.uniform(7.5, 9.5), -side * random.uniform(0.15, 0.4)
        return {"scenario": {
            "initial.velocity_m_per_s": [speed * np.cos(slip), speed * np.sin(slip), 0.0],
            "initial.angular_velocity_deg_per_s": [0.0, 0.0, float(np.degrees(side * speed / 18.0))],
        }}

    def bind(self, car: Mapping[str, np.ndarray], columns: Mapping[str, int], period: float) -> None:
        super().bind(car, columns, period)
        self.placement = Placement(self.count)
        self.radius, self.side = np.full(self.count, 18.0), np.ones(self.count)

    def begin(self, cars: np.ndarray, draws: np.ndarray) -> None:
        super().begin(cars, draws)
        # The circle's center is the origin; a car begins at the rightmost or, clockwise, at the leftmost point, and goes along y.
        self.side[cars] = side = np.where(self.car["chassis.yaw_rate"][cars] >= 0, 1.0, -1.0)
        self.radius[cars] = radius = between(15.0, 22.0, draws[0])
        slip = np.arctan2(self.car["chassis.lateral_speed"][cars], self.car["chassis.speed"][cars])
        start = self.car["chassis.position.x"][cars], self.car["chassis.position.y"][cars]
        self.placement.put(cars, side * radius, np.zeros(len(cars)), 0.5 * np.pi - slip, *start)

    def controls(self, actions: np.ndarray, out: np.ndarray) -> None:
        self.turn_wheel(9.0 * actions[0], out)
        self.push_pedals(actions[1], out)

    def update(self) -> None:
        x, y = self.placement(self.car["chassis.position.x"], self.car["chassis.position.y"])
        self.offset = np.hypot(x, y) - self.radius
        self.slip = np.arctan2(self.car["chassis.lateral_speed"], self.car["chassis.speed"])
        heading = self.placement.heading + self.car["chassis.angle.yaw"]
        self.course = wrapped(heading + self.slip - np.arctan2(y, x) - 0.5 * np.pi * self.side)

    def judge(self, rewards: np.ndarray, endings: np.ndarray) -> None:
        missed = self.slip + self.side * self.wanted
        rewards[:] = (0.2 + 0.8 * np.exp(-((5 * missed) ** 2))) * np.exp(-((0.4 * self.offset) ** 2))
        speed = np.hypot(self.car["chassis.speed"], self.car["chassis.lateral_speed"])
        endings[np.abs(self.offset) > 8.0] = 3
        endings[speed < 2.0] = 2
        endings[np.abs(self.slip) > 1.4] = 1

    def observe(self, out: np.ndarray) -> None:
        out[0], out[1], out[2], out[5] = self.offset, self.course, self.slip, self.wheel
        out[3], out[4] = self.car["chassis.speed"], self.car["chassis.yaw_rate"]
        out[6], out[7] = (self.car[name] for name in self.channels[-2:])
        out[8] = self.side / self.radius

    def succeeded(self, endings: np.ndarray) -> np.ndarray:
        return (endings == 0) & (np.abs(self.slip + self.side * self.wanted) < 0.2) & (np.abs(self.offset) < 2.0)
