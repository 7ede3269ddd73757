"""Where a sweep keeps what it has: in memory, or in a folder that survives whatever happens to the program.

A folder has ``manifest.json`` (the study, its checksum and that of the points, the size of a chunk), ``points.npy`` and a table
``chunk_00042`` for each chunk that is done, which appears whole or not at all. Chunk k are the rows ``[k size, (k + 1) size)``,
always; its table names the study and holds its points, so that nothing is counted for another and nothing twice.
"""

from __future__ import annotations

import hashlib
import json
import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from ._cases import Rows
from ._description import fingerprint
from ._parameters import check_points
from ._result import StudyResult, joined
from ._tables import Damaged, has_parquet, read_table, write_table, write_whole

if TYPE_CHECKING:
    from ._study import Study

NOT_EVALUATED = "not evaluated"


class Store:
    """The chunks of a sweep, in memory."""

    def __init__(self, study: Study, X: Any, chunk: int | None):
        self.study = study
        self.X = check_points(X, study.parameters)
        if len(self.X) == 0:
            raise ValueError("X has no rows: expected at least one point")
        if chunk is not None and (isinstance(chunk, bool) or not isinstance(chunk, (int, np.integer)) or chunk < 1):
            raise ValueError(f"chunk = {chunk!r}: expected a whole number of points, at least 1")
        self.chunk = int(chunk or _usual_chunk(len(self.X), *study.points_at_once))
        self._kept: dict[int, StudyResult] = {}

    @property
    def chunks(self) -> int:
        return -(-len(self.X) // self.chunk)

    def points(self, number: int) -> np.ndarray:
        return self.X[number * self.chunk : (number + 1) * self.chunk]

    def result(self, number: int, rows: Rows) -> StudyResult:
        Y, reasons = rows
        points = self.points(number)
        if Y.shape != (len(points), len(self.study.figures)) or len(reasons) != len(points):
            raise ValueError(f"chunk {number}: figures of shape {Y.shape}: expected {(len(points), len(self.study.figures))}")
        return StudyResult(points, Y, list(reasons), self.study.heading)

    def keep(self, number: int, rows: Rows) -> None:
        self._kept[number] = self.result(number, rows)

    def find(self, number: int) -> StudyResult | None:
        """What a chunk gave, or None where it has to be evaluated."""
        return self._kept.get(number)

    def without_figures(self, number: int, reason: str) -> StudyResult:
        count = len(self.points(number))
        return self.result(number, (np.full((count, len(self.study.figures)), np.nan), [reason] * count))

    def load(self, troubles: dict[int, str] | None = None) -> StudyResult:
        """All rows in order; of a chunk that is not there NaN, with its trouble as the reason."""
        told = troubles or {}
        parts = []
        for number in range(self.chunks):
            found = self.find(number)
            parts.append(found if found is not None else self.without_figures(number, told.get(number, NOT_EVALUATED)))
        return joined(parts)


def _usual_chunk(points: int, least: int, most: int) -> int:
    """So that there are 64 chunks for processes to share, none large, and a thousand at the utmost: each is a file."""
    return max(least, min(most, -(-points // 64)), -(-points // 1000))


class Folder(Store):
    """The chunks of a sweep in a folder: opened if it holds this study and these points, else made. ``chunk`` is that of the folder
    if there is one."""

    def __init__(self, path: str | os.PathLike[str], study: Study, X: Any, chunk: int | None = None):
        super().__init__(study, X, chunk)
        self.path = Path(path).resolve()
        mine = self._manifest()
        if (self.path / "manifest.json").exists():
            self._compare(read_manifest(self.path), mine)
        else:
            self.path.mkdir(parents=True, exist_ok=True)
            write_whole(self.path / "points.npy", self._write_points)
            text = json.dumps(mine, indent=1)
            write_whole(self.path / "manifest.json", lambda beside: _write_text(beside, text))
            self._tables = mine["tables"]
        self._told = {"study": mine["fingerprint"]}
        self._remove_leftovers()

    def _manifest(self) -> dict[str, Any]:
        told = self.study.to_dict()
        return {
            "format": 1,
            "hamilcar": _core.version,
            "study": told,
            "fingerprint": fingerprint(told),
            "points": {"count": len(self.X), "checksum": checksum_of_points(self.X)},
            "chunk": self.chunk,
            "tables": "parquet" if has_parquet() else "npz",
        }

    def _compare(self, there: dict[str, Any], mine: dict[str, Any]) -> None:
        if there["hamilcar"] != mine["hamilcar"]:
            raise ValueError(f"{self.path}: begun by hamilcar {there['hamilcar']}, this is {mine['hamilcar']}: use another folder")
        if there["fingerprint"] != mine["fingerprint"]:
            differing = [key for key in mine["study"] if there["study"].get(key) != mine["study"][key]]
            what = ", ".join(differing) or "a file that the vehicle or the scenario names"
            raise ValueError(f"{self.path} holds another study, different in {what}: use another folder")
        if there["points"] != mine["points"]:
            raise ValueError(
                f"{self.path} holds other points: {there['points']['count']} there, {len(self.X)} here: use another folder"
            )
        self.chunk = there["chunk"]
        self._tables = there["tables"]
        if self._tables == "parquet" and not has_parquet():
            raise ImportError(f"{self.path} holds Parquet, which needs pyarrow: pip install 'hamilcar[study]'")

    def _write_points(self, beside: Path) -> None:
        with open(beside, "wb") as file:
            np.save(file, self.X)

    def _remove_leftovers(self) -> None:
        """Files of programs that were killed while they wrote; none writes for an hour."""
        for file in self.path.glob(".*.tmp"):
            try:
                if time.time() - file.stat().st_mtime > 3600:
                    file.unlink()
            except FileNotFoundError:
                pass  # another task's, which has just finished it

    def table(self, number: int) -> Path:
        return self.path / f"chunk_{number:05d}.{self._tables}"

    def keep(self, number: int, rows: Rows) -> None:
        write_table(self.table(number), self.result(number, rows), {**self._told, "chunk": str(number)})

    def find(self, number: int) -> StudyResult | None:
        try:
            result, told = read_table(self.table(number))
        except (FileNotFoundError, Damaged):
            return None
        right = (
            told.get("study") == self._told["study"]
            and told.get("chunk") == str(number)
            and result.heading == self.study.heading
            and np.array_equal(result.X, self.points(number))
            and result.Y.shape == (len(result.X), len(self.study.figures))
        )
        return result if right else None


def _write_text(path: Path, text: str) -> None:
    path.write_text(text, encoding="utf-8")


def checksum_of_points(X: np.ndarray) -> str:
    return hashlib.sha256(str(X.shape).encode() + np.ascontiguousarray(X, dtype="<f8").tobytes()).hexdigest()


def read_manifest(path: str | os.PathLike[str]) -> dict[str, Any]:
    place = Path(path) / "manifest.json"
    try:
        told: dict[str, Any] = json.loads(place.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise FileNotFoundError(f"{os.fspath(path)} holds no study: there is no {place.name}") from error
    except ValueError as error:
        raise ValueError(f"{place} is broken: {error}") from error
    if told.get("format") != 1:
        raise ValueError(f"{place}: format {told.get('format')!r}: expected 1")
    return told


def open_folder(path: str | os.PathLike[str]) -> Folder:
    """The study and the points that a folder was made for, with what is done of them."""
    from ._study import Study

    told = read_manifest(path)
    X = np.load(Path(path) / "points.npy", allow_pickle=False)
    if checksum_of_points(X) != told["points"]["checksum"]:
        raise ValueError(f"{os.fspath(path)}/points.npy is not what the manifest was written for")
    return Folder(path, Study.from_dict(told["study"]), X, told["chunk"])
