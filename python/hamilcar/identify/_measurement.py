"""What is unknown and what was measured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from math import isfinite
from typing import Any, Union

import numpy as np

from .._documents import Scenario, Source


def _check_range(what: str, one: "Unknown | Free") -> None:
    if not one.min < one.max:
        raise ValueError(f"{what}: min = {one.min}, max = {one.max}: expected min < max")
    if one.nominal is not None and not one.min <= one.nominal <= one.max:
        raise ValueError(f"{what}: nominal = {one.nominal}: expected a value from {one.min} to {one.max}")
    if one.scale is not None and not one.scale > 0:
        raise ValueError(f"{what}: scale = {one.scale}: expected a positive number")
    if one.prior is not None and not (len(one.prior) == 2 and one.prior[1] > 0):
        raise ValueError(f"{what}: prior = {one.prior}: expected a mean and a positive standard deviation")


def scale_of(one: "Unknown | Free", start: float) -> float:
    """How far it may be off: what was given, or half the range, or its size."""
    if one.scale is not None:
        return one.scale
    half = 0.5 * (one.max - one.min)
    return half if isfinite(half) else abs(start) or 1.0


@dataclass(frozen=True)
class Unknown:
    """A number of the vehicle (or "road.friction") that is to be found between ``min`` and ``max``, in the unit of its name.

    ``nominal``: where the search begins; left out, what the vehicle has. ``prior``: mean and standard deviation of what is known
    about it beforehand. ``scale``: how far it may be off; left out, half of its range. ``multiplies``: names of several
    numbers that it is a factor of (a damper's table, say); ``name`` is free then, and nominal 1 if left out.
    """

    name: str
    min: float
    max: float
    nominal: float | None = None
    prior: tuple[float, float] | None = None
    scale: float | None = None
    multiplies: Sequence[str] = ()

    def __post_init__(self) -> None:
        if isinstance(self.multiplies, str):
            raise TypeError(f"{self.name}: multiplies: expected a list of names, not a text")
        _check_range(self.name, self)

    @property
    def parameters(self) -> list[str]:
        """The numbers of the vehicle that it changes."""
        return list(self.multiplies) or [self.name]


@dataclass(frozen=True)
class Free:
    """A delay [s], a bias [the channel's unit] or a gain [1] of the instruments that is to be found as well. Those with the same
    ``name`` are one unknown, in all measurements; without a name each is one of its own."""

    min: float
    max: float
    nominal: float | None = None
    prior: tuple[float, float] | None = None
    scale: float | None = None
    name: str = ""

    def __post_init__(self) -> None:
        _check_range(self.name or "Free", self)


Instrument = Union[float, Free, Mapping[str, Union[float, Free]]]


@dataclass(frozen=True, eq=False)
class Measurement:
    """One run: what was done to the car and what was measured, over time.

    ``time``: ``(t,)`` [s], increasing; the car starts at 0, straight ahead and settled, at ``speed`` [m/s], or in ``state``
    ``(s,)``. ``controls``: columns ``(t,)`` or numbers by the names of controls (SI units and radians), or an array ``(t, m)`` of
    all of them. ``measured``: columns ``(t,)`` by the names of channels, in the channels' units, NaN where a sample is missing.
    ``sd``: standard deviation of the noise, for all channels or for each. ``delay`` [s], ``bias`` and ``gain``: numbers or Free
    ones, for all channels or some of them. ``interval`` [s]: between rows of the rollout; left out, the time between two samples.
    """

    time: Any
    controls: Any
    measured: Mapping[str, Any]
    sd: float | Mapping[str, float]
    speed: float | None = None
    friction: float | None = None
    scenario: Scenario | Source | None = None
    powered: bool | None = None
    state: Any = None
    delay: Instrument = 0.0
    bias: Instrument = 0.0
    gain: Instrument = 1.0
    interval: float | None = None
    name: str = ""
    _sd: dict[str, float] = field(init=False, repr=False, default_factory=dict)

    def __post_init__(self) -> None:
        time = np.asarray(self.time, dtype=np.float64)
        if time.ndim != 1 or time.size < 2 or not np.all(np.diff(time) > 0) or not time[0] >= 0:
            raise ValueError(f"time of shape {time.shape}: expected (t,), increasing from 0 or later [s]")
        if not self.measured:
            raise ValueError("measured: expected at least one channel")
        columns = {name: np.asarray(values, dtype=np.float64) for name, values in self.measured.items()}
        for name, values in columns.items():
            if values.shape != time.shape:
                raise ValueError(f"{name} of shape {values.shape}: expected {time.shape}, one value for each time")
            self._sd[name] = self._sd_of(name)
        if self.interval is not None and not self.interval > 0:
            raise ValueError(f"interval = {self.interval}: expected a positive time [s]")
        for what in ("delay", "bias", "gain"):
            given = getattr(self, what)
            for name in given if isinstance(given, Mapping) else ():
                if name not in columns:
                    raise _unknown_name(f"{what}: {name!r} is not among what was measured", name, list(columns))
        object.__setattr__(self, "time", time)
        object.__setattr__(self, "measured", columns)

    def _sd_of(self, name: str) -> float:
        given = self.sd.get(name) if isinstance(self.sd, Mapping) else self.sd
        if given is None or not (isfinite(given) and given > 0):
            raise ValueError(f"sd of {name} = {given}: expected a positive standard deviation in the channel's unit")
        return float(given)

    def sd_of(self, channel: str) -> float:
        return self._sd[channel]

    def instruments_of(self, channel: str) -> Iterator[tuple[str, float | Free, float]]:
        """Delay, bias and gain of a channel, each with its default."""
        for what, default in (("delay", 0.0), ("bias", 0.0), ("gain", 1.0)):
            given = getattr(self, what)
            yield what, given.get(channel, default) if isinstance(given, Mapping) else given, default

    def rows(self, times: np.ndarray, names: Sequence[str], held: np.ndarray) -> np.ndarray:
        """Controls ``(t, m)`` at other times, linearly between samples; those that were not given stay where they are held."""
        if not isinstance(self.controls, Mapping):
            given = np.asarray(self.controls, dtype=np.float64)
            if given.shape != (self.time.size, len(names)):
                expected = (self.time.size, len(names))
                raise ValueError(f"controls of shape {given.shape}: expected {expected}, columns {list(names)}")
            columns: Mapping[str, Any] = dict(zip(names, given.T))
        else:
            columns = self.controls
        out = np.tile(held, (times.size, 1))
        for name, values in columns.items():
            if name not in names:
                raise _unknown_name(f"this car has no control {name!r}", name, names)
            column = np.asarray(values, dtype=np.float64)
            if column.shape not in ((), self.time.shape) or not np.all(np.isfinite(column)):
                raise ValueError(f"{name}: expected a finite number or finite values of shape {self.time.shape}")
            out[:, list(names).index(name)] = np.interp(times, self.time, np.broadcast_to(column, self.time.shape))
        return out


def _unknown_name(message: str, name: str, names: Sequence[str]) -> KeyError:
    near = get_close_matches(name, list(names), 1)
    return KeyError(message + (f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(names)}"))
