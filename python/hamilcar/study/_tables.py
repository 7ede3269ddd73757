"""Tables of a study on disk, whole or not there at all: Parquet with pyarrow, else NumPy's npz."""

from __future__ import annotations

import hashlib
import os
import socket
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ._result import Heading, StudyResult, heading_from_json, heading_to_json


class Damaged(Exception):
    """A table that is not what was written."""


def has_parquet() -> bool:
    try:
        import pyarrow.parquet  # noqa: F401
    except ImportError:
        return False
    return True


def write_whole(path: str | os.PathLike[str], write: Callable[[Path], None]) -> None:
    """``write`` fills a file beside ``path`` that takes its place when it is on the disk: readers see the old or the new one."""
    final = Path(path)
    beside = final.with_name(f".{final.name}.{socket.gethostname()}.{os.getpid()}.tmp")
    try:
        write(beside)
        _to_disk(beside)
        os.replace(beside, final)
    finally:
        beside.unlink(missing_ok=True)
    _to_disk(final.parent)  # the name, too


def _to_disk(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def checksum(result: StudyResult) -> str:
    """Of every bit of the rows and of their columns' names."""
    sum_ = hashlib.sha256(heading_to_json(result.heading).encode())
    for numbers in (result.X, result.Y):
        sum_.update(str(numbers.shape).encode())
        sum_.update(np.ascontiguousarray(numbers, dtype="<f8").tobytes())
    sum_.update("\0".join(result.reasons).encode())
    return sum_.hexdigest()


def _told(result: StudyResult, more: Mapping[str, str]) -> dict[str, str]:
    return {"heading": heading_to_json(result.heading), "checksum": checksum(result), **more}


def write_parquet(path: str | os.PathLike[str], result: StudyResult, more: Mapping[str, str]) -> None:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise ImportError("Parquet needs pyarrow: pip install 'hamilcar[study]'") from error
    fields, columns = [], []
    for name, unit in result.units.items():
        fields.append(pyarrow.field(name, pyarrow.float64(), metadata={"unit": unit}))
        columns.append(pyarrow.array(result[name]))
    fields.append(pyarrow.field("reason", pyarrow.string()))
    columns.append(pyarrow.array(result.reasons, pyarrow.string()))
    told = {f"hamilcar.{key}": value for key, value in _told(result, more).items()}
    table = pyarrow.Table.from_arrays(columns, schema=pyarrow.schema(fields, metadata=told))
    write_whole(path, lambda beside: pyarrow.parquet.write_table(table, beside))


def _read_parquet(path: Path) -> tuple[StudyResult, dict[str, str]]:
    import pyarrow.parquet

    # Not read_table: its threads may still let go of a Python object when the interpreter ends, which aborts the process.
    with pyarrow.parquet.ParquetFile(path) as file:
        table = file.read(use_threads=False)
    found = {key.decode(): value.decode() for key, value in (table.schema.metadata or {}).items()}
    told = {key.split(".", 1)[1]: value for key, value in found.items() if key.startswith("hamilcar.")}
    heading = heading_from_json(told["heading"])

    def columns(names: tuple[str, ...]) -> np.ndarray:
        return np.column_stack([table.column(name).to_numpy() for name in names]).astype(np.float64)

    return StudyResult(columns(heading.parameters), columns(heading.figures), table.column("reason").to_pylist(), heading), told


def write_npz(path: str | os.PathLike[str], result: StudyResult, more: Mapping[str, str]) -> None:
    told = _told(result, more)

    def write(beside: Path) -> None:
        with open(beside, "wb") as file:  # to which numpy adds no ending
            names = np.array([list(told), list(told.values())])
            np.savez(file, X=result.X, Y=result.Y, reasons=np.array(result.reasons, dtype=np.str_), told=names)

    write_whole(path, write)


def _read_npz(path: Path) -> tuple[StudyResult, dict[str, str]]:
    with np.load(path, allow_pickle=False) as file:
        told = dict(zip(*file["told"].tolist()))
        heading: Heading = heading_from_json(told["heading"])
        return StudyResult(file["X"], file["Y"], file["reasons"].tolist(), heading), told


def write_table(path: Path, result: StudyResult, more: Mapping[str, str]) -> None:
    (write_parquet if path.suffix == ".parquet" else write_npz)(path, result, more)


def read_table(path: str | os.PathLike[str]) -> tuple[StudyResult, dict[str, Any]]:
    """A table that ``write_table`` wrote, and what was told with it. Raises Damaged where it is another."""
    place = Path(path)
    try:
        result, told = (_read_parquet if place.suffix == ".parquet" else _read_npz)(place)
        right = told["checksum"] == checksum(result)
    except FileNotFoundError:
        raise
    except Exception as error:  # readers of broken files raise whatever their bytes lead to
        raise Damaged(f"{place}: not a table of a study, or broken ({type(error).__name__}: {error})") from error
    if not right:
        raise Damaged(f"{place}: its checksum is not that of its rows")
    return result, told
