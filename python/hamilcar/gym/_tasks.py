"""The tasks that come with hamilcar, by their names."""

from __future__ import annotations

import copy
from difflib import get_close_matches

from ._circuit import Drift, RacingLine
from ._lanes import LaneChange, LaneKeeping
from ._maneuvering import Parking, SplitFrictionBraking
from ._task import Task

TASKS: dict[str, type[Task]] = {
    task.__name__: task for task in (LaneKeeping, LaneChange, RacingLine, Drift, Parking, SplitFrictionBraking)
}


def as_task(task: Task | str) -> Task:
    """A task of its own for an environment, from one or from its name, "LaneKeeping" or "hamilcar/LaneKeeping-v0"."""
    if isinstance(task, Task):
        return copy.deepcopy(task)
    if not isinstance(task, str):
        raise TypeError(f"task: expected a name or a Task, not {type(task).__name__}")
    name = task.removeprefix("hamilcar/").removesuffix("-v0")
    if name in TASKS:
        return TASKS[name]()
    near = get_close_matches(name, TASKS, 1)
    hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(TASKS)}"
    raise ValueError(f"there is no task {task!r}{hint}")
