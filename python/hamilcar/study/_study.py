"""A study: parameters that are varied, what is driven with each point, and the figures that are wanted of it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .._documents import Scenario, Source, Vehicle
from ._cases import Rows
from ._description import case_of, columns_from, described
from ._figures import FigureColumn, Wanted, wanted_from
from ._parameters import Parameter, check_points
from ._progress import Shown
from ._result import Heading, StudyResult

if TYPE_CHECKING:
    from ._analysis import Sensitivity
    from ._run import Executor
    from ._store import Folder


class Study:
    """``evaluate(X (n, d)) -> Y (n, m)``: a row of figures for every row of parameters.

    One of these is evaluated with each point:

    * ``maneuver="step_steer"`` with ``settings``; ``figures`` are those of its outcome, all if none is named. It is driven once, in
      the middle of the ranges, when the study is made. ``scenario``: whose road and solver to drive with.
    * ``scenario=...`` to its end; ``figures`` are reductions of channels, ``"max chassis.yaw_rate"``: min, max, mean, rms, last and
      peak-to-peak over the rows of its output.
    * ``batch={"controls": {"steering_wheel": [...]}, "steps": 20, "speed": 20.0}``: all points of a chunk as cars of one Batch,
      with reductions over what is recorded after each row of controls; ``scenario`` as Batch takes it.
    * ``function=f``: f gets a dict of a point's values by name and returns a dict of figures, or the numbers in order. ``figures``
      are their names, or a dict of names and units; there is no vehicle then.

    A function may be among the figures: it gets the Outcome, the Results or a dict of the channels of one car (``record`` names
    channels that it needs beside those of the reductions, or in the place of a maneuver's default set) and returns a number.
    Functions at the top level of a module go to other processes, others work in this one alone.

    >>> study = Study("bmw_323i", [Parameter("chassis.mass_kg", 900, 1300)], ["yaw rate gain"], maneuver="step_steer")
    >>> study.evaluate([[1000.0], [1200.0]])
    """

    def __init__(
        self,
        vehicle: Vehicle | Source | None,
        parameters: Iterable[Parameter | Mapping[str, Any]],
        figures: Iterable[Wanted | FigureColumn] | Mapping[str, str] = (),
        *,
        maneuver: str | None = None,
        settings: Mapping[str, Any] | None = None,
        scenario: Scenario | Source | None = None,
        batch: Mapping[str, Any] | None = None,
        function: Callable[[dict[str, float]], Any] | None = None,
        record: Sequence[str] = (),
    ):
        self._description = described(vehicle, parameters, maneuver, settings, scenario, batch, function, record)
        self._case = case_of(self._description, figures)
        self.parameters = self._description.parameters
        names, columns = [p.name for p in self.parameters], self._case.columns
        for column in columns:
            if column.name in (*names, "reason"):
                raise ValueError(f"{column.name!r} names a figure and a parameter, or the reason: rename one")
        self.heading = Heading(
            tuple(names), tuple(p.unit for p in self.parameters), tuple(c.name for c in columns), tuple(c.unit for c in columns)
        )

    @property
    def figures(self) -> tuple[str, ...]:
        """The columns of ``Y``."""
        return self.heading.figures

    @property
    def units(self) -> dict[str, str]:
        """Of parameters and figures by name."""
        return self.heading.units

    @property
    def bounds(self) -> np.ndarray:
        """Of the parameters, ``(d, 2)``."""
        return np.array([[p.min, p.max] for p in self.parameters])

    @property
    def points_at_once(self) -> tuple[int, int]:
        """Of a chunk that has a good size: a batch fills its lanes, and what is driven one by one is not lost for long."""
        return (8, 256) if self._description.kind == "batch" else (1, 16)

    def rows(self, X: Any) -> Rows:
        """Figures ``(n, m)`` of points ``(n, d)``, and why a row is all NaN, or "", of each."""
        return self._case(check_points(X, self.parameters))

    def evaluate(self, X: Any) -> np.ndarray:
        """Figures ``(n, m)`` of points ``(n, d)``, here and now; NaN in the rows of points that cannot be driven."""
        return self.rows(X)[0]

    def run(
        self,
        X: Any,
        folder: str | os.PathLike[str] | None = None,
        *,
        chunk: int | None = None,
        processes: int = 0,
        retries: int = 2,
        progress: Shown = True,
    ) -> StudyResult:
        """Points ``(n, d)`` in chunks of ``chunk``, each kept in ``folder`` as soon as it is done; in so many ``processes``, 0 for
        this one.

        The same call goes on where one stopped, was killed or lost its machine. A chunk whose process dies is tried ``retries``
        times more; then its rows are NaN with that reason, and the next run tries it again. ``progress``: shown on stderr, or a
        function that gets a Progress after each chunk.
        """
        from ._processes import in_processes
        from ._run import in_this_process

        execute = in_processes(self, processes, retries) if processes else in_this_process(self)
        return self._sweep(X, folder, chunk, execute, progress)

    def run_dask(
        self,
        X: Any,
        folder: str | os.PathLike[str] | None,
        client: Any,
        *,
        chunk: int | None = None,
        retries: int = 2,
        progress: Shown = True,
    ) -> StudyResult:
        """As ``run``, on the workers of a dask.distributed ``client``. Workers send their rows; this process alone writes, so they
        need not see the folder. Files that the vehicle names must be at the same paths there."""
        from ._dask import on_dask

        return self._sweep(X, folder, chunk, on_dask(self, client, retries), progress)

    def _sweep(self, X: Any, folder: Any, chunk: int | None, execute: Executor, progress: Shown) -> StudyResult:
        from ._run import work_off
        from ._store import Folder, Store

        store = Store(self, X, chunk) if folder is None else Folder(folder, self, X, chunk)
        return store.load(work_off(store, range(store.chunks), execute, progress))

    def prepare(self, X: Any, folder: str | os.PathLike[str], *, chunk: int | None = None) -> Folder:
        """The folder for these points, to be worked off by ``python -m hamilcar.study``, here or on a cluster."""
        from ._store import Folder

        return Folder(folder, self, X, chunk)

    def sensitivity(self, method: str = "sobol", points: int = 64, **options: Any) -> Sensitivity:
        """Which parameters matter, by SALib: see ``hamilcar.study.sensitivity``."""
        from ._analysis import sensitivity

        return sensitivity(self, method, points, **options)

    def problem_spec(self) -> Any:
        """SALib's ProblemSpec with names, bounds and outputs."""
        from ._analysis import problem_spec

        return problem_spec(self)

    def pymoo_problem(self, objectives: Any, constraints: Any = None, **options: Any) -> Any:
        """A pymoo Problem: see ``hamilcar.study.pymoo_problem``."""
        from ._optimize import pymoo_problem

        return pymoo_problem(self, objectives, constraints, **options)

    def optuna_objective(self, objectives: Any, constraints: Any = None) -> Any:
        """An objective for Optuna: see ``hamilcar.study.optuna_objective``."""
        from ._optimize import optuna_objective

        return optuna_objective(self, objectives, constraints)

    def to_dict(self) -> dict[str, Any]:
        """All of it in what JSON has; ``from_dict`` makes the same again. Functions go by module and name."""
        return self._description.to_dict(self._case.columns)

    @staticmethod
    def from_dict(told: Mapping[str, Any]) -> Study:
        function: Any = None if told["function"] is None else wanted_from(told["function"])
        return Study(
            told["vehicle"], told["parameters"], columns_from(told["figures"]), maneuver=told["maneuver"],
            settings=told["settings"], scenario=told["scenario"], batch=told["batch"], function=function, record=told["record"],
        )

    def __reduce__(self) -> Any:
        return Study.from_dict, (self.to_dict(),)

    def __repr__(self) -> str:
        what = self._description.maneuver or self._description.kind
        return f"<hamilcar.study.Study of {what!r}: {len(self.parameters)} parameters, {len(self.figures)} figures>"
