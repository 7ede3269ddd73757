"""Rollouts with exact derivatives."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from . import _core
from ._documents import Scenario, Source, Vehicle, as_scenario, as_vehicle
from ._linear_steps import LinearSteps, linear_steps
from ._simulation import Channels, ControlTargets
from ._starts import Starts
from ._variation import Variation

Array = Any  # whatever NumPy makes an array of


class Rollout:
    """A car under rows of controls as a function that can be differentiated: of controls, parameters and starting state.

    >>> rollout = Rollout("bmw_323i", parameters=["chassis.mass_kg"], record=["chassis.yaw_rate"], speed=20.0)
    >>> y, end = rollout(controls)                                   # (t, m) -> (t, 1) and (s,)
    >>> dy, dend = rollout.jacobian(controls, wrt="parameters")      # (t, 1, 1) and (s, 1)
    >>> rollout.gradient(controls, y_weights=2 * (y - measured))["controls"]      # (t, m)

    Controls are where ``control_names`` go to in each interval of ``steps`` steps, as in Batch.rollout, and a run has the same bits.
    Derivatives are those of the method's steps, by the chain rule through every operation; the way from ``parameters`` to the
    numbers of the model and to where the car settles is taken by differences of fourth order. A row of arrays ``(n, ...)`` is n
    runs, in as many lanes of the processor. A run that fails is NaN from there on, and its gradient is.
    """

    def __init__(
        self,
        vehicle: Vehicle | Source = "bmw_323i",
        scenario: Scenario | Source | None = None,
        *,
        parameters: Iterable[str] = (),
        record: Iterable[str] = (),
        steps: int = 20,
        threads: int = 0,
        speed: float | None = None,
        position: tuple[float, float] | None = None,
        yaw: float | None = None,
        friction: float | None = None,
        step: float | None = None,
        integrator: str = "rk4",
        powered: bool | None = None,
        energy_balance: bool = False,
    ):
        self.vehicle = as_vehicle(vehicle)
        if scenario is None and powered is None:
            powered = False
        self.scenario = as_scenario(
            self.vehicle, scenario, speed=speed, position=position, yaw=yaw, friction=friction, step=step,
            integrator=integrator, powered=powered, energy_balance=energy_balance,
        )
        if "controllers_off" not in self.scenario.to_dict():  # decisions have no derivatives
            self.scenario.update({"controllers_off": ["all"]})
        self._variation = Variation(self.vehicle, self.scenario, parameters)
        self.parameter_names = list(self._variation.nominal)
        self.parameters = np.array(list(self._variation.nominal.values()))
        self._starts = Starts(self._variation)
        start = self._starts.at(self.parameters)
        channels = Channels(start.channels)
        self.record = list(record)
        self.record_units = [channels.entries[name][0] for name in self.record if name in channels.entries]
        variants = [self._starts.made(changes) for changes in self._variation.variants()]
        self._core = _core.Runner(start, variants, channels.places(self.record), steps, threads)
        self._controls = ControlTargets(self._core.controls)
        self.steps = steps
        self.interval = steps * self.scenario.step
        self.control_names = list(self._controls.number)
        self.control_units = [entry[0] for entry in self._controls.entries.values()]
        self._numbers = self._core.state_numbers()
        self.state_names = [name for name, _, _ in self._numbers]
        self.start = self._core.state_of(start)
        self.held = np.array(self._core.held(start))

    def _runs(
        self, controls: Array, parameters: Array | None, state: Array | None, held: Array | None
    ) -> tuple[bool, np.ndarray, np.ndarray, list[_core.Start], np.ndarray]:
        """Whether many runs were asked for; parameters (n, p), controls with where they are at the start (n, t + 1, m), starts,
        states (n, s)."""
        m, p, s = len(self.control_names), len(self.parameter_names), len(self.state_names)
        rows = np.asarray(controls, dtype=np.float64)
        if rows.ndim not in (2, 3) or rows.shape[-1] != m or rows.shape[-2] < 1:
            raise ValueError(f"controls of shape {rows.shape}: expected (t, {m}) or (n, t, {m}), columns {self.control_names}")
        given = {
            "parameters": (self.parameters if parameters is None else parameters, p),
            "state": (state, s),
            "held": (self.held if held is None else held, m),
        }
        arrays: dict[str, np.ndarray] = {}
        counts = {rows.shape[0]} if rows.ndim == 3 else set()
        for name, (value, width) in given.items():
            if value is None:
                continue
            array = arrays[name] = np.asarray(value, dtype=np.float64)
            if array.ndim not in (1, 2) or array.shape[-1] != width:
                raise ValueError(f"{name} of shape {array.shape}: expected ({width},) or (n, {width})")
            if array.ndim == 2:
                counts.add(array.shape[0])
        if len(counts) > 1:
            raise ValueError(f"expected one number of runs, found {sorted(counts)}")
        n = counts.pop() if counts else 1
        if n == 0:
            raise ValueError("expected at least one run, found none")
        many = rows.ndim == 3 or any(array.ndim == 2 for array in arrays.values())
        values = np.broadcast_to(arrays["parameters"], (n, p))
        starts = [self._starts.at(one) for one in values]
        if "state" in arrays:
            states = np.ascontiguousarray(np.broadcast_to(arrays["state"], (n, s)))
        else:
            states = np.stack([self._core.state_of(start) for start in starts])
        all_rows = np.empty((n, rows.shape[-2] + 1, m))
        all_rows[:, 0] = arrays["held"]
        all_rows[:, 1:] = rows
        return many, values, all_rows, starts, states

    def __call__(
        self, controls: Array, parameters: Array | None = None, state: Array | None = None, held: Array | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Channels after each row, ``(t, c)``, and the state at the end, ``(s,)``; or ``(n, t, c)`` and ``(n, s)``.

        ``controls``: ``(t, m)`` or ``(n, t, m)``; ``parameters``: ``(p,)`` or ``(n, p)``, in the units of their names; ``state``:
        ``(s,)`` or ``(n, s)``, without it where the car with these parameters starts; ``held``: ``(m,)`` or ``(n, m)``, where the
        controls are before the first row, to which the state must fit: with a rack elsewhere the linkage would be torn."""
        many, _, rows, starts, states = self._runs(controls, parameters, state, held)
        y, end = self._core.run(starts, rows, states)
        return (y, end) if many else (y[0], end[0])

    def jacobian(
        self,
        controls: Array,
        parameters: Array | None = None,
        state: Array | None = None,
        held: Array | None = None,
        *,
        wrt: str = "parameters",
    ) -> tuple[np.ndarray, np.ndarray]:
        """How channels and end change with each of the parameters, numbers of the starting state, controls (row by row) or held
        controls: ``(t, c, k)`` and ``(s, k)``, forwards, one run for each column in the lanes of the processor."""
        many, values, rows, starts, states = self._runs(controls, parameters, state, held)
        n, s, m = len(starts), states.shape[1], rows.shape[2]
        columns = {"parameters": values.shape[1], "state": s, "controls": (rows.shape[1] - 1) * m, "held": m}
        if wrt not in columns:
            raise ValueError(f"wrt = {wrt!r}: expected one of {', '.join(columns)}")
        k = columns[wrt]
        if k == 0:
            raise ValueError("there are no parameters: name them in Rollout(parameters=[...])")
        along_rows = np.zeros((n, k, *rows.shape[1:]))
        along_states = np.zeros((n, k, s))
        along_numbers = np.zeros((n, k, self._core.parameters_of(starts[0]).size))
        if wrt == "state":
            along_states[:] = np.eye(s)
        elif wrt == "parameters":
            for i, one in enumerate(values):
                of_numbers, of_start = self._starts.sensitivity(self._core, one)
                along_numbers[i] = of_numbers.T
                along_rows[i] = self._targets_by_parameters(one, rows[i])
                if state is None:
                    along_states[i] = of_start.T
        else:
            first = 0 if wrt == "held" else 1
            flat = along_rows.reshape(n, k, -1)
            flat[:, np.arange(k), first * m + np.arange(k)] = 1.0
        _, _, dy, dend = self._core.tangents(
            [start for start in starts for _ in range(k)], np.repeat(rows, k, axis=0), np.repeat(states, k, axis=0),
            along_rows.reshape(n * k, *rows.shape[1:]), along_states.reshape(n * k, s), along_numbers.reshape(n * k, -1),
        )
        dy = np.moveaxis(dy.reshape(n, k, *dy.shape[1:]), 1, -1)
        dend = np.moveaxis(dend.reshape(n, k, s), 1, -1)
        return (dy, dend) if many else (dy[0], dend[0])

    def gradient(
        self,
        controls: Array,
        parameters: Array | None = None,
        state: Array | None = None,
        held: Array | None = None,
        *,
        y_weights: Array | None = None,
        end_weights: Array | None = None,
    ) -> dict[str, np.ndarray]:
        """The gradient of ``sum(y_weights * y) + sum(end_weights * end)``, backwards through all steps at once: "controls"
        ``(t, m)``, "parameters" ``(p,)``, "state" ``(s,)``, "held" ``(m,)``; or each ``(n, ...)``. Without a ``state``
        the one by parameters includes where the car starts."""
        many, values, rows, starts, states = self._runs(controls, parameters, state, held)
        n, s = states.shape

        def weights(name: str, given: Array | None, shape: tuple[int, ...]) -> np.ndarray:
            if given is None:
                return np.zeros((n, *shape))
            array = np.asarray(given, dtype=np.float64)
            if array.shape not in (shape, (n, *shape)):
                raise ValueError(f"{name} of shape {array.shape}: expected {(n, *shape) if many else shape}")
            return np.ascontiguousarray(np.broadcast_to(array, (n, *shape)))

        by_controls, by_state, by_numbers = self._core.gradient(
            starts, rows, states, weights("y_weights", y_weights, (rows.shape[1] - 1, len(self.record))),
            weights("end_weights", end_weights, (s,)),
        )
        by_parameters = np.zeros(values.shape)
        for i, one in enumerate(values):
            if values.shape[1]:
                of_numbers, of_start = self._starts.sensitivity(self._core, one)
                by_parameters[i] = by_numbers[i] @ of_numbers + (by_state[i] @ of_start if state is None else 0.0)
                by_parameters[i] += np.sum(by_controls[i] * self._targets_by_parameters(one, rows[i]), axis=(1, 2))
        out = {
            "controls": by_controls[:, 1:], "parameters": by_parameters, "state": by_state, "held": by_controls[:, 0],
        }
        return out if many else {name: value[0] for name, value in out.items()}

    def linearize(
        self, controls: Array, parameters: Array | None = None, state: Array | None = None, held: Array | None = None
    ) -> LinearSteps:
        """The run of ``controls`` ``(t, m)`` row by row as ``dz_k+1 = A_k dz_k + B_before_k du_k-1 + B_k du_k``, exact, in free
        coordinates z: without what the linkages imply, with the attitude as a rotation vector in chassis axes."""
        many, _, rows, starts, states = self._runs(controls, parameters, state, held)
        if many:
            raise ValueError("expected one run: controls (t, m)")
        if "posts" in self.scenario.to_dict().get("road", {}):
            raise ValueError("the posts move the ground over time: expected a road that is the same in each row")
        return linear_steps(self._core, self._numbers, starts[0], rows[0], states[0], self.control_names)

    def _targets_by_parameters(self, values: np.ndarray, rows: np.ndarray) -> np.ndarray:
        if "steering_wheel" in self.control_names:
            return self._starts.targets_by_parameters(self._core, values, rows)
        return np.zeros((len(values), *rows.shape))

    def __repr__(self) -> str:
        return f"<hamilcar.Rollout of {self.vehicle.name!r}, {self.steps} steps a row>"
