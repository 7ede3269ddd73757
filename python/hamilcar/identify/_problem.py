"""Residuals of all measurements and their Jacobian, by one vector x: unknowns of the vehicle, then those of the instruments.

The rollout gives columns at the ends of its intervals. A delay shifts a column between these places, by a cubic with continuous
slope (Hermite's, with central differences), so that the residual has a continuous derivative by the delay.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._documents import Vehicle
from .._errors import Error, NumericalError
from .._rollout import Rollout
from ._measurement import Free, Measurement, Unknown, scale_of


def sampled(columns: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Columns ``(t, ...)`` between their rows, at places in 0 to t - 1, and the slopes there, by place."""
    slopes = np.gradient(columns, axis=0)
    i = np.clip(places.astype(int), 0, len(columns) - 2)
    f = (places - i).reshape(-1, *[1] * (columns.ndim - 1))
    left, right, m, n = columns[i], columns[i + 1], slopes[i], slopes[i + 1]
    rise = right - left
    values = left + f * (m + f * (3 * rise - 2 * m - n + f * (m + n - 2 * rise)))
    return values, m + f * (2 * (3 * rise - 2 * m - n) + f * 3 * (m + n - 2 * rise))


@dataclass(frozen=True)
class Column:
    """A measured channel: where the rollout has it, its samples, and delay, bias and gain as numbers or as places in x."""

    channel: str
    unit: str
    number: int
    times: np.ndarray
    measured: np.ndarray
    sd: float
    instruments: Mapping[str, float | int]

    def instrument(self, what: str, x: np.ndarray) -> float:
        value = self.instruments[what]
        return float(x[value]) if isinstance(value, int) else value


@dataclass(frozen=True)
class Test:
    """A measurement with its rollout."""

    name: str
    rollout: Rollout
    controls: np.ndarray
    state: np.ndarray | None
    columns: list[Column]

    def model(self, column: Column, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Gain times the delayed column plus bias, the delayed column, and its slope by time [1/s]; ``y``: ``(t, c)``."""
        values, slopes = sampled(y[:, column.number], self.places(column, x))
        model = column.instrument("gain", x) * values + column.instrument("bias", x)
        return model, values, slopes / self.rollout.interval

    def places(self, column: Column, x: np.ndarray) -> np.ndarray:
        return (column.times - column.instrument("delay", x)) / self.rollout.interval - 1


class Problem:
    def __init__(
        self, vehicle: Vehicle, unknowns: Sequence[Unknown], measurements: Sequence[Measurement], *, step: float, integrator: str,
        threads: int,
    ):
        self.vehicle = vehicle
        self.parameters = [name for one in unknowns for name in one.parameters]
        runs = [one.name or f"run {i + 1}" for i, one in enumerate(measurements)]
        for names, what in ((self.parameters, "parameter"), ([one.name for one in unknowns], "unknown"), (runs, "run")):
            twice = {name for name in names if names.count(name) > 1}
            if twice:
                raise ValueError(f"{', '.join(sorted(twice))}: expected each {what} once")
        self._options: dict[str, Any] = {"integrator": integrator, "threads": threads}
        self._rollouts: dict[Any, Rollout] = {}
        self.names: list[str] = []
        self.units: list[str] = []
        self._low: list[float] = []
        self._high: list[float] = []
        self._start: list[float] = []
        self._scale: list[float] = []
        self.priors: list[tuple[int, float, float]] = []  # place in x, mean, standard deviation
        self._free: dict[str, Free] = {}
        self._places: dict[str, int] = {}  # of free ones in x
        self._add_unknowns(unknowns)
        self.tests = [self._test(one, name, step) for one, name in zip(measurements, runs)]
        self.low, self.high = np.array(self._low), np.array(self._high)
        self.start, self.scale = np.array(self._start), np.array(self._scale)
        self.count = sum(column.times.size for test in self.tests for column in test.columns)

    def _add(self, one: Unknown | Free, name: str, unit: str, default: float) -> None:
        start = default if one.nominal is None else one.nominal
        if not one.min <= start <= one.max:
            raise ValueError(f"{name} is {start:g} at the start: expected {one.min:g} to {one.max:g}, or give a nominal one")
        if one.prior is not None:
            self.priors.append((len(self.names), float(one.prior[0]), float(one.prior[1])))
        self.names.append(name)
        self.units.append(unit)
        self._low.append(one.min), self._high.append(one.max)
        self._start.append(start), self._scale.append(scale_of(one, start))

    def _add_unknowns(self, unknowns: Sequence[Unknown]) -> None:
        """Parameters are ``offsets + factors @ x``."""
        numbers = self.vehicle.numbers()
        places = {name: j for j, name in enumerate(self.parameters)}
        nominal = Rollout(self.vehicle, parameters=self.parameters, **self._options).parameters
        self._factors = np.zeros((len(places), len(unknowns)))
        for i, one in enumerate(unknowns):
            unit = "1" if one.multiplies or one.name not in numbers else numbers[one.name].unit or "1"
            self._add(one, one.name, unit, 1.0 if one.multiplies else float(nominal[places[one.name]]))
            for name in one.parameters:
                self._factors[places[name], i] = nominal[places[name]] if one.multiplies else 1.0

    def parameters_at(self, x: np.ndarray) -> np.ndarray:
        return self._factors @ x[: self._factors.shape[1]]

    def _test(self, one: Measurement, name: str, step: float) -> Test:
        spacing = float(np.median(np.diff(one.time))) if one.interval is None else one.interval
        steps = max(1, round(spacing / step))
        channels = list(one.measured)
        key = (id(one.scenario), one.speed, one.friction, one.powered, steps, tuple(channels))
        if key not in self._rollouts:
            self._rollouts[key] = Rollout(
                self.vehicle, one.scenario, parameters=self.parameters, record=channels, steps=steps, speed=one.speed,
                friction=one.friction, powered=one.powered, step=step, **self._options,
            )
        rollout = self._rollouts[key]
        columns, last = [], one.time[-1]
        for i, channel in enumerate(channels):
            instruments, least, most = self._instruments(one, name, channel, rollout.record_units[i])
            # Samples that every delay takes from where the rollout has been: the same ones for all x.
            used = np.isfinite(one.measured[channel]) & (one.time - most >= rollout.interval * (1 - 1e-9))
            if not used.any():
                raise ValueError(f"{channel} of {name}: expected samples after {rollout.interval + most:g} s")
            last = max(last, one.time[used][-1] - least)
            columns.append(
                Column(
                    channel, rollout.record_units[i], i, one.time[used], one.measured[channel][used], one.sd_of(channel),
                    instruments,
                )
            )
        rows = max(2, int(np.ceil(last / rollout.interval - 1e-9)))
        times = rollout.interval * np.arange(1, rows + 1)
        state = None if one.state is None else np.asarray(one.state, dtype=np.float64)
        return Test(name, rollout, one.rows(times, rollout.control_names, rollout.held), state, columns)

    def _instruments(
        self, one: Measurement, test: str, channel: str, unit: str
    ) -> tuple[dict[str, float | int], float, float]:
        """Numbers or places in x, and the range of the delay [s]."""
        out: dict[str, float | int] = {}
        least = most = 0.0
        for what, value, default in one.instruments_of(channel):
            if not isinstance(value, Free):
                out[what] = float(value)
                low = high = out[what]
            else:
                whole = what == "delay" and isinstance(one.delay, Free)  # one delay for the whole measurement
                name = value.name or (f"{test}: {what}" if whole else f"{test}: {what} of {channel}")
                if self._free.setdefault(name, value) != value or (name in self.names) != (name in self._places):
                    raise ValueError(f"{name}: expected the same range everywhere, and no other unknown of this name")
                if name not in self._places:
                    self._places[name] = len(self.names)
                    near = min(max(default, value.min), value.max)
                    self._add(value, name, {"delay": "s", "bias": unit, "gain": "1"}[what], near)
                out[what] = self._places[name]
                low, high = value.min, value.max
            if what == "delay":
                least, most = low, high
        return out, least, most

    def simulate(self, test: Test, x: np.ndarray) -> np.ndarray:
        """Columns ``(t, c)``; NaN where the car with these numbers cannot be made or driven."""
        try:
            return test.rollout(test.controls, self.parameters_at(x), test.state)[0]
        except Error:
            return np.full((len(test.controls), len(test.columns)), np.nan)

    def check(self, x: np.ndarray) -> None:
        """Raises what is wrong with the cars that the search begins with."""
        for test in self.tests:
            y, _ = test.rollout(test.controls, self.parameters_at(x), test.state)
            if not np.all(np.isfinite(y)):
                raise NumericalError(f"{test.name}: the car cannot drive this with the nominal numbers", 4)

    def residuals(self, x: np.ndarray) -> np.ndarray:
        """Of the samples ``(count,)``, then of the priors."""
        parts = []
        for test in self.tests:
            y = self.simulate(test, x)
            for column in test.columns:
                parts.append((test.model(column, x, y)[0] - column.measured) / column.sd)
        parts.append(np.array([(x[i] - mean) / sd for i, mean, sd in self.priors]))
        return np.concatenate(parts)

    def jacobian(self, x: np.ndarray) -> np.ndarray:
        k = self._factors.shape[1]
        parts = []
        for test in self.tests:
            y = self.simulate(test, x)
            by_parameters, _ = test.rollout.jacobian(test.controls, self.parameters_at(x), test.state)
            for column in test.columns:
                rows = np.zeros((column.times.size, x.size))
                _, values, slopes = test.model(column, x, y)
                gain = column.instrument("gain", x)
                of_column = sampled(by_parameters[:, column.number], test.places(column, x))[0]
                rows[:, :k] = gain * of_column @ self._factors
                for what, by in (("delay", -gain * slopes), ("bias", np.ones_like(values)), ("gain", values)):
                    if isinstance(column.instruments[what], int):
                        rows[:, column.instruments[what]] += by
                parts.append(rows / column.sd)
        prior = np.zeros((len(self.priors), x.size))
        for row, (i, _, sd) in zip(prior, self.priors):
            row[i] = 1 / sd
        return np.concatenate([*parts, prior])
