"""Which parameters matter, by SALib: Sobol's indices and Morris' screening."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._designs import rounded
from ._result import StudyResult

if TYPE_CHECKING:
    from ._study import Study

Evaluate = Callable[[np.ndarray], Any]


@dataclass(frozen=True)
class Sensitivity:
    """Indices by their name in SALib, each ``(m, d)``, a row for each figure and a column for each parameter; ``S2`` ``(m, d, d)``.

    ``result["S1"]``, ``result["ST"]`` and ``_conf``, half the width of their confidence interval of 95 percent; after Morris
    ``mu``, ``mu_star`` and ``sigma``, in the figure's unit over the parameter's whole range. NaN for a figure that does not vary.
    ``left_out`` ``(m,)``: points that a figure's indices are not computed from, since one of their group does not have it.
    """

    method: str
    parameters: tuple[str, ...]
    figures: tuple[str, ...]
    indices: dict[str, np.ndarray]
    X: np.ndarray
    Y: np.ndarray
    left_out: np.ndarray

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.indices:
            raise KeyError(f"there is no index {name!r}: expected one of {', '.join(self.indices)}")
        return self.indices[name]

    def ranking(self, figure: str) -> list[tuple[str, float]]:
        """Parameters by their total effect on a figure, the largest first."""
        if figure not in self.figures:
            raise KeyError(f"there is no figure {figure!r}: expected one of {', '.join(self.figures)}")
        values = self["ST" if self.method == "sobol" else "mu_star"][self.figures.index(figure)].tolist()
        return sorted(zip(self.parameters, values), key=lambda one: -one[1])


def _salib(module: str) -> Any:
    try:
        from importlib import import_module

        return import_module(f"SALib.{module}")
    except ImportError as error:
        raise ImportError("sensitivity needs SALib: pip install 'hamilcar[design]'") from error


def problem_spec(study: Study) -> Any:
    """SALib's ProblemSpec: names, bounds and outputs of a study, for ``spec.sample(...).evaluate(study.evaluate).analyze(...)``."""
    return _salib("util.problem").ProblemSpec(
        {
            "num_vars": len(study.parameters),
            "names": [p.name for p in study.parameters],
            "bounds": study.bounds.tolist(),
            "outputs": list(study.figures),
        }
    )


def sensitivity(
    study: Study,
    method: str = "sobol",
    points: int = 64,
    *,
    seed: int = 1,
    second_order: bool = False,
    evaluate: Evaluate | None = None,
) -> Sensitivity:
    """Sensitivity of every figure to every parameter over the whole ranges.

    ``method``: "sobol", first-order and total indices from ``points (d + 2)`` points, ``points (2 d + 2)`` with ``second_order``,
    best a power of two; or "morris", elementary effects along ``points`` trajectories of ``d + 1`` points. ``evaluate``: by which
    ``X`` becomes ``Y``, or a StudyResult; ``study.evaluate`` if left out, ``lambda X: study.run(X, folder, processes=8)`` another.
    """
    if method not in ("sobol", "morris"):
        raise ValueError(f"method = {method!r}: expected 'sobol' or 'morris'")
    if isinstance(points, bool) or not isinstance(points, int) or points < 2:
        raise ValueError(f"points = {points!r}: expected a whole number, at least 2")
    spec, d = problem_spec(study), len(study.parameters)
    if method == "sobol":
        group = 2 * d + 2 if second_order else d + 2
        X = _salib("sample.sobol").sample(spec, points, calc_second_order=second_order, seed=seed)
    else:
        group = d + 1
        X = _salib("sample.morris").sample(spec, points, num_levels=4, seed=seed)
    drawn = rounded(X, study.parameters)
    found = (evaluate or study.evaluate)(drawn)
    Y = np.asarray(found.Y if isinstance(found, StudyResult) else found, dtype=np.float64)
    if Y.shape != (len(X), len(study.figures)):
        raise ValueError(f"evaluate returned {Y.shape}: expected {(len(X), len(study.figures))}")
    whole = np.asarray(np.isfinite(Y).reshape(-1, group, Y.shape[1]).all(axis=1))  # (groups, m): one NaN spoils its group
    if (whole.sum(axis=0) < 2).all():
        raise ValueError(f"{int(np.isnan(Y).any(axis=1).sum())} of {len(Y)} points have no figures: no index can be computed")
    rows = []
    for figure, groups in zip(Y.T, whole.T):
        kept = np.repeat(groups, group)
        rows.append(_indices(method, spec, X[kept], figure[kept], second_order, seed) if groups.sum() > 1 else {})
    names = next(list(row) for row in rows if row)
    nothing = {name: np.full(next(row for row in rows if row)[name].shape, np.nan) for name in names}
    indices = {name: np.array([row.get(name, nothing[name]) for row in rows]) for name in names}
    return Sensitivity(method, study.heading.parameters, study.figures, indices, drawn, Y, group * (~whole).sum(axis=0))


def _indices(method: str, spec: Any, X: np.ndarray, figure: np.ndarray, second_order: bool, seed: int) -> dict[str, np.ndarray]:
    """Of one figure ``(n,)``, each ``(d,)`` or ``(d, d)``."""
    d = X.shape[1]
    with np.errstate(invalid="ignore", divide="ignore"):
        if method == "sobol":
            found = _salib("analyze.sobol").analyze(spec, figure, calc_second_order=second_order, seed=seed)
        else:
            found = _salib("analyze.morris").analyze(spec, X, figure, num_levels=4, seed=seed)
    numbers = {name: np.ma.filled(np.ma.asarray(values), np.nan) for name, values in found.items() if name != "names"}
    return {name: values.astype(np.float64) for name, values in numbers.items() if values.shape in ((d,), (d, d))}
