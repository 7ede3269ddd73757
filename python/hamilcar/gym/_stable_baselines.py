"""The vectorized environment as Stable-Baselines3 wants it: resets in the same step, a list of infos, ``terminal_observation``."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.vector import AutoresetMode

from ._vector import CarVectorEnv


def stable_baselines(env: CarVectorEnv) -> Any:
    """A ``stable_baselines3.common.vec_env.VecEnv`` of ``env``, which must be made with ``autoreset_mode="SameStep"``.

    >>> model = stable_baselines3.PPO("MlpPolicy", hamilcar.gym.stable_baselines(env))
    """
    try:
        from stable_baselines3.common.vec_env import VecEnv
    except ImportError as error:
        raise ImportError("Stable-Baselines3 is not installed: pip install stable-baselines3") from error
    if not isinstance(env, CarVectorEnv):
        raise TypeError(f"env: expected a CarVectorEnv, not {type(env).__name__}")
    if env.autoreset_mode != AutoresetMode.SAME_STEP:
        raise ValueError(f"autoreset_mode = {env.autoreset_mode.value!r}: expected {AutoresetMode.SAME_STEP.value!r}")

    class Adapter(VecEnv):
        def __init__(self) -> None:
            self.env = env
            super().__init__(env.num_envs, env.single_observation_space, env.single_action_space)

        def reset(self) -> np.ndarray:
            # Seeds that seed() has left for this reset, each None where it has not.
            seeds = list(self._seeds)
            self._reset_seeds()
            return env.reset(seed=seeds)[0]

        def step_async(self, actions: np.ndarray) -> None:
            self._actions = actions

        def step_wait(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[dict[str, Any]]]:
            observed, rewards, terminations, truncations, given = env.step(self._actions)
            infos: list[dict[str, Any]] = [{} for _ in range(env.num_envs)]
            for i in np.flatnonzero(terminations | truncations):
                final = given["final_info"]
                infos[i] = {
                    "terminal_observation": given["final_obs"][i], "TimeLimit.truncated": bool(truncations[i]),
                    "reason": final["reason"][i], "is_success": bool(final["is_success"][i]),
                }
            return observed, rewards.astype(np.float32), terminations | truncations, infos

        def close(self) -> None:
            env.close()

        def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
            return [getattr(env, attr_name) for _ in self._get_indices(indices)]

        def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
            setattr(env, attr_name, value)

        def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
            return [getattr(env, method_name)(*args, **kwargs) for _ in self._get_indices(indices)]

        def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
            return [False for _ in self._get_indices(indices)]

    return Adapter()
