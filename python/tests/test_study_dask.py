"""Sweeps on Dask whose workers and scheduler are killed while they work."""

import os
import signal
import socket
import subprocess
import sys
from contextlib import contextmanager

import numpy as np
import pytest
from study_help import POINTS, assert_whole, evaluated, mortal_square, notes, slow_square, study_of, workers_of  # noqa: F401

from hamilcar.study import Parameter, Study, latin_hypercube, open_folder

distributed = pytest.importorskip("distributed")
pytestmark = pytest.mark.filterwarnings("ignore")


@contextmanager
def cluster(workers):
    with (
        distributed.LocalCluster(n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None) as local,
        distributed.Client(local) as client,
    ):
        yield client


def test_a_worker_that_is_killed_loses_nothing(notes, tmp_path):
    with cluster(2) as client:
        workers = client.run(os.getpid)
        assert len(set(workers.values())) == 2
        killed = []

        def kill_one(progress):
            if progress.done >= 4 and not killed:
                killed.append(next(iter(workers.values())))
                os.kill(killed[0], signal.SIGKILL)

        result = study_of(slow_square).run_dask(POINTS, tmp_path / "f", client, chunk=2, progress=kill_one)
        assert killed and workers_of(notes) > set(killed)  # a third took over
        assert_whole(result)
        assert len(list((tmp_path / "f").glob("chunk_*"))) == 10
        before = len(evaluated(notes))
        assert_whole(study_of(slow_square).run_dask(POINTS, tmp_path / "f", client, progress=False))
        assert len(evaluated(notes)) == before  # all of it was there


def test_a_chunk_that_kills_its_workers_is_given_up(notes, tmp_path):
    import dask

    with dask.config.set({"distributed.scheduler.allowed-failures": 1}), cluster(1) as client:
        result = study_of(mortal_square).run_dask(POINTS[17:], tmp_path / "f", client, chunk=3, progress=False)
    assert len(result) == 3 and np.isnan(result.Y).all() and all("KilledWorker" in reason for reason in result.reasons)
    assert not list((tmp_path / "f").glob("chunk_*")) and evaluated(notes).count(17.0) == 2


def test_a_scheduler_that_is_killed_ends_the_run_and_another_goes_on(notes, tmp_path):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"127.0.0.1:{free.getsockname()[1]}"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    start = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--no-dashboard", "--host", *address.split(":")]
    start.insert(-1, "--port")
    scheduler = subprocess.Popen(start, **quiet)
    worker = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    others = [subprocess.Popen(worker, **quiet)]
    try:
        client = distributed.Client(address, timeout=20)
        client.wait_for_workers(1, timeout=20)

        def kill(progress):
            if progress.done >= 6:
                scheduler.kill()

        with pytest.raises(ConnectionError, match="Run again with a new client"):
            study_of(slow_square).run_dask(POINTS, tmp_path / "f", client, chunk=2, progress=kill)
        client.close(timeout=2)
    finally:
        for process in (scheduler, *others):
            process.kill()
            process.wait()
    found = [number for number in range(10) if open_folder(tmp_path / "f").find(number) is not None]
    assert 3 <= len(found) < 10
    before = evaluated(notes)
    with cluster(1) as client:
        assert_whole(study_of(slow_square).run_dask(POINTS, tmp_path / "f", client, progress=False))
    again = evaluated(notes)
    for number in found:
        assert all(again.count(a) == before.count(a) for a in POINTS[2 * number : 2 * number + 2, 0])


def test_workers_give_the_bits_of_this_process(car):
    batch = {"controls": {"steering_wheel": [0.1, 0.4, 0.8]}, "steps": 50, "speed": 20.0, "powered": False}
    study = Study(car, [Parameter("chassis.mass_kg", 900, 1300)], ["max chassis.rate.yaw"], batch=batch)
    X = latin_hypercube(study.parameters, 9)
    with cluster(1) as client:
        assert np.array_equal(study.run_dask(X, None, client, chunk=4, progress=False).Y, study.evaluate(X))
