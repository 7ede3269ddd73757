"""What a reader of the package found: each of these went wrong once."""

import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import hamilcar


def test_cars_have_their_own_steering_ratio_and_stops(car):
    batch = hamilcar.Batch(car, 2, speed=20.0, vary=["steering.rack_m_per_revolution", "steering.rack_travel_m"])
    batch.expand("steering.rack_m_per_revolution")[1] *= 1.2
    batch.expand("steering.rack_travel_m")[1] *= 0.5
    batch.reset()
    batch.step(50, steering_wheel=0.5)
    for i in range(2):
        alone = hamilcar.Simulation(batch.vehicle_of(i), speed=20.0)
        alone.step(50, steering_wheel=0.5)
        assert np.array_equal(batch.states[i], alone.state)
        assert np.array_equal(batch.read(batch.channels)[i], alone.read(alone.channels))
    with pytest.raises(ValueError, match="steering_wheel"):
        batch.step(50, steering_wheel=9.0)


def test_cars_have_their_own_hardpoints_in_every_channel(car):
    name = "axle.front.hardpoints.arm_front_m.0"
    batch = hamilcar.Batch(car, 2, speed=20.0, vary=[name])
    batch.expand(name)[1] += 0.003
    batch.reset()
    batch.step(300, steering_wheel=0.5)
    alone = hamilcar.Simulation(batch.vehicle_of(1), speed=20.0)
    alone.step(300, steering_wheel=0.5)
    assert np.array_equal(batch.read(batch.channels)[1], alone.read(alone.channels))


def test_gears_change_as_well_where_the_throttle_is_named_every_time(car):
    named, once = hamilcar.Simulation(car, speed=8.0), hamilcar.Simulation(car, speed=8.0)
    once.step(20, throttle=1.0)
    named.step(20, throttle=1.0)
    lowest = 1.0
    for _ in range(300):
        once.step(20)
        named.step(20, throttle=1.0)
        lowest = min(lowest, named["input.throttle"])
    assert lowest < 0.1  # while a gear changed
    assert np.array_equal(once.state, named.state)


def test_a_refused_reset_changes_no_car(car):
    batch = hamilcar.Batch(car, 3, speed=20.0, vary=["chassis.mass_kg"])
    batch.step(100)
    before = batch.states
    batch.expand("chassis.mass_kg")[:2] = [1400.0, 1e9]
    with pytest.raises(hamilcar.NumericalError):
        batch.reset()
    assert np.array_equal(batch.states, before)
    batch.expand("chassis.mass_kg")[:2] = car["chassis.mass_kg"]
    batch.reset()
    assert np.array_equal(batch.states[0], batch.states[2])


def test_what_says_the_same_in_another_way_overrides_or_is_refused(car):
    curve = {"steering.angle_deg": [0.0, 360.0], "steering.rack_m": [0.0, 0.05]}
    other = car.changed(curve)
    alone = hamilcar.Simulation(other, speed=20.0)
    alone.step(50, steering_wheel=1.0)
    assert alone["input.rack"] == pytest.approx(0.05 / (2 * np.pi), rel=1e-6)
    assert hamilcar.Vehicle(other.to_dict()).to_dict() == other.to_dict()
    again = hamilcar.Simulation(pickle.loads(pickle.dumps(other)), speed=20.0)
    again.step(50, steering_wheel=1.0)
    assert np.array_equal(again.state, alone.state)
    back = other.changed({"steering.rack_m_per_revolution": 0.04})
    assert "angle_deg" not in back.to_dict()["steering"]
    with pytest.raises(hamilcar.InputError, match="not both"):
        car.changed({**curve, "steering.rack_m_per_revolution": 0.05})


@pytest.mark.parametrize("value", [10**5000, "\ud800", type("Odd", (), {"__repr__": lambda self: 1 / 0})()], ids=["digits", "half", "repr"])
def test_values_that_cannot_even_be_shown_are_refused(car, value):
    with pytest.raises((ValueError, TypeError, OverflowError, ZeroDivisionError, hamilcar.Error)):
        car["chassis.mass_kg"] = value
    with pytest.raises(TypeError):
        car.update({1: 2})


def test_a_vehicle_may_change_while_another_thread_drives_it(car):
    done = threading.Event()

    def change():
        i = 0
        while not done.is_set():
            i += 1
            car.update({"name": f"car {i}" * (1 + i % 50), "chassis.mass_kg": 1000.0 + i % 9})

    thread = threading.Thread(target=change)
    thread.start()
    try:
        for _ in range(15):
            hamilcar.run("step_steer", car, interval=0.1)
            hamilcar.linearize(car, speed=10.0)
    finally:
        done.set()
        thread.join()


def test_reading_while_another_thread_steps_is_told(car):
    batch = hamilcar.Batch(car, 8, speed=20.0)
    thread = threading.Thread(target=lambda: batch.step(200_000))
    thread.start()
    told = 0
    while thread.is_alive():
        for look in (lambda: batch.times, lambda: batch.ended, lambda: batch.why(0), lambda: batch.states):
            try:
                look()
            except RuntimeError:
                told += 1
    thread.join()
    assert told > 0


@pytest.mark.parametrize("make", [lambda car: hamilcar.Simulation(car, speed=20.0), lambda car: hamilcar.Batch(car, 8, speed=20.0)], ids=["simulation", "batch"])
def test_ctrl_c_is_heard_and_the_rack_does_not_jump(car, make):
    one = make(car)
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        one.step(100_000_000, steering_wheel=1.0)
    assert time.monotonic() - begin < 5
    assert np.all(np.abs(np.atleast_1d(one["input.steering_wheel"])) < 0.01)  # on its slow way
    one.step(10)


def test_snapshots_of_another_gearbox_are_refused(car):
    fewer = car.changed({"power_unit.engine.gearbox.ratios": [3.83, 2.2]})
    place = hamilcar.Simulation(car, speed=20.0).save()
    with pytest.raises(ValueError, match="another structure"):
        hamilcar.Simulation(fewer, speed=20.0).restore(place)
    with pytest.raises(ValueError, match="another structure"):
        hamilcar.Simulation("formula", speed=20.0).restore(place)
    with pytest.raises(ValueError, match="method or step"):
        hamilcar.Simulation(car, speed=20.0, step=5e-4).restore(place)


def test_a_rollout_without_controls_is_time_all_the_same(car, driven):
    batch = hamilcar.Batch(car, 3, driven)
    assert batch.control_names == []
    rolled = batch.rollout(np.zeros((5, 3, 0)), steps=20, record=["chassis.position.x"])
    assert rolled["chassis.position.x"].shape == (5, 3)
    assert batch.times[0] == pytest.approx(0.1)


def test_texts_are_no_lists_of_names(car):
    with pytest.raises(TypeError, match="not a text"):
        hamilcar.Batch(car, 1, vary="chassis.mass_kg")
    with pytest.raises(TypeError, match="not a text"):
        hamilcar.Simulation(car).read("chassis.speed")
    for wrong in (-1.0, float("nan")):
        with pytest.raises(ValueError, match="interval"):
            hamilcar.run("step_steer", car, interval=wrong)
    with pytest.raises(ValueError, match="1.0000001: expected 0 to 1"):
        hamilcar.Simulation(car).step(1, brake=1.0000001)
    with pytest.raises(ValueError, match="a finite number"):
        hamilcar.Simulation(car, powered=False).step(1, drive_torque=float("inf"))
    with pytest.raises(ValueError, match="cannot vary by itself"):
        hamilcar.Batch("truck_semitrailer", 1, vary=["axle.1.drive_share"])


def test_folders_that_lie_about_are_not_taken_for_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bmw_323i").mkdir()
    assert hamilcar.Vehicle("bmw_323i").wheels
