"""Tasks on lanes: keeping one and changing to another; speed is held by a controller, the action steers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ._paths import Path, Placement, wrapped
from ._task import LATERAL_SPEED, MOTION, SPEED, YAW_RATE, Quantity, Task, between, steering, wheel_angle

OFFSET = Quantity("offset", "m", -4.0, 4.0, "of the center of mass from the lane's middle, to the left")
HEADING = Quantity("heading error", "rad", -1.0, 1.0, "heading against the lane's direction, to the left")


def curvature_at(ahead: float, limit: float) -> Quantity:
    """The observation of the road's curvature some way ahead [m]."""
    return Quantity(f"curvature {ahead:g} m ahead", "1/m", -limit, limit, "of the middle line, to the left")


def winding_road(radius: float = 600.0, depth: float = 12.0, bends: int = 15) -> Path:
    """A ring with left and right bends: its radius [m] swings by ``depth`` [m], ``bends`` times around."""
    angle = np.linspace(0, 2 * np.pi, 12 * bends, endpoint=False)
    r = radius + depth * np.cos(bends * angle)
    return Path(np.column_stack([r * np.cos(angle), r * np.sin(angle)]))


class LaneKeeping(Task):
    """Stay in the middle of a lane, 3.5 m wide, of a winding road, at 12 to 22 m/s.

    Reward of a step: 1 - (offset / 1.75 m)^2 - (heading error / 0.5 rad)^2 - 0.05 (steering move / largest move)^2. An episode
    ends where the center of mass leaves the lane. It begins anywhere on the road, up to 0.8 m beside the middle and 0.06 rad askew,
    and has succeeded when its time is over.
    """

    half_width = 1.75
    speeds = (12.0, 22.0)
    preview = (0.0, 8.0, 16.0, 32.0)  # where curvature is observed [m ahead]
    draws = 3
    actions = (steering(1.5),)
    endings = ("left the lane",)

    def __init__(self, road: Path | None = None):
        self.road = road or winding_road()
        self.observations = (
            OFFSET, HEADING, SPEED, LATERAL_SPEED, YAW_RATE, wheel_angle(1.5),
            *(curvature_at(ahead, 0.02) for ahead in self.preview),
        )
        self._ahead = np.rint(np.array(self.preview) / self.road.spacing).astype(np.int64)

    def start(self, random: np.random.Generator, number: int) -> dict[str, Any]:
        return {"speed": float(random.uniform(*self.speeds))}

    def bind(self, car: Mapping[str, np.ndarray], columns: Mapping[str, int], period: float) -> None:
        super().bind(car, columns, period)
        self.wanted = np.zeros(self.count)
        self.placement = Placement(self.count)
        self.piece = np.zeros(self.count, dtype=np.int64)

    def begin(self, cars: np.ndarray, draws: np.ndarray) -> None:
        super().begin(cars, draws)
        self.wanted[cars] = self.car["chassis.speed"][cars]
        x, y, heading, piece = self.road.at(draws[0] * self.road.length, between(-0.8, 0.8, draws[1]))
        self.piece[cars] = piece
        askew = between(-0.06, 0.06, draws[2])
        start = self.car["chassis.position.x"][cars], self.car["chassis.position.y"][cars]
        self.placement.put(cars, x, y, heading + askew, *start)

    def controls(self, actions: np.ndarray, out: np.ndarray) -> None:
        self.turn_wheel(1.5 * actions[0], out)
        self.hold_speed(self.wanted, out)

    def started(self, cars: np.ndarray) -> None:
        self.piece[cars] = self.found[cars]

    def update(self) -> None:
        x, y = self.placement(self.car["chassis.position.x"], self.car["chassis.position.y"])
        _, self.offset, direction, _, self.found = self.road.locate(x, y, self.piece)
        self.heading = wrapped(self.placement.heading + self.car["chassis.angle.yaw"] - direction)

    def judge(self, rewards: np.ndarray, endings: np.ndarray) -> None:
        rewards[:] = 1 - (self.offset / self.half_width) ** 2 - (2 * self.heading) ** 2 - 0.05 * self.unsteadiness()
        self.piece[:] = self.found
        endings[np.abs(self.offset) > self.half_width] = 1

    def observe(self, out: np.ndarray) -> None:
        out[0], out[1], out[5] = self.offset, self.heading, self.wheel
        out[2], out[3], out[4] = (self.car[name] for name in MOTION[3:])
        out[6:] = self.road.preview(self.found, self._ahead)

    def succeeded(self, endings: np.ndarray) -> np.ndarray:
        return endings == 0


class LaneChange(Task):
    """Change to the lane beside, 3.5 m to the left or the right, on a straight road at 15 to 30 m/s, and stay there.

    Reward of a step: 1 - |offset| / 3.5 m - 0.3 (lateral acceleration / 4 m/s^2)^2 - 0.05 (steering move / largest move)^2, the
    offset from the new lane's middle. An episode ends where the center of mass leaves the two lanes. It has succeeded with the car
    within 0.3 m and 0.05 rad of the new lane's middle when its time is over.
    """

    lane = 3.5
    speeds = (15.0, 30.0)
    max_episode_steps = 300
    draws = 3
    channels = (*MOTION, "chassis.lateral_acceleration")
    actions = (steering(1.5),)
    endings = ("left the road",)
    observations = (
        Quantity("offset", "m", -6.0, 6.0, "of the center of mass from the new lane's middle, to the left"),
        HEADING, SPEED, LATERAL_SPEED, YAW_RATE, wheel_angle(1.5),
        Quantity("lateral acceleration", "m/s^2", -12.0, 12.0, "of the center of mass, to the left"),
        Quantity("side", "1", -1.0, 1.0, "where the old lane is seen from the new one, 1 on the left"),
    )

    def start(self, random: np.random.Generator, number: int) -> dict[str, Any]:
        return {"speed": float(random.uniform(*self.speeds))}

    def bind(self, car: Mapping[str, np.ndarray], columns: Mapping[str, int], period: float) -> None:
        super().bind(car, columns, period)
        self.wanted = np.zeros(self.count)
        self.side = np.ones(self.count)
        self.placement = Placement(self.count)

    def begin(self, cars: np.ndarray, draws: np.ndarray) -> None:
        super().begin(cars, draws)
        self.wanted[cars] = self.car["chassis.speed"][cars]
        self.side[cars] = side = np.where(draws[0] < 0.5, 1.0, -1.0)
        y = side * self.lane + between(-0.3, 0.3, draws[1])
        start = self.car["chassis.position.x"][cars], self.car["chassis.position.y"][cars]
        self.placement.put(cars, np.zeros(len(cars)), y, between(-0.02, 0.02, draws[2]), *start)

    def controls(self, actions: np.ndarray, out: np.ndarray) -> None:
        self.turn_wheel(1.5 * actions[0], out)
        self.hold_speed(self.wanted, out)

    def update(self) -> None:
        _, self.offset = self.placement(self.car["chassis.position.x"], self.car["chassis.position.y"])
        self.heading = wrapped(self.placement.heading + self.car["chassis.angle.yaw"])

    def judge(self, rewards: np.ndarray, endings: np.ndarray) -> None:
        acceleration = self.car["chassis.lateral_acceleration"]
        rewards[:] = 1 - np.abs(self.offset) / self.lane - 0.3 * (acceleration / 4) ** 2 - 0.05 * self.unsteadiness()
        # From the middle of both lanes.
        endings[np.abs(self.offset - 0.5 * self.lane * self.side) > self.lane] = 1

    def observe(self, out: np.ndarray) -> None:
        out[0], out[1], out[5], out[7] = self.offset, self.heading, self.wheel, self.side
        out[2], out[3], out[4] = (self.car[name] for name in MOTION[3:])
        out[6] = self.car["chassis.lateral_acceleration"]

    def succeeded(self, endings: np.ndarray) -> np.ndarray:
        return (endings == 0) & (np.abs(self.offset) < 0.3) & (np.abs(self.heading) < 0.05)
