"""One car, step by step: controls, channels, snapshots."""

import threading

import numpy as np
import pytest

import hamilcar


def test_controls_arrive_where_they_are_told_to(car):
    simulation = hamilcar.Simulation(car, speed=20.0)
    assert set(simulation.controls) == {"steering_wheel", "throttle", "brake"}
    simulation.step(20, steering_wheel=0.3, throttle=0.5)
    assert simulation.controls["steering_wheel"] == pytest.approx(0.3, abs=1e-12)
    assert simulation["input.steering_wheel"] == pytest.approx(np.degrees(0.3))
    simulation.step(400)
    assert simulation.controls["steering_wheel"] == pytest.approx(0.3, abs=1e-12)
    assert simulation["chassis.yaw_rate"] > 1
    assert simulation.time == pytest.approx(0.42)


def test_without_power_units_a_torque_drives(car):
    simulation = hamilcar.Simulation(car, speed=10.0, powered=False)
    assert "drive_torque" in simulation.controls
    simulation.step(1000, drive_torque=500.0)
    faster = simulation["chassis.speed"]
    simulation.step(1000, drive_torque=0.0, brake=0.5)
    assert 10.5 < faster and simulation["chassis.speed"] < 8


def test_gears_change_by_themselves(car):
    simulation = hamilcar.Simulation(car)
    gears = set()
    for _ in range(500):
        simulation.step(20, throttle=1.0)
        gears.add(simulation["input.gear"])
    assert {1, 2, 3} <= gears
    assert simulation["chassis.speed"] > 25


def test_follows_the_scenario_until_a_control_is_named():
    scripted = hamilcar.Simulation("bmw_323i", "step_steer")
    scripted.step(2000)
    alone = hamilcar.run("step_steer", channels=["chassis.yaw_rate"], interval=0.001)
    assert scripted["chassis.yaw_rate"] == alone["chassis.yaw_rate"][2000]
    scripted.step(2000, steering_wheel=0.0)
    assert abs(scripted["chassis.yaw_rate"]) < 0.1 < alone["chassis.yaw_rate"][4000]


def test_comes_back_bit_for_bit(car):
    simulation = hamilcar.Simulation(car, speed=15.0)
    simulation.step(300, steering_wheel=0.4, throttle=0.7)
    place, where = simulation.save(), simulation.state
    simulation.step(500, steering_wheel=-0.4, throttle=0.1)
    first = simulation.state
    simulation.restore(place)
    assert np.array_equal(simulation.state, where)
    simulation.step(500, steering_wheel=-0.4, throttle=0.1)
    assert np.array_equal(simulation.state, first)
    simulation.reset()
    assert simulation.time == 0
    simulation.step(300, steering_wheel=0.4, throttle=0.7)
    assert np.array_equal(simulation.state, where)


def test_reset_brings_the_scenarios_inputs_back():
    simulation = hamilcar.Simulation("bmw_323i", "step_steer")
    simulation.step(1500)
    expected = simulation.state
    simulation.reset()
    simulation.step(1500, steering_wheel=1.0)
    simulation.reset()
    simulation.step(1500)
    assert np.array_equal(simulation.state, expected)


def test_reads_several_channels_at_once(car):
    simulation = hamilcar.Simulation(car, speed=15.0)
    simulation.step(100, steering_wheel=0.4)
    names = ["chassis.speed", "chassis.yaw_rate", "front_left.wheel.load"]
    values = simulation.read(names)
    assert values.dtype == np.float64 and values.shape == (3,)
    assert list(values) == [simulation[name] for name in names]
    assert simulation.channels["front_left.wheel.load"][0] == "N"
    assert np.all(np.isfinite(simulation.read(simulation.channels)))


def test_says_what_ended_it():
    scenario = {
        "name": "short", "vehicle": hamilcar.Vehicle("bmw_323i").source, "duration_s": 10.0,
        "initial": {"velocity_m_per_s": 10.0}, "driver": {"ending": {"distance_m": 5.0}},
    }
    simulation = hamilcar.Simulation("bmw_323i", scenario)
    assert simulation.ended is None
    simulation.step(2000)
    assert simulation.ended.startswith("distance reached 5.0")
    assert simulation.time < 0.6


def test_a_car_that_cannot_go_on_says_why_and_keeps_its_last_good_state(car):
    simulation = hamilcar.Simulation(
        car.changed({"axle.front.spring.rate_N_per_m": 9e8, "axle.rear.spring.rate_N_per_m": 9e8}), speed=30.0, step=0.01
    )
    with pytest.raises(hamilcar.NumericalError, match="the results end at") as told:
        simulation.step(5000, steering_wheel=3.0)
    assert told.value.exit_code == 4
    assert np.all(np.isfinite(simulation.state))


def test_state_is_a_copy_with_names(car):
    simulation = hamilcar.Simulation(car, speed=15.0)
    state = simulation.state
    assert len(simulation.state_names) == len(state)
    state[:] = 0
    assert np.any(simulation.state != 0)


def test_one_simulation_in_two_threads_is_told(car):
    """Or works, where the two happen not to meet; it never crashes."""
    simulation = hamilcar.Simulation(car, speed=15.0)
    told = []

    def work():
        for _ in range(20):
            try:
                simulation.step(2000)
            except RuntimeError as error:
                told.append(str(error))

    threads = [threading.Thread(target=work) for _ in range(3)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert told and all("another thread" in one for one in told)


def test_several_simulations_run_in_threads_at_once(car):
    simulations = [hamilcar.Simulation(car, speed=15.0) for _ in range(4)]
    threads = [threading.Thread(target=lambda s=s: s.step(3000, steering_wheel=0.2)) for s in simulations]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all(np.array_equal(s.state, simulations[0].state) for s in simulations)
