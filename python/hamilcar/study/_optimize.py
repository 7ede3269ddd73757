"""Studies as problems of pymoo and objectives of Optuna.

Objectives are figures with what is wanted of them, ``{"roll gradient": "min", "yaw rate gain": 0.3}``: "min", "max" or a value to
come close to; a list of figures is minimized. Constraints are figures with their limits, ``{"steady sideslip": (-2.0, None)}``, in
the figures' units.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from ._designs import rounded
from ._parameters import Parameter

if TYPE_CHECKING:
    from ._study import Study

_WORST = 1e30  # of a point without figures: large, and finite since optimizers subtract

Objectives = Union[Mapping[str, Any], Sequence[str]]
Limits = Mapping[str, "tuple[float | None, float | None]"]


class Goals:
    """Objectives and constraints of a study's figures as numbers: smaller is better, at most 0 is feasible."""

    def __init__(self, study: Study, objectives: Objectives, constraints: Limits | None):
        if isinstance(objectives, str):
            raise TypeError("objectives: expected a dict, or a list of figures to minimize")
        self.objectives = dict(objectives) if isinstance(objectives, Mapping) else dict.fromkeys(objectives, "min")
        if not self.objectives:
            raise ValueError("objectives: expected at least one")
        self.names = list(study.figures)
        self.limits: list[tuple[str, str, float]] = []
        for name, want in self.objectives.items():
            self._place(name)
            if want not in ("min", "max") and (isinstance(want, (str, bool)) or not np.isfinite(want)):
                raise ValueError(f"objective {name!r}: {want!r}: expected 'min', 'max' or the value that is wanted")
        for name, ends in (constraints or {}).items():
            self._place(name)
            try:
                low, high = ends
            except (TypeError, ValueError) as error:
                raise ValueError(f"constraint {name!r}: {ends!r}: expected (low, high), None for no limit") from error
            self.limits += [(name, side, float(end)) for side, end in (("low", low), ("high", high)) if end is not None]

    def _place(self, name: str) -> int:
        if name not in self.names:
            near = get_close_matches(name, self.names, 1)
            hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(self.names)}"
            raise KeyError(f"the study has no figure {name!r}{hint}")
        return self.names.index(name)

    def costs(self, Y: np.ndarray) -> np.ndarray:
        """Figures ``(n, m)`` as costs ``(n, objectives)``."""
        out = []
        for name, want in self.objectives.items():
            values = Y[:, self._place(name)]
            out.append(values if want == "min" else -values if want == "max" else np.abs(values - want))
        return np.column_stack(out)

    def violations(self, Y: np.ndarray) -> np.ndarray:
        """How far figures ``(n, m)`` lie beyond their limits ``(n, limits)``, in their units."""
        columns = [
            end - Y[:, self._place(name)] if side == "low" else Y[:, self._place(name)] - end for name, side, end in self.limits
        ]
        return np.column_stack(columns) if columns else np.empty((len(Y), 0))


def pymoo_problem(
    study: Study,
    objectives: Objectives,
    constraints: Limits | None = None,
    *,
    evaluate: Callable[[np.ndarray], np.ndarray] | None = None,
) -> Any:
    """A pymoo Problem that evaluates a whole population at once. A point without figures violates one constraint more, which no
    other point does. What counts something is rounded. ``evaluate``: by which ``X`` becomes ``Y``."""
    try:
        from pymoo.core.problem import Problem
    except ImportError as error:
        raise ImportError("pymoo_problem needs pymoo: pip install 'hamilcar[design]'") from error
    goals = Goals(study, objectives, constraints)
    evaluated = evaluate or study.evaluate

    class StudyProblem(Problem):  # type: ignore[misc]
        def __init__(self) -> None:
            low, high = study.bounds.T
            super().__init__(
                n_var=len(low), n_obj=len(goals.objectives), n_ieq_constr=len(goals.limits) + 1, xl=low, xu=high
            )

        def _evaluate(self, x: np.ndarray, out: dict[str, Any], *_: Any, **__: Any) -> None:
            Y = evaluated(rounded(np.asarray(x, dtype=np.float64), study.parameters))
            F, G = goals.costs(Y), goals.violations(Y)
            lost = ~(np.isfinite(F).all(axis=1) & np.isfinite(G).all(axis=1))
            F[lost], G[lost] = _WORST, _WORST
            out["F"], out["G"] = F, np.column_stack([G, np.where(lost, _WORST, -1.0)])

    return StudyProblem()


def _suggested(trial: Any, p: Parameter) -> float:
    if p.whole:
        return float(trial.suggest_int(p.name, int(np.ceil(p.min)), int(np.floor(p.max))))
    return float(trial.suggest_float(p.name, p.min, p.max))


def optuna_objective(study: Study, objectives: Objectives, constraints: Limits | None = None) -> Any:
    """A function of an Optuna trial, for ``optuna.create_study(directions=["minimize"] * k)``: costs to be minimized, one number or
    a tuple. A trial without figures is pruned, and its user attribute ``reason`` says why; figures are user attributes, too."""
    try:
        import optuna
    except ImportError as error:
        raise ImportError("optuna_objective needs Optuna: pip install 'hamilcar[design]'") from error
    goals = Goals(study, objectives, constraints)

    def objective(trial: Any) -> Any:
        point = [_suggested(trial, p) for p in study.parameters]
        Y, reasons = study.rows([point])
        costs, violations = goals.costs(Y)[0], goals.violations(Y)[0]
        if not (np.isfinite(costs).all() and np.isfinite(violations).all()):
            reason = reasons[0] or "a figure that is wanted is NaN"
            trial.set_user_attr("reason", reason)
            raise optuna.TrialPruned(reason)
        for name, value in zip(study.figures, Y[0]):
            trial.set_user_attr(name, float(value))
        for (name, side, _), violation in zip(goals.limits, violations):
            trial.set_constraint(f"{name} {side}", float(violation))
        return float(costs[0]) if len(costs) == 1 else tuple(map(float, costs))

    return objective
