"""For tests of sweeps: functions that other processes import, what they leave behind, and the command."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import hamilcar
from hamilcar.study import Parameter, Study

A = [Parameter("a", 0.0, 100.0)]
POINTS = np.arange(20.0).reshape(-1, 1)


def note(point):
    """Each evaluation leaves a file: what was evaluated, how often and by which process."""
    folder = os.environ.get("HAMILCAR_TEST_NOTES")
    if folder:
        (Path(folder) / f"{point['a']:g}.{os.getpid()}.{time.monotonic_ns()}").touch()


def square_alone(point):
    if point["a"] == 13.0:
        raise ValueError("unlucky")
    return [point["a"] ** 2]


def square(point):
    note(point)
    return square_alone(point)


def slow_square(point):
    time.sleep(0.1)
    return square(point)


def gated_square(point):
    """From 4 on it waits until the test lets it go on, so that what is killed has work left."""
    note(point)
    end = time.monotonic() + 60
    while point["a"] >= 4 and not (Path(os.environ["HAMILCAR_TEST_NOTES"]) / "go").exists() and time.monotonic() < end:
        time.sleep(0.02)
    return square_alone(point)


def mortal_square(point):
    """Dies at 5 the first time, at 17 always."""
    note(point)
    first = Path(os.environ["HAMILCAR_TEST_NOTES"]) / "died"
    if point["a"] == 5.0 and not first.exists():
        first.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    if point["a"] == 17.0:
        os._exit(7)
    return [point["a"] ** 2]


def study_of(function):
    return Study(None, A, ["square"], function=function)


@pytest.fixture
def notes(tmp_path, monkeypatch):
    folder = tmp_path / "notes"
    folder.mkdir()
    monkeypatch.setenv("HAMILCAR_TEST_NOTES", str(folder))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(Path(__file__).parent), str(Path(hamilcar.__file__).parents[1])]))
    return folder


def evaluated(notes):
    """The points, once for each time."""
    return sorted(float(file.name.rsplit(".", 2)[0]) for file in notes.glob("*.*"))


def workers_of(notes):
    return {int(file.name.split(".")[-2]) for file in notes.glob("*.*")}


def assert_whole(result, lost=()):
    """All rows once and in order, computed here by another way."""
    assert result.X.tolist() == POINTS.tolist()
    for a, (figure,), reason in zip(POINTS[:, 0], result.Y, result.reasons):
        if a == 13.0 or a in lost:
            assert np.isnan(figure) and reason
        else:
            assert figure == a * a and reason == ""


def wait_until(true, seconds=20.0):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def command(*arguments, **options):
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen([sys.executable, "-m", "hamilcar.study", *map(str, arguments)], **pipes, **options)


def done(*arguments):
    process = command(*arguments)
    out, err = process.communicate(timeout=60)
    return process.returncode, out, err
