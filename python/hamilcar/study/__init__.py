"""Sweeps of parameters from a laptop to a cluster: ``evaluate(X (n, d)) -> Y (n, m)`` with names, bounds and units.

>>> from hamilcar.study import Parameter, Study, latin_hypercube
>>> study = Study("bmw_323i", [Parameter("chassis.mass_kg", 900, 1300)], ["yaw rate gain"], maneuver="step_steer")
>>> result = study.run(latin_hypercube(study.parameters, 64), "sweep", processes=4)
>>> result["yaw rate gain"]

NumPy is enough; Parquet, SciPy's Sobol sequence, SALib, pymoo, Optuna and Dask are used where they are installed.
"""

from ._analysis import Sensitivity, problem_spec, sensitivity
from ._designs import full_factorial, latin_hypercube, one_at_a_time, sobol
from ._optimize import optuna_objective, pymoo_problem
from ._parameters import Parameter
from ._progress import Progress
from ._result import StudyResult
from ._store import Folder, open_folder
from ._study import Study
from ._tables import read_table

__all__ = [
    "Folder",
    "Parameter",
    "Progress",
    "Sensitivity",
    "Study",
    "StudyResult",
    "full_factorial",
    "latin_hypercube",
    "one_at_a_time",
    "open_folder",
    "optuna_objective",
    "problem_spec",
    "pymoo_problem",
    "read_table",
    "sensitivity",
    "sobol",
]
