"""What is dropped is freed: the process does not grow."""

import gc
from pathlib import Path

import numpy as np
import pytest

import hamilcar


def megabytes():
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="Linux tells how large a process is")
def test_stays_as_large_as_it_was(car):
    simulation = hamilcar.Simulation(car, speed=10.0)
    batch = hamilcar.Batch(car, 16, speed=10.0, vary=["chassis.mass_kg"])

    def work(count):
        for i in range(count):
            hamilcar.Simulation(car, speed=10.0).save()
            simulation.step(100, steering_wheel=0.01)
            simulation.read(["chassis.speed"])
            batch.expand("chassis.mass_kg")[i % 16] = 1000.0 + i % 7
            batch.reset([i % 16])
            batch.step(2, np.zeros((16, 3)))
            simulation.restore(simulation.save())

    work(100)
    before = megabytes()
    work(1000)
    assert megabytes() - before < 4


def test_what_is_read_outlives_its_owner():
    values = hamilcar.run("step_steer", interval=0.1)["chassis.position.x"]
    state = hamilcar.Simulation(speed=3.0).state
    gc.collect()
    assert values.sum() > 0 and np.isfinite(state).all()
