"""A sweep: chunks that are missing are evaluated somewhere and kept as they come."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable
from contextlib import closing
from typing import TYPE_CHECKING, Optional

import numpy as np

from ._cases import Rows
from ._progress import Counter, Shown
from ._store import Store

if TYPE_CHECKING:
    from ._study import Study

Task = tuple[int, np.ndarray]  # a chunk's number and its points
Done = tuple[int, Optional[Rows], str]  # its rows, or None and why there are none
Executor = Callable[[list[Task]], Generator[Done, None, None]]


def in_this_process(study: Study) -> Executor:
    def execute(tasks: list[Task]) -> Generator[Done, None, None]:
        for number, X in tasks:
            yield number, study.rows(X), ""

    return execute


def work_off(store: Store, numbers: Iterable[int], execute: Executor, progress: Shown) -> dict[int, str]:
    """Evaluates those of the chunks ``numbers`` that are missing. Returns why, of each that could not be."""
    tasks: list[Task] = []
    chosen = list(numbers)
    counter = Counter(sum(len(store.points(number)) for number in chosen), progress)
    for number in chosen:
        found = store.find(number)
        if found is None:
            tasks.append((number, store.points(number)))
        else:
            counter.found(len(found), int(found.failed.sum()))
    troubles: dict[int, str] = {}
    try:
        with closing(execute(tasks)) as running:  # which stops its workers, also after Ctrl-C
            for number, rows, trouble in running:
                points = len(store.points(number))
                if rows is None:
                    troubles[number] = trouble
                    counter.add(points, points)
                else:
                    store.keep(number, rows)
                    counter.add(points, sum(map(bool, rows[1])))
    finally:
        counter.end()
    return troubles
