"""Driving tasks for reinforcement learning: ``gymnasium`` environments with many cars in one batch.

>>> import hamilcar.gym
>>> env = hamilcar.gym.make_vec("LaneKeeping", 1024)
>>> observations, infos = env.reset(seed=1)
>>> observations, rewards, terminations, truncations, infos = env.step(env.action_space.sample())

The tasks are registered too: ``gymnasium.make_vec("hamilcar/LaneKeeping-v0", num_envs=1024)`` has many cars and
``gymnasium.make("hamilcar/LaneKeeping-v0")`` one.
"""

from __future__ import annotations

from typing import Any

try:
    import gymnasium
except ImportError as error:
    raise ImportError("hamilcar.gym needs Gymnasium: pip install 'hamilcar[learn]'") from error

from ._circuit import Drift, RacingLine
from ._lanes import LaneChange, LaneKeeping, winding_road
from ._maneuvering import Parking, SplitFrictionBraking
from ._paths import Path, Placement
from ._single import CarEnv
from ._stable_baselines import stable_baselines
from ._task import Quantity, Task
from ._tasks import TASKS
from ._vector import CarVectorEnv


def make_vec(task: Task | str = "LaneKeeping", num_envs: int = 1, **settings: Any) -> CarVectorEnv:
    """``num_envs`` cars with a task or one of those by its name; ``settings`` as in CarVectorEnv."""
    return CarVectorEnv(num_envs, task, **settings)


for _name, _task in TASKS.items():
    gymnasium.register(
        f"hamilcar/{_name}-v0", entry_point="hamilcar.gym:CarEnv", vector_entry_point="hamilcar.gym:CarVectorEnv",
        max_episode_steps=_task.max_episode_steps, kwargs={"task": _name},
    )

__all__ = [
    "CarEnv",
    "CarVectorEnv",
    "Drift",
    "LaneChange",
    "LaneKeeping",
    "Parking",
    "Path",
    "Placement",
    "Quantity",
    "RacingLine",
    "SplitFrictionBraking",
    "TASKS",
    "Task",
    "make_vec",
    "stable_baselines",
    "winding_road",
]
