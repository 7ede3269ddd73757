"""Chunks in processes of this machine.

A process has one chunk at a time, so when it dies, by a signal or for want of memory, it is known which chunk it had: that one is
tried again in a new process, and the others never notice. concurrent.futures would charge every chunk under way. Processes are
spawned, since threads of C++ do not survive a fork; they make the study again from JSON.
"""

from __future__ import annotations

import json
import multiprocessing
import signal
from collections import Counter, deque
from collections.abc import Generator, Iterator
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING

from ._run import Done, Executor, Task

if TYPE_CHECKING:
    from ._study import Study


def _serve(connection: Connection, told: str) -> None:
    """What a process does: the study, then its rows for each array of points that comes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the driver's, which ends its processes
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    from ._study import Study

    study = Study.from_dict(json.loads(told))
    try:
        connection.send(None)
        while True:
            connection.send(study.rows(connection.recv()))
    except (EOFError, OSError):
        return  # the driver is gone


class _Worker:
    def __init__(self, told: str):
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs, told), daemon=True)
        self.process.start()
        theirs.close()  # so that its death closes the pipe
        self.ready = False
        self.task: Task | None = None

    def give(self, task: Task) -> None:
        self.task = task
        with suppress(OSError):  # it has died: that shows when it is waited for
            self.connection.send(task[1])

    def end(self) -> None:
        self.process.terminate()
        self.process.join(5)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()
        self.connection.close()

    def why(self) -> str:
        self.process.join(5)
        code = self.process.exitcode
        if code is not None and code < 0:
            return f"signal {signal.Signals(-code).name}"
        return f"exit code {code}"


class _Pool:
    def __init__(self, told: str, processes: int, retries: int, tasks: list[Task]):
        self._told, self._retries = told, retries
        self._queue = deque(tasks)
        self._deaths: Counter[int] = Counter()
        self._deaths_at_start = 0
        self.workers = [_Worker(told) for _ in range(min(processes, len(tasks)))]

    @property
    def is_busy(self) -> bool:
        return bool(self._queue) or any(worker.task for worker in self.workers)

    def _next(self, worker: _Worker) -> None:
        if self._queue:
            worker.give(self._queue.popleft())

    def _buried(self, worker: _Worker) -> Done | None:
        """A worker that died: another takes its place, its chunk is tried again or given up."""
        why = worker.why()
        self.workers.remove(worker)
        worker.end()
        if not worker.ready:
            self._deaths_at_start += 1
            if self._deaths_at_start > self._retries:
                raise RuntimeError(
                    f"processes of the study end as they start ({why}; above is what they say). A script must begin its work below"
                    ' `if __name__ == "__main__":`, since processes import it; functions must be in modules that they find'
                )
        self.workers.append(_Worker(self._told))
        if worker.task is None:
            return None
        number = worker.task[0]
        self._deaths[number] += 1
        if self._deaths[number] <= self._retries:
            self._queue.append(worker.task)  # behind the others, so that these come first
            return None
        return number, None, f"its process ended {self._deaths[number]} times, the last time by {why}"

    def step(self) -> Iterator[Done]:
        """Waits until something happens, and tells what is done."""
        sources: dict[object, _Worker] = {}
        for worker in self.workers:
            sources[worker.connection] = sources[worker.process.sentinel] = worker
        happened = wait(list(sources))  # type: ignore[arg-type]
        for worker in list(dict.fromkeys(sources[source] for source in happened)):
            try:
                if not worker.connection.poll():
                    raise EOFError
                rows = worker.connection.recv()
            except (EOFError, OSError):
                done = self._buried(worker)
                if done:
                    yield done
                continue
            task, worker.task = worker.task, None
            if not worker.ready:
                worker.ready = True
                task = None
            self._next(worker)  # before its rows are written, so that it does not wait
            if task:
                yield task[0], rows, ""
        self._wake_idle()

    def _wake_idle(self) -> None:
        """A chunk to be tried again goes to a process that had run out of work."""
        for worker in self.workers:
            if worker.ready and worker.task is None:
                self._next(worker)


def in_processes(study: Study, processes: int, retries: int) -> Executor:
    """``processes`` of them; a chunk whose process died is tried ``retries`` times more."""
    for name, value, least in (("processes", processes, 1), ("retries", retries, 0)):
        if isinstance(value, bool) or not isinstance(value, int) or value < least:
            raise ValueError(f"{name} = {value!r}: expected a whole number, at least {least}")
    told = json.dumps(study.to_dict())

    def execute(tasks: list[Task]) -> Generator[Done, None, None]:
        pool = _Pool(told, processes, retries, tasks)
        try:
            while pool.is_busy:
                yield from pool.step()
        finally:
            for worker in pool.workers:
                worker.end()

    return execute
