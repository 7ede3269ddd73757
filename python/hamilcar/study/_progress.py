"""How far a sweep is."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Union


@dataclass(frozen=True)
class Progress:
    """``done`` of ``total`` points, those from earlier runs among them; ``failed`` of them have no figures. ``rate``: points a
    second of this run; ``remaining``: seconds at that rate, NaN before there is one."""

    done: int
    total: int
    failed: int
    rate: float
    remaining: float

    def __str__(self) -> str:
        left = "" if self.remaining != self.remaining else f", {_duration(self.remaining)} left"
        return f"{self.done}/{self.total} points, {self.failed} failed, {self.rate:.3g}/s{left}"


Shown = Union[bool, Callable[[Progress], None]]


def _duration(seconds: float) -> str:
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02d}:{whole % 60:02d}"


class Counter:
    """Counts points and shows them: on a terminal in one line that changes, else in a line every ten seconds; or to a function."""

    def __init__(self, total: int, shown: Shown):
        self._total, self._shown = total, shown
        self._done = self._failed = self._here = 0
        self._begin = time.monotonic()
        self._last = -float("inf")
        self._terminal = shown is True and sys.stderr is not None and sys.stderr.isatty()

    def found(self, points: int, failed: int) -> None:
        """Of an earlier run."""
        self._done += points
        self._failed += failed

    def add(self, points: int, failed: int) -> None:
        self._here += points
        self.found(points, failed)
        self._show(last=False)

    def end(self) -> None:
        if self._shown is True:
            self._show(last=True)

    def _progress(self) -> Progress:
        rate = self._here / max(time.monotonic() - self._begin, 1e-9)
        remaining = (self._total - self._done) / rate if rate > 0 else float("nan")
        return Progress(self._done, self._total, self._failed, rate, remaining)

    def _show(self, last: bool) -> None:
        if callable(self._shown):
            self._shown(self._progress())
            return
        now = time.monotonic()
        if not self._shown or sys.stderr is None or not (last or now - self._last > (0.2 if self._terminal else 10)):
            return
        self._last = now
        begin, end = ("\r\x1b[K", "\n" if last else "") if self._terminal else ("", "\n")
        print(f"{begin}hamilcar.study: {self._progress()}", end=end, file=sys.stderr, flush=True)
