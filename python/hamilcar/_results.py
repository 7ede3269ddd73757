"""Rows of a run as arrays, with units; for NumPy, xarray, matplotlib and notebooks."""

from __future__ import annotations

import os
from collections.abc import Iterator
from difflib import get_close_matches
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    import xarray


def channel_error(name: str, known: Any, what: str = "is no channel of this car", else_hint: str = "") -> KeyError:
    near = get_close_matches(name, list(known), 1)
    return KeyError(f"{name!r} {what}" + (f"; did you mean {near[0]!r}?" if near else "") + else_hint)


class Results:
    """Channels over time: ``result["chassis.yaw_rate"]`` is an array of one number a row, ``result.units`` has its unit.

    >>> result = hamilcar.run("step_steer")
    >>> result["chassis.lateral_acceleration"].max()
    """

    def __init__(self, rows: _core.Rows, summary: dict[str, Any] | None = None, warnings: list[str] | None = None):
        self._rows = rows
        self._number = {name: i for i, (name, _, _) in enumerate(rows.columns)}
        self._cache: dict[str, np.ndarray] = {}
        self.name = rows.name
        self.summary = summary or {}
        self.warnings = warnings or []

    @property
    def names(self) -> list[str]:
        return [name for name in self._number if name != "time"]

    @property
    def units(self) -> dict[str, str]:
        return {name: unit for name, unit, _ in self._rows.columns}

    @property
    def meanings(self) -> dict[str, str]:
        return {name: meaning for name, _, meaning in self._rows.columns}

    @property
    def time(self) -> np.ndarray:
        """Of every row [s]."""
        return self["time"]

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._cache:
            if name not in self._number:
                raise channel_error(name, self._number, "was not recorded", "; record others by channels=[...]")
            values = self._rows.column(self._number[name])
            values.flags.writeable = False
            self._cache[name] = values
        return self._cache[name]

    def __contains__(self, name: object) -> bool:
        return name in self._number

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.time)

    def to_xarray(self) -> "xarray.Dataset":
        """A Dataset along ``time`` with the units and meanings as attributes."""
        import xarray

        data = {
            name: ("time", self[name], {"units": self.units[name], "long_name": self.meanings[name]})
            for name in self.names
        }
        time = ("time", self.time, {"units": "s", "long_name": self.meanings["time"]})
        return xarray.Dataset(data, coords={"time": time}, attrs={"title": self.name, **self.summary})

    def to_netcdf(self, path: str | os.PathLike[str]) -> None:
        """A file as the command line writes it, that ``hamilcar view`` shows."""
        self._rows.write_netcdf(os.fspath(path))

    def to_html(self, path: str | os.PathLike[str]) -> None:
        """A page with the replay and the plots of all channels."""
        Path(path).write_text(self._page(), encoding="utf-8")

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Channels over time, one diagram below the other. Returns matplotlib's axes, an array."""
        import matplotlib.pyplot as plt

        for name in names:
            self[name]  # a name that is none is told before anything is drawn
        chosen = names or tuple(self.names[:4])
        if axes is None:
            _, axes = plt.subplots(len(chosen), 1, sharex=True, squeeze=False, layout="constrained", figsize=(8, 2.2 * len(chosen)))
        flat = list(np.atleast_1d(axes).ravel())
        if len(flat) != len(chosen):
            raise ValueError(f"expected {len(chosen)} axes for {len(chosen)} channels, found {len(flat)}")
        for axis, name in zip(flat, chosen):
            axis.plot(self.time, self[name])
            unit = self.units[name]
            axis.set_ylabel(name if unit == "1" else f"{name}\n[{unit}]")
            axis.grid(alpha=0.3)
        flat[-1].set_xlabel("time [s]")
        return np.array(flat)

    def _page(self) -> str:
        return self._rows.page(self.name, "")

    def _repr_html_(self) -> str:
        return f'<iframe style="width:100%;height:640px;border:0" srcdoc="{escape(self._page())}"></iframe>'

    def __repr__(self) -> str:
        return f"<hamilcar.Results {self.name!r}: {len(self.names)} channels, {len(self)} rows to {self.time[-1]:g} s>"


def read(path: str | os.PathLike[str]) -> Results:
    """The results.nc of a run on disk."""
    return Results(_core.read_rows(os.fspath(path)))
