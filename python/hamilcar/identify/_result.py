"""What an identification found, and how well it is known."""

from __future__ import annotations

import os
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from .._documents import Vehicle
from .._variation import FRICTION
from ._loss import variance_of
from ._problem import Problem


@dataclass(frozen=True)
class Direction:
    """A combination of unknowns, each divided by its scale, and its standard deviation: above 0.5 the data say less about it than
    that each unknown is within its scale."""

    sd: float
    shares: dict[str, float]

    @property
    def is_known(self) -> bool:
        return self.sd < 0.5

    def __str__(self) -> str:
        order = sorted(self.shares, key=lambda name: -abs(self.shares[name]))
        large = [name for name in order if abs(self.shares[name]) > 0.25] or order[:1]
        return " ".join(f"{'+' if self.shares[name] > 0 else '-'}{abs(self.shares[name]):.2f} {name}" for name in large)


@dataclass(frozen=True, eq=False)
class Fit:
    """A measured channel beside the model, and what is left: in a right model with white noise the lag-1 autocorrelation is near 0,
    Durbin and Watson's number near 2 and the residuals' standard deviation near the stated one, all in ``unit``."""

    run: str
    channel: str
    unit: str
    time: np.ndarray
    measured: np.ndarray
    simulated: np.ndarray
    stated_sd: float

    @property
    def residuals(self) -> np.ndarray:
        return self.simulated - self.measured

    @property
    def sd(self) -> float:
        return float(np.sqrt(np.mean(self.residuals**2)))

    @property
    def durbin_watson(self) -> float:
        left = self.residuals
        return float(np.sum(np.diff(left) ** 2) / max(left @ left, 1e-300))

    @property
    def autocorrelation(self) -> float:
        left = self.residuals - self.residuals.mean()
        return float(left[1:] @ left[:-1] / max(left @ left, 1e-300))


class Identification:
    """Values with their covariance, and the fits that they came from.

    ``values``, ``standard_errors`` and ``intervals`` (95 percent, by Student's t) go by the names of the unknowns; ``covariance``
    and ``correlation`` are ``(k, k)`` in the order of ``names``. They hold for errors that are independent from sample to sample:
    ``warnings`` tells where they are not, which unknowns the data do not determine, and which stand on a bound.
    ``reduced_chi_square`` is 1 where the residuals are as large as the stated noise; the covariance is scaled by what it really is.
    """

    def __init__(
        self, problem: Problem, x: np.ndarray, *, residuals: np.ndarray, jacobian: np.ndarray, loss: tuple[str, float],
        start_costs: list[float], evaluations: int, message: str,
    ):
        self._problem, self._x, self._message = problem, x, message
        self.names = list(problem.names)
        self.units = dict(zip(self.names, problem.units))
        self.values = {name: float(value) for name, value in zip(self.names, x)}
        self.starts = {name: float(value) for name, value in zip(self.names, problem.start)}
        self.bounds = {name: (float(low), float(high)) for name, low, high in zip(self.names, problem.low, problem.high)}
        self.start_costs, self.evaluations = start_costs, evaluations
        own, n, k = residuals[: problem.count], problem.count, x.size
        self.degrees_of_freedom = max(n + len(problem.priors) - k, 1)
        self.reduced_chi_square = float(own @ own / max(n - k, 1))
        sd = np.sqrt(variance_of(*loss, own, k))
        # Noise that is larger than was stated makes the data weaker; a prior's width stays what was said.
        scaled = np.concatenate([jacobian[:n] / max(sd, 1e-150), jacobian[n:]]) * problem.scale
        _, self.singular_values, rows = np.linalg.svd(scaled, full_matrices=False)
        # What differences of fourth order leave of nothing is not taken for information.
        seen = self.singular_values > 1e-9 * self.singular_values[0]
        spread = np.where(seen, 1 / np.where(seen, self.singular_values, 1.0), 1e9)
        half = rows.T * spread
        self.covariance = (half @ half.T) * np.outer(problem.scale, problem.scale)
        deviations = np.sqrt(np.diag(self.covariance))
        self.correlation = self.covariance / np.outer(deviations, deviations)
        self.standard_errors = {name: float(one) for name, one in zip(self.names, deviations)}
        self.directions = [  # the best known one first
            Direction(float(one), dict(zip(self.names, (row * np.sign(row[np.argmax(np.abs(row))])).tolist())))
            for one, row in zip(spread, rows)
        ]
        self.warnings = self._warnings()

    def interval(self, name: str, confidence: float = 0.95) -> tuple[float, float]:
        """Where the unknown lies with this confidence, by Student's t."""
        from scipy import stats

        if not 0 < confidence < 1:
            raise ValueError(f"confidence = {confidence}: expected a share between 0 and 1")
        half = float(stats.t.ppf(0.5 + 0.5 * confidence, self.degrees_of_freedom)) * self.standard_errors[name]
        return self.values[name] - half, self.values[name] + half

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        return {name: self.interval(name) for name in self.names}

    @property
    def changes(self) -> dict[str, float]:
        """The found numbers of vehicle and road, by their names in files."""
        return dict(zip(self._problem.parameters, map(float, self._problem.parameters_at(self._x))))

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle with the found numbers."""
        return self._problem.vehicle.changed({name: value for name, value in self.changes.items() if name != FRICTION})

    @cached_property
    def fits(self) -> list[Fit]:
        out = []
        for test in self._problem.tests:
            y = self._problem.simulate(test, self._x)
            for column in test.columns:
                model, _, _ = test.model(column, self._x, y)
                out.append(Fit(test.name, column.channel, column.unit, column.times, column.measured, model, column.sd))
        return out

    def _warnings(self) -> list[str]:
        out = [f"the search has not ended: {self._message}"] if self._message else []
        for name, value in self.values.items():
            low, high = self.bounds[name]
            at = next((one for one in (low, high) if abs(value - one) <= 1e-4 * min(high - low, abs(one) + 1)), None)
            if at is not None:
                out.append(f"{name} stands on its bound {at:g}: its interval does not hold")
        for one in self.directions:
            if not one.is_known:
                out.append(f"not identifiable from these data: {one} (standard deviation {one.sd:.3g} of the scales)")
        if not 0.5 < self.reduced_chi_square < 2:
            factor = np.sqrt(self.reduced_chi_square)
            out.append(f"residuals are {factor:.3g} times as large as the stated noise: the model or the noise is not right")
        for fit in self.fits:
            if fit.autocorrelation > 0.5:
                out.append(
                    f"residuals of {fit.channel} in {fit.run} go together from sample to sample (autocorrelation "
                    f"{fit.autocorrelation:.2f}): the intervals are too narrow"
                )
        return out

    def text(self) -> str:
        """A report for people."""
        from ._report import text_of

        return text_of(self)

    def to_html(self, path: str | os.PathLike[str]) -> None:
        """A page of its own, with measured and simulated channels."""
        from ._report import html_of

        Path(path).write_text(html_of(self), encoding="utf-8")

    def _repr_html_(self) -> str:
        from ._report import table_of

        return table_of(self)

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers, as for JSON."""
        return {
            "values": self.values, "standard_errors": self.standard_errors, "intervals": self.intervals, "units": self.units,
            "covariance": self.covariance.tolist(), "reduced_chi_square": self.reduced_chi_square, "warnings": self.warnings,
        }

    def __repr__(self) -> str:
        return f"<hamilcar.Identification of {len(self.names)} unknowns, {len(self.warnings)} warnings>"
