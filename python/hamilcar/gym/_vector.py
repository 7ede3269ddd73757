"""The vectorized environment: one batch of cars, one task, the three ways of beginning again.

Episodes begin at starts from a bank that is prepared once; which, and where the road lies then, is drawn by a generator that each
environment has for itself, so its episodes are the same bits whatever its neighbours do.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import pi
from typing import Any

import gymnasium
import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.utils.seeding import np_random
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from .. import Batch
from ._randomization import Bank, Randomization, Spread
from ._task import NamesOfTask, Task
from ._tasks import as_task

TO_SI = {"deg": pi / 180, "deg/s": pi / 180, "rpm": pi / 30}
Seed = int | Sequence[int | None] | None


class CarVectorEnv(NamesOfTask, VectorEnv):
    """``num_envs`` cars with a task, as ``gymnasium.vector`` has it.

    ``max_episode_steps``: truncates, the task's if left out; ``randomize``: see Randomization, in place of what the task says about
    the same names; ``vehicle``, ``friction``: others than the task's; ``steps`` of ``step`` [s] make a control period; ``bank``:
    how many prepared starts episodes are drawn from, and ``bank_seed`` what these are; ``threads``, ``precision``: see Batch.

    Observations are float32 (num_envs, o), new arrays each time. ``infos`` has, where an episode ended, its ``reason`` and
    ``is_success``.
    """

    def __init__(
        self,
        num_envs: int = 1,
        task: Task | str = "LaneKeeping",
        *,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        max_episode_steps: int | None = None,
        randomize: Mapping[str, Spread | None] | None = None,
        vehicle: Any = None,
        friction: float | None = None,
        steps: int = 20,
        step: float | None = None,
        bank: int = 64,
        bank_seed: int = 0,
        threads: int = 1,
        precision: str = "double",
        render_mode: str | None = None,
    ):
        if render_mode is not None:
            raise ValueError(f"render_mode = {render_mode!r}: expected None; replay episodes with hamilcar.Simulation")
        if steps < 1:
            raise ValueError(f"steps = {steps}: expected at least one step a control period")
        self.task = as_task(task)
        self.num_envs, self.render_mode, self.steps = int(num_envs), None, int(steps)
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {"render_modes": [], "autoreset_mode": self.autoreset_mode}
        self.max_episode_steps = self.task.max_episode_steps if max_episode_steps is None else int(max_episode_steps)
        if self.max_episode_steps < 1:
            raise ValueError(f"max_episode_steps = {self.max_episode_steps}: expected at least one control period")
        self._spreads = spreads = Randomization({**self.task.randomize, **(randomize or {})})
        scenario = self.task.scenario
        self.batch = Batch(
            self.task.vehicle if vehicle is None else vehicle, self.num_envs, scenario, vary=spreads.names, threads=threads,
            precision=precision, tilt_limit=self.task.tilt_limit, step=step, energy_balance=False, friction=friction,
            powered=False if scenario is None else None,
        )
        self._make_spaces()
        self._make_arrays()
        self._bank = Bank(self.batch, self.task, spreads, self.task.channels, bank, bank_seed)

    def _make_spaces(self) -> None:
        low, high = (np.array([getattr(q, name) for q in self.task.observations]) for name in ("low", "high"))
        self._low, self._high = low[:, None], high[:, None]
        self.single_observation_space = gymnasium.spaces.Box(low.astype(np.float32), high.astype(np.float32))
        self.single_action_space = gymnasium.spaces.Box(-1.0, 1.0, (len(self.task.actions),), np.float32)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def _make_arrays(self) -> None:
        n, task = self.num_envs, self.task
        self._values = np.zeros((len(task.channels), n))
        self.batch.read(task.channels)  # refuses unknown names
        self._to_si = np.array([TO_SI.get(self.batch.channels[name][0], 1.0) for name in task.channels])[:, None]
        names = self.batch.control_names
        self._controls = np.full((n, len(names)), np.nan)
        self._observed = np.zeros((len(task.observations), n))
        self._elapsed = np.zeros(n, dtype=np.int64)
        self._over = np.zeros(n, dtype=bool)  # whose episode has ended and who has not begun again
        self._generators: list[np.random.Generator | None] = [None] * n
        self._seeds = [-1] * n
        good = [ending in task.good_endings for ending in task.endings]
        self._is_bad = np.array([False, *(not one for one in good), True])
        self._running = False
        car = {name: self._values[i] for i, name in enumerate(task.channels)}
        task.bind(car, {name: i for i, name in enumerate(names)}, self.steps * self.batch.step_size)

    @property
    def numbers(self) -> dict[str, np.ndarray]:
        """What ``randomize`` gave to each car, (n,)."""
        return {name: self.batch.expand(name).copy() for name in self._spreads.names}

    @property
    def np_random(self) -> tuple[np.random.Generator | None, ...]:  # type: ignore[override]
        """The generator of each environment."""
        return tuple(self._generators)

    @property
    def np_random_seed(self) -> tuple[int, ...]:  # type: ignore[override]
        """What these were made of; -1 before the first reset."""
        return tuple(self._seeds)

    # Beginning

    def _seed(self, cars: np.ndarray, seed: Seed) -> None:
        if seed is None or isinstance(seed, (int, np.integer)):
            seeds: Sequence[int | None] = [None if seed is None else int(seed) + i for i in range(self.num_envs)]
        else:
            seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds: expected one for each of {self.num_envs} environments")
        for i in cars:
            if seeds[i] is not None or self._generators[i] is None:
                self._generators[i], self._seeds[i] = np_random(seeds[i])

    def take_generator(self, generator: np.random.Generator) -> None:
        """The only car draws from this one."""
        self._generators[0] = generator

    def _begin(self, cars: np.ndarray) -> None:
        """Cars (m,) are at starts from the bank and have drawn what their task asks for."""
        draws = np.array([self._generators[i].random(1 + self.task.draws) for i in cars]).T
        chosen = (draws[0] * len(self._bank)).astype(np.int64)
        self.batch.reset(cars, [self._bank.starts[i] for i in chosen])
        self._values[:, cars] = self._bank.values[chosen].T * self._to_si
        self._elapsed[cars] = 0
        self._over[cars] = False
        self.task.begin(cars, draws[1:])

    def _mask(self, options: Mapping[str, Any] | None) -> np.ndarray:
        mask = (options or {}).get("reset_mask")
        if mask is None:
            return np.ones(self.num_envs, dtype=bool)
        if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_ or mask.shape != (self.num_envs,):
            raise ValueError(f"reset_mask: expected a NumPy array of truth values of shape ({self.num_envs},)")
        if not mask.any():
            raise ValueError("reset_mask: expected at least one environment to reset")
        if not self._running:
            raise ResetNeeded("reset_mask: reset all environments first")
        return mask

    def reset(self, *, seed: Seed = None, options: Mapping[str, Any] | None = None) -> tuple[np.ndarray, dict[str, Any]]:
        """All begin, or those of ``options["reset_mask"]`` (n,). A seed s is s, s + 1, ... for one after the other; with None they
        go on drawing."""
        cars = np.flatnonzero(self._mask(options))
        self._seed(cars, seed)
        self._begin(cars)
        self._running = True
        self.task.update()
        self.task.started(cars)
        return self._observe(), {}

    # Going on

    def _observe(self) -> np.ndarray:
        self.task.observe(self._observed)
        np.clip(self._observed, self._low, self._high, out=self._observed)
        return np.ascontiguousarray(self._observed.T, dtype=np.float32)

    def _actions(self, actions: Any) -> np.ndarray:
        given = np.asarray(actions, dtype=np.float64)
        if given.shape != self.action_space.shape:
            expected = f"expected {self.action_space.shape}, columns {self.action_names}"
            raise ValueError(f"actions of shape {given.shape}: {expected}")
        if not np.isfinite(given).all():
            raise ValueError("actions: expected finite numbers from -1 to 1")
        return np.clip(given.T, -1.0, 1.0)

    def step(self, actions: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """One control period with ``actions`` (n, k) from -1 to 1."""
        if not self._running:
            raise ResetNeeded("step: reset the environments first")
        if self.autoreset_mode == AutoresetMode.DISABLED and self._over.any():
            ended = np.flatnonzero(self._over).tolist()
            raise ResetNeeded(f"environments {ended} have ended: reset them with options['reset_mask']")
        self.task.controls(self._actions(actions), self._controls)
        self.batch.step(self.steps, self._controls)
        np.multiply(self.batch.read(self.task.channels).T, self._to_si, out=self._values)
        self._elapsed += 1
        began = np.flatnonzero(self._over)  # none but where the next step begins again
        if len(began):
            self._begin(began)
        self.task.update()
        self.task.started(began)
        rewards, endings = np.zeros(self.num_envs), np.zeros(self.num_envs, dtype=np.int64)
        self.task.judge(rewards, endings)
        endings[self.batch.ended] = len(self.task.endings) + 1
        endings[began] = 0
        rewards[self._is_bad[endings]] -= self.task.penalty
        rewards[began] = 0.0
        terminations = endings != 0
        truncations = (self._elapsed >= self.max_episode_steps) & ~terminations
        return self._finish(rewards, terminations, truncations, endings)

    def _finish(
        self, rewards: np.ndarray, terminations: np.ndarray, truncations: np.ndarray, endings: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        over = terminations | truncations
        infos: dict[str, Any] = {}
        ended = np.flatnonzero(over)
        if len(ended):
            infos = self._reasons(ended, endings, over)
        if self.autoreset_mode != AutoresetMode.SAME_STEP:
            self._over = over
        elif len(ended):
            last, final = self._observe(), np.full(self.num_envs, None, dtype=object)
            for i in ended:
                final[i] = last[i].copy()
            infos = {"final_obs": final, "_final_obs": over.copy(), "final_info": infos, "_final_info": over}
            self._begin(ended)
            self.task.update()
            self.task.started(ended)
        return self._observe(), rewards, terminations, truncations, infos

    def _reasons(self, ended: np.ndarray, endings: np.ndarray, over: np.ndarray) -> dict[str, Any]:
        reasons = np.full(self.num_envs, None, dtype=object)
        for i in ended:
            number = int(endings[i])
            if number > len(self.task.endings):
                reasons[i] = self.batch.why(int(i))
            else:
                reasons[i] = self.task.endings[number - 1] if number else "time limit"
        success = self.task.succeeded(endings) & over
        return {"reason": reasons, "_reason": over.copy(), "is_success": success, "_is_success": over.copy()}
