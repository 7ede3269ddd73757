"""Chunks on the workers of dask.distributed.

Workers get points and return rows, and this process alone writes: a chunk that two workers evaluate, because one was thought
dead, is kept once. What a dead worker had, Dask gives to another; when the scheduler dies, the run ends, and the same call with a
new client goes on.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Generator
from typing import TYPE_CHECKING, Any

import numpy as np

from ._cases import Rows
from ._run import Done, Executor, Task

if TYPE_CHECKING:
    from ._study import Study

_made = threading.local()  # a batch belongs to one thread at a time, so each thread of a worker has its own study


def rows_of(X: np.ndarray, told: str) -> Rows:
    """What a worker does; the study is made once for all chunks that it gets."""
    if getattr(_made, "told", None) != told:
        from ._study import Study

        _made.study, _made.told = Study.from_dict(json.loads(told)), told
    rows: Rows = _made.study.rows(X)
    return rows


def _rows_or_trouble(future: Any) -> tuple[Rows | None, str]:
    from distributed import CancelledError
    from distributed.comm import CommClosedError

    try:
        return future.result(), ""
    except (CancelledError, CommClosedError) as error:
        raise ConnectionError("Dask has lost the study: is the scheduler gone? Run again with a new client to go on") from error
    except Exception as error:  # noqa: BLE001  whatever ended the worker, or kept it from making the study
        return None, f"{type(error).__name__}: {error}"


def on_dask(study: Study, client: Any, retries: int) -> Executor:
    """``retries``: of a chunk that raised; of one whose worker died, Dask's own ``distributed.scheduler.allowed-failures``, which
    counts all chunks that a worker had in its queue when it died."""
    try:
        from distributed import as_completed
    except ImportError as error:
        raise ImportError("run_dask needs dask.distributed: pip install 'hamilcar[dask]'") from error
    told = json.dumps(study.to_dict())

    def execute(tasks: list[Task]) -> Generator[Done, None, None]:
        if not tasks:
            return
        futures = client.map(rows_of, [X for _, X in tasks], told=told, pure=False, retries=retries, key="hamilcar-study")
        numbers = {future.key: number for future, (number, _) in zip(futures, tasks)}
        try:
            completed = as_completed(futures)
            for future in completed:
                if future.status in ("lost", "pending"):  # its rows died with their worker: Dask evaluates them again
                    completed.add(future)
                    continue
                yield (numbers[future.key], *_rows_or_trouble(future))
                future.release()
        finally:
            if client.status == "running":
                client.cancel(futures, force=True)

    return execute
