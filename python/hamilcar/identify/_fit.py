"""The search for the unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any

import numpy as np

from .._documents import Source, Vehicle, as_vehicle
from .._errors import Error, NumericalError
from ._loss import LOSSES, loss_of
from ._measurement import Measurement, Unknown
from ._problem import Problem
from ._result import Identification


def _optimize() -> Any:
    try:
        from scipy import optimize
    except ImportError as error:
        raise ImportError("identification needs SciPy: pip install 'hamilcar[identify]'") from error
    return optimize


def identify(
    vehicle: Vehicle | Source,
    unknowns: Sequence[Unknown],
    measurements: Sequence[Measurement],
    *,
    starts: int = 1,
    seed: int = 0,
    loss: str = "linear",
    loss_scale: float = 1.0,
    max_evaluations: int | None = None,
    step: float = 1e-3,
    integrator: str = "rk4",
    threads: int = 0,
) -> Identification:
    """The unknowns with which simulated runs are nearest to measured ones, by ``scipy.optimize.least_squares`` with bounds and the
    exact Jacobian.

    ``starts``: the search begins once at the nominal values and then at others within the bounds (a Latin hypercube by ``seed``);
    the best one counts. ``loss``: "linear" for squares, or "soft_l1", "huber", "cauchy", which count residuals beyond
    ``loss_scale`` standard deviations less, against outliers. ``step`` [s] and ``integrator`` are those of the Rollout.
    """
    optimize = _optimize()
    if loss not in LOSSES:
        near = get_close_matches(loss, list(LOSSES), 1)
        hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(LOSSES)}"
        raise ValueError(f"loss = {loss!r}{hint}")
    if not loss_scale > 0 or starts < 1:
        raise ValueError(f"loss_scale = {loss_scale}, starts = {starts}: expected a positive number and at least one start")
    if not unknowns or not measurements:
        raise ValueError("expected at least one unknown and one measurement")
    problem = Problem(as_vehicle(vehicle), unknowns, measurements, step=step, integrator=integrator, threads=threads)
    if problem.count + len(problem.priors) <= len(problem.names):
        raise ValueError(f"{problem.count} samples for {len(problem.names)} unknowns: expected more samples than unknowns")
    problem.check(problem.start)
    found, failure = [], None
    for x in _starts(problem, starts, seed):
        try:
            found.append(
                optimize.least_squares(
                    problem.residuals, x, jac=problem.jacobian, bounds=(problem.low, problem.high), x_scale=problem.scale,
                    loss=loss_of(loss, problem.count), f_scale=loss_scale, max_nfev=max_evaluations,
                )
            )
        except (Error, ValueError) as error:  # a start whose car cannot be made or driven
            if not isinstance(error, Error) and "not finite" not in str(error):
                raise
            failure = error
    if not found:
        raise NumericalError(f"no search came to its end: {failure}", 4) from failure
    best = min(found, key=lambda one: one.cost)
    return Identification(
        problem, best.x, residuals=best.fun, jacobian=problem.jacobian(best.x), loss=(loss, loss_scale),
        start_costs=[float(one.cost) for one in found], evaluations=sum(one.nfev for one in found),
        message="" if best.status > 0 else best.message,
    )


def _starts(problem: Problem, count: int, seed: int) -> list[np.ndarray]:
    out = [problem.start]
    if count > 1:
        endless = [name for name, low, high in zip(problem.names, problem.low, problem.high) if not np.isfinite(high - low)]
        if endless:
            raise ValueError(f"starts = {count}: expected finite bounds for {', '.join(endless)}")
        random = np.random.default_rng(seed)
        strata = np.array([random.permutation(count - 1) for _ in problem.names]).T
        shares = (strata + random.random(strata.shape)) / (count - 1)
        out += list(problem.low + shares * (problem.high - problem.low))
    return out
