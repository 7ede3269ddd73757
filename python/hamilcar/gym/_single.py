"""One car as a ``gymnasium.Env``: the vectorized environment with one car."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode

from ._task import NamesOfTask, Task
from ._vector import CarVectorEnv

NEVER = 2**62


class CarEnv(NamesOfTask, gymnasium.Env):
    """A task with one car, with the same bits as in CarVectorEnv with the same seed.

    ``max_episode_steps``: truncates; without it, as ``gymnasium.make`` has it, episodes go on until a TimeLimit wrapper ends them.
    The other settings are those of CarVectorEnv.
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, task: Task | str = "LaneKeeping", *, max_episode_steps: int | None = None, **settings: Any):
        limit = NEVER if max_episode_steps is None else max_episode_steps
        self.vector = CarVectorEnv(1, task, autoreset_mode=AutoresetMode.DISABLED, max_episode_steps=limit, **settings)
        self.task = self.vector.task
        self.render_mode = None
        self.observation_space = self.vector.single_observation_space
        self.action_space = self.vector.single_action_space

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[np.ndarray, dict[str, Any]]:
        super().reset(seed=seed)
        self.vector.take_generator(self.np_random)
        return self.vector.reset()[0][0], {}

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        rows = self.vector.step(np.asarray(action)[None])
        infos = {name: values[0] for name, values in rows[4].items() if not name.startswith("_")}
        if "is_success" in infos:
            infos["is_success"] = bool(infos["is_success"])
        return rows[0][0], float(rows[1][0]), bool(rows[2][0]), bool(rows[3][0]), infos
