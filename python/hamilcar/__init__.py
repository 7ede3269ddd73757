"""Wheeled vehicles with their real linkages, by Hamilton's equations.

>>> import hamilcar
>>> car = hamilcar.Vehicle("bmw_323i")
>>> result = hamilcar.maneuver("step_steer", car, speed=80)
>>> simulation = hamilcar.Simulation(car, speed=20.0)
>>> simulation.step(100, steering_wheel=0.5)
>>> simulation["chassis.yaw_rate"]

Numbers are in SI units and radians where the program takes them; channels have the units that people read, told by
``units``. Axes are those of ISO 8855: x forward, y left, z up.
"""

from pathlib import Path as _Path

from . import _core

if (_Path(__file__).parent / "share" / "hamilcar").is_dir():
    _core.set_shipped_folder(str(_Path(__file__).parent / "share" / "hamilcar"))

from ._batch import Batch
from ._documents import Scenario, Vehicle, shipped_scenarios, shipped_vehicles
from ._errors import AccessError, Error, InputError, NumericalError
from ._linear import LinearModel, Mode, linearize
from ._maneuver import Figure, Outcome, Verdict, maneuver
from ._results import Results, read
from ._rollout import Rollout
from ._run import run
from ._simulation import Simulation

__version__ = _core.version
__all__ = [
    "AccessError",
    "Batch",
    "Error",
    "Figure",
    "InputError",
    "LinearModel",
    "Mode",
    "NumericalError",
    "Outcome",
    "Results",
    "Rollout",
    "Scenario",
    "Simulation",
    "Vehicle",
    "Verdict",
    "linearize",
    "maneuver",
    "read",
    "run",
    "shipped_scenarios",
    "shipped_vehicles",
]
