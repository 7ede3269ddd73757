"""What a study found: points, figures and reasons, for NumPy, pandas, xarray and files."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas
    import xarray


@dataclass(frozen=True)
class Heading:
    """Names and units of the columns of a result."""

    parameters: tuple[str, ...]
    parameter_units: tuple[str, ...]
    figures: tuple[str, ...]
    figure_units: tuple[str, ...]

    @property
    def units(self) -> dict[str, str]:
        """Of every column by its name."""
        return dict(zip((*self.parameters, *self.figures), (*self.parameter_units, *self.figure_units)))


@dataclass(frozen=True)
class StudyResult:
    """``X (n, d)``, a row for each point, ``Y (n, m)`` its figures, ``reasons (n,)`` why a row is all NaN, or "".

    >>> result["yaw rate gain"], result["chassis.mass_kg"]  # a column by its name
    """

    X: np.ndarray
    Y: np.ndarray
    reasons: list[str]
    heading: Heading

    @property
    def parameters(self) -> tuple[str, ...]:
        return self.heading.parameters

    @property
    def figures(self) -> tuple[str, ...]:
        return self.heading.figures

    @property
    def units(self) -> dict[str, str]:
        """Of every column by its name."""
        return self.heading.units

    @property
    def failed(self) -> np.ndarray:
        """Which points have no figures, ``(n,)`` of truth values."""
        return np.array([bool(reason) for reason in self.reasons], dtype=bool)

    def __len__(self) -> int:
        return len(self.X)

    def __getitem__(self, name: str) -> np.ndarray:
        if name in self.parameters:
            return self.X[:, self.parameters.index(name)]
        if name in self.figures:
            return self.Y[:, self.figures.index(name)]
        from difflib import get_close_matches

        near = get_close_matches(name, list(self.units), 1)
        raise KeyError(f"there is no column {name!r}" + (f"; did you mean {near[0]!r}?" if near else ""))

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each point; units in ``attrs``."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas needs pandas: pip install pandas") from error
        frame = pandas.DataFrame({**{name: self[name] for name in self.units}, "reason": self.reasons})
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """Parameters as coordinates and figures as variables along ``point``, with units."""
        try:
            import xarray
        except ImportError as error:
            raise ImportError("to_xarray needs xarray: pip install 'hamilcar[xarray]'") from error
        units = self.units
        data: dict[str, Any] = {name: ("point", self[name], {"units": units[name]}) for name in self.figures}
        data["reason"] = ("point", np.array(self.reasons, dtype=object))
        return xarray.Dataset(data, coords={name: ("point", self[name], {"units": units[name]}) for name in self.parameters})

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """A table with a column for each parameter and figure and ``reason``; units are in the fields' metadata."""
        from ._tables import write_parquet

        write_parquet(path, self, {})

    def to_npz(self, path: str | os.PathLike[str]) -> None:
        """Arrays ``X``, ``Y``, ``reasons`` and the names, for numpy.load."""
        from ._tables import write_npz

        write_npz(path, self, {})

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """A line for each point; numbers so that they read back to the same bits, no number where a figure is NaN."""
        with open(path, "w", newline="", encoding="utf-8") as file:
            table = csv.writer(file)
            table.writerow([*self.units, "reason"])
            for x, y, reason in zip(self.X.tolist(), self.Y.tolist(), self.reasons):
                table.writerow([*map(repr, x), *("" if value != value else repr(value) for value in y), reason])

    def write(self, path: str | os.PathLike[str]) -> None:
        """By the ending of the name: .parquet, .npz or .csv."""
        writers = {".parquet": self.to_parquet, ".npz": self.to_npz, ".csv": self.to_csv}
        ending = Path(path).suffix
        if ending not in writers:
            raise ValueError(f"{os.fspath(path)!r}: expected a name that ends in {', '.join(writers)}")
        writers[ending](path)

    def __repr__(self) -> str:
        lost = int(self.failed.sum())
        return f"<hamilcar.study.StudyResult: {len(self)} points, {len(self.figures)} figures, {lost} failed>"


def joined(parts: Sequence[StudyResult]) -> StudyResult:
    """Rows one below the other; all have the same columns."""
    X, Y = np.concatenate([p.X for p in parts]), np.concatenate([p.Y for p in parts])
    return StudyResult(X, Y, [reason for p in parts for reason in p.reasons], parts[0].heading)


def heading_to_json(heading: Heading) -> str:
    return json.dumps(heading.__dict__)


def heading_from_json(text: str) -> Heading:
    return Heading(**{key: tuple(value) for key, value in json.loads(text).items()})
