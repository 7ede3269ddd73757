"""Whole runs of scenarios."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from . import _core
from ._documents import Scenario, Source, Vehicle, as_vehicle
from ._results import Results


def run(
    scenario: Scenario | Source,
    vehicle: Vehicle | Source | None = None,
    *,
    channels: Sequence[str] | None = None,
    interval: float | None = None,
    picture: bool = True,
) -> Results:
    """Drives a scenario to its end.

    ``vehicle`` takes the place of the one that the scenario names. ``channels``: names, or beginnings of names with ``*``; those of
    the scenario's ``[output]`` if left out. ``interval``: between two rows [s], 0 for every step. ``picture``: record also
    what a replay is drawn from. Raises NumericalError where the run cannot go on; what it recorded so far is its
    ``results`` then. For a scenario of a maneuver use ``hamilcar.maneuver``.
    """
    scenario = scenario if isinstance(scenario, Scenario) else Scenario(scenario)
    if scenario._core.maneuver:
        raise ValueError(f"this scenario is the maneuver {scenario._core.maneuver!r}: use hamilcar.maneuver")
    vehicle = as_vehicle(vehicle if vehicle is not None else scenario.vehicle)
    if channels is None:
        output: Any = scenario.to_dict().get("output", {})
        channels = output.get("channels", [])
    step_between = scenario._core.interval if interval is None else interval
    rows, summary, warnings = _core.run(vehicle._core, scenario._core, list(channels), step_between, picture)
    told = {
        "duration_s": summary.duration,
        "steps": summary.steps,
        "wall_time_s": summary.wall_time,
        "real_time_factor": summary.real_time_factor,
        "max_violation_m": summary.max_violation,
        "max_balance_error_J": summary.max_balance_error,
        "energy_exchanged_J": summary.energy_exchanged,
    }
    results = Results(rows, told, warnings)
    if summary.ended_early is not None:
        from ._errors import NumericalError

        error = NumericalError(summary.ended_early, 4)
        error.results = results  # type: ignore[attr-defined]
        raise error
    return results
