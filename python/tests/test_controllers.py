"""Controllers on and off, commands from outside, and a steering that hands hold."""

import numpy as np
import pytest

import hamilcar

WHEELS = ("front_left", "front_right", "rear_left", "rear_right")
OUTSIDE = {"controller": [{"kind": "external", "rate_hz": 200.0}]}


@pytest.fixture(scope="module")
def sedan():
    """With anti-lock system, traction control and stability control."""
    return hamilcar.Vehicle("bmw_e90_330i")


@pytest.fixture(scope="module")
def told(sedan):
    """The same, told from outside alone."""
    return hamilcar.Vehicle(sedan, OUTSIDE)


def test_a_command_brakes_one_wheel_and_turns_the_car(told):
    for side, other, sign in (("left", "right", 1), ("right", "left", -1)):
        simulation = hamilcar.Simulation(told, speed=25.0, powered=False)
        name = f"front_{side}.brake.pump"
        assert simulation.commands[name] == 0 == simulation[f"command.{name}"]
        simulation.commands.update({name: 1.0, f"front_{side}.brake.inlet": 0.0})
        simulation.step(300)
        assert simulation.commands[name] == 1 == simulation[f"command.{name}"]
        assert simulation[f"front_{side}.brake.pressure"] > 20
        assert simulation[f"front_{other}.brake.pressure"] < 1e-3
        assert sign * simulation["chassis.yaw_rate"] > 1


def test_commands_have_names_units_and_ranges(told):
    simulation = hamilcar.Simulation(told, speed=5.0)
    names = [f"{wheel}.brake.{what}" for wheel in WHEELS for what in ("inlet", "outlet", "pump")]
    names += ["engine.max_throttle", "engine.min_throttle"]
    assert list(simulation.commands) == names == list(simulation.command_info)
    assert len(simulation.commands) == 14 and "engine.max_throttle" in simulation.commands
    assert all(f"command.{name}" in simulation.channels for name in names)
    unit, meaning, rest, low, high = simulation.command_info["front_left.brake.inlet"]
    assert (unit, rest, low, high) == ("1", 1, 0, 1) and "valve" in meaning
    assert dict(simulation.commands) == {name: info[2] for name, info in simulation.command_info.items()}


def test_commands_go_back_with_the_run(told):
    simulation = hamilcar.Simulation(told, speed=20.0)
    at_rest = dict(simulation.commands)
    simulation.commands.update({"rear_left.brake.pump": 0.7, "engine.max_throttle": 0.3})
    simulation.step(100, throttle=1.0)
    place = simulation.save()
    simulation.step(300)
    first = simulation.state
    simulation.commands.update(at_rest)
    simulation.step(50)
    simulation.restore(place)
    assert simulation.commands["rear_left.brake.pump"] == 0.7 and simulation.commands["engine.max_throttle"] == 0.3
    simulation.step(300)
    assert np.array_equal(simulation.state, first)
    simulation.reset()
    assert dict(simulation.commands) == at_rest


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda s: s.commands["front_left.brake.inlt"], KeyError, "did you mean 'front_left.brake.inlet'"),
        (lambda s: s.commands["command.front_left.brake.pump"], KeyError, "did you mean 'front_left.brake.pump'"),
        (lambda s: s.commands.update({"front_left.brake.inlet": 0.0, "pump": 1.0}), KeyError, "'pump' is no command of this car"),
        (lambda s: s.commands.update({"front_left.brake.inlet": 0.0, "engine.max_throttle": 2.0}), ValueError,
         "engine.max_throttle = 2: expected 0 to 1"),
        (lambda s: s.commands.__setitem__("front_left.brake.inlet", float("nan")), ValueError, "not a NaN"),
        (lambda s: s.commands.__setitem__("front_left.brake.inlet", "shut"), ValueError, "expected a number"),
        (lambda s: s.commands.__setitem__("front_left.brake.inlet", None), ValueError, "not a NaN"),
        (lambda s: s.commands.__setitem__("front_left.brake.inlet", [0.0, 1.0]), ValueError, "expected a number"),
        (lambda s: s.controllers["externl"], KeyError, "did you mean 'external'"),
        (lambda s: s.controllers["esc"], KeyError, "expected one of external"),
        (lambda s: s.controllers.__setitem__("external", 1), TypeError, "expected True or False"),
    ],
)
def test_what_is_wrong_changes_nothing(told, call, error, words):
    simulation = hamilcar.Simulation(told, speed=20.0)
    before = dict(simulation.commands)
    with pytest.raises(error, match=words):
        call(simulation)
    assert dict(simulation.commands) == before and dict(simulation.controllers) == {"external": True}


def test_a_car_without_controllers_takes_no_commands(sedan):
    for simulation in (hamilcar.Simulation("bmw_323i"), hamilcar.Simulation(sedan, controllers=False)):
        assert len(simulation.commands) == 0 and not simulation.command_info and len(simulation.controllers) == 0
        with pytest.raises(KeyError, match=r'\[\[controller\]\] in the vehicle, kind = "external"'):
            simulation.commands["front_left.brake.inlet"] = 0.0
        with pytest.raises(KeyError, match="it has none"):
            simulation.controllers["esc"] = False
    batch = hamilcar.Batch("bmw_323i", 2)
    assert batch.command_names == [] and batch.commands.shape == (2, 0)
    with pytest.raises(KeyError, match="takes no commands"):
        batch.set_commands(np.zeros((2, 0)))
    with pytest.raises(TypeError, match="expected True or False"):
        hamilcar.Simulation(sedan, controllers="esc")


def swerve(simulation):
    """The largest sideslip [deg] and activity of the stability control of a swerve of 0.7 Hz with a dwell, 80 km/h on wet road."""
    sideslip = activity = 0.0
    for step in range(200):
        time = 0.02 * step
        phase = time * 0.7 if time < 0.75 / 0.7 else max(0.75, 0.7 * (time - 0.5))
        simulation.step(20, steering_wheel=2.5 * np.sin(2 * np.pi * phase) if phase < 1 else 0.0)
        sideslip = max(sideslip, abs(simulation["chassis.sideslip"]))
        activity = max(activity, simulation["esc.activity"])
    return sideslip, activity


def test_a_controller_is_switched_off_and_on(sedan):
    simulation = hamilcar.Simulation(sedan, speed=80 / 3.6, friction=0.7)
    assert dict(simulation.controllers) == {"abs": True, "traction_control": True, "esc": True}
    slip, activity = swerve(simulation)
    assert activity > 0.1
    simulation.reset()
    simulation.controllers["esc"] = False
    assert dict(simulation.controllers) == {"abs": True, "traction_control": True, "esc": False}
    slip_off, activity_off = swerve(simulation)
    assert activity_off == 0 and slip_off > 1.5 * slip
    simulation.reset()
    assert simulation.controllers["esc"] is True
    assert swerve(simulation) == (slip, activity)


def brake_on_ice(simulation):
    simulation.step(50, brake=1.0)
    simulation.step(1000)
    return simulation


def test_controllers_false_has_the_bits_of_controllers_off(sedan):
    plain = {
        "name": "ice", "vehicle": sedan.source, "duration_s": 9.0, "road": {"friction": 0.3},
        "initial": {"velocity_m_per_s": 15.0},
    }
    off = brake_on_ice(hamilcar.Simulation(sedan, {**plain, "controllers_off": ["all"]}))
    assert np.array_equal(brake_on_ice(hamilcar.Simulation(sedan, plain, controllers=False)).state, off.state)
    assert np.array_equal(
        brake_on_ice(hamilcar.Simulation(hamilcar.Vehicle(sedan, {"controllers": False}), plain)).state, off.state
    )
    batch = brake_on_ice(hamilcar.Batch(sedan, 2, plain, controllers=False))
    assert np.array_equal(batch.states[1], off.state)
    on = brake_on_ice(hamilcar.Simulation(sedan, plain))
    assert off["front_left.wheel.spin"] < 1 < on["front_left.wheel.spin"]  # one locks, the other does not
    back = brake_on_ice(hamilcar.Simulation(sedan, {**plain, "controllers_off": ["all"]}, controllers=True))
    assert np.array_equal(back.state, on.state)
    assert "command.front_left.brake.inlet" not in hamilcar.Simulation(sedan, plain, controllers=False).channels


def keep_turning(simulation, radius):
    """One decision of an anti-lock system: valves by each wheel's slip."""
    speed, *spins = simulation.read(["chassis.speed", *(f"{wheel}.wheel.spin" for wheel in WHEELS)])
    for wheel, spin in zip(WHEELS, spins):
        slip = 1 - spin * np.pi / 30 * radius / speed
        too_much, enough = slip > 0.2, slip > 0.1
        simulation.commands.update({
            f"{wheel}.brake.inlet": 0.0 if enough else 1.0,
            f"{wheel}.brake.outlet": 1.0 if too_much else 0.0,
        })


def full_stop(vehicle, decide):
    """Meters from 80 km/h to 10 km/h by a full brake, and how fast the slowest front wheel turned above 30 km/h [rpm], once the
    brakes had half a second to build up."""
    simulation = hamilcar.Simulation(vehicle, speed=80 / 3.6, powered=False, friction=0.8)
    slowest = np.inf
    while (speed := simulation["chassis.speed"]) > 10 / 3.6:
        if decide:
            keep_turning(simulation, 0.29)
        if simulation.time > 0.5 and speed > 30 / 3.6:
            slowest = min(slowest, *simulation.read(["front_left.wheel.spin", "front_right.wheel.spin"]))
        simulation.step(5, brake=1.0)
        assert simulation.time < 10
    return simulation["chassis.position.x"], slowest


def test_an_anti_lock_system_in_python_stops_shorter_than_locked_wheels():
    magic_formula = hamilcar.Vehicle("bmw_323i").to_dict()["tire"]["road"]
    car = hamilcar.Vehicle("hatchback", {**OUTSIDE, "tire.road": magic_formula})
    locked, standing = full_stop(car, False)
    stopped, turning = full_stop(car, True)
    assert abs(standing) < 1 and turning > 50
    assert stopped < 0.95 * locked


def test_a_batch_tells_each_car(told):
    shares = np.linspace(0, 1, 5)
    batch = hamilcar.Batch(told, 5, speed=25.0, powered=False)
    k = len(batch.command_names)
    assert batch.command_names[2] == "front_left.brake.pump" and batch.command_info["front_left.brake.pump"][0] == "1"
    batch.step(100)
    batch.set_commands({"front_left.brake.inlet": 0.0, "front_left.brake.pump": shares})
    batch.step(300)
    yaw = batch["chassis.yaw_rate"]
    assert (np.diff(yaw) > 0.1).all()
    for i in (1, 4):
        alone = hamilcar.Simulation(told, speed=25.0, powered=False)
        alone.step(100)
        alone.commands.update({"front_left.brake.inlet": 0.0, "front_left.brake.pump": shares[i]})
        alone.step(300)
        assert np.array_equal(alone.state, batch.states[i])
    row = np.full(k, np.nan)
    row[2] = 0.5
    batch.set_commands(row, which=[0, 3])
    assert np.array_equal(batch.commands[:, 2], [0.5, 0.25, 0.5, 0.5, 1.0])
    everything = batch.commands
    everything[:, 0] = 0.25
    batch.set_commands(everything)
    assert np.array_equal(batch.commands, everything)
    batch.set_commands({"front_left.brake.inlet": [0.5, 1.0]}, which=np.array([False, True, False, False, True]))
    assert np.array_equal(batch.commands[:, 0], [0.25, 0.5, 0.25, 0.25, 1.0])
    batch.reset([1])
    assert np.array_equal(batch.commands[1], [info[2] for info in batch.command_info.values()])
    for values, error, words in (
        (np.zeros((4, k)), ValueError, r"expected \(5, 12\) or \(12,\)"),
        (np.full(k, 2.0), ValueError, "front_left.brake.inlet = 2: expected 0 to 1"),
        ({"front_left.brake.pmp": 0.0}, KeyError, "did you mean 'front_left.brake.pump'"),
        ({"front_left.brake.pump": np.zeros(4)}, ValueError, r"array of shape \(5,\)"),
        ("all", ValueError, "could not convert"),
    ):
        with pytest.raises(error, match=words):
            batch.set_commands(values)


def test_a_batch_shows_what_controllers_do(sedan):
    channels = ["abs.activity", "esc.activity", "command.front_left.brake.outlet", "front_left.brake.pressure"]
    alone = hamilcar.Simulation(sedan, speed=15.0, friction=0.3, powered=False)
    batch = hamilcar.Batch(sedan, 2, speed=15.0, friction=0.3, powered=False)
    most = np.zeros(4)
    for _ in range(60):
        for car in (alone, batch):
            car.step(10, brake=1.0)
        assert np.array_equal(batch.read(channels)[1], alone.read(channels))
        most = np.maximum(most, alone.read(channels))
    assert most[0] > 0 and most[2] > 0.5


def test_a_snapshot_belongs_to_the_controllers_of_its_car(sedan, told):
    place = hamilcar.Simulation(sedan, speed=10.0).save()
    hamilcar.Simulation(sedan, speed=20.0).restore(place)
    for other in (hamilcar.Simulation(told), hamilcar.Simulation(sedan, controllers=False)):
        with pytest.raises(ValueError, match="other controllers"):
            other.restore(place)


def test_a_steering_wheel_that_is_let_go_comes_back(sedan):
    simulation = hamilcar.Simulation(sedan, speed=15.0, powered=False, steering_mechanics=True)
    assert {"hands", "steering_torque"} < set(simulation.controls)
    assert simulation.control_info["steering_torque"][0] == "N m"
    simulation.step(1500, steering_wheel=1.0, drive_torque=150.0)
    held = simulation["steering.wheel"]
    assert held == pytest.approx(np.degrees(1.0), abs=1.0)
    simulation.step(50, hands=0.0)
    simulation.step(3000)
    assert abs(simulation["steering.wheel"]) < 0.2 * held
    assert abs(simulation["steering.hands_torque"]) < 1e-9


def test_a_torque_of_the_hands_steers(sedan):
    torques = np.array([-3.0, 0.0, 3.0])
    batch = hamilcar.Batch(sedan, 3, speed=20.0, powered=False, steering_mechanics=True)
    batch.step(100, hands=0.0, drive_torque=150.0)
    batch.step(1000, steering_torque=torques)
    wheel, yaw = batch["steering.wheel"], batch["chassis.yaw_rate"]
    assert wheel[2] > 10 and wheel[0] < -10 and abs(wheel[1]) < 1
    assert yaw[2] > 2 and yaw[0] < -2
    assert np.allclose(batch["steering.hands_torque"], torques)


def test_a_prescribed_rack_has_no_hands(sedan):
    simulation = hamilcar.Simulation(sedan, speed=15.0)
    with pytest.raises(TypeError, match="no control 'hands'"):
        simulation.step(1, hands=0.0)
    with pytest.raises(hamilcar.InputError, match=r"\[steering.rack\]"):
        hamilcar.Simulation("bmw_e21_320i", steering_mechanics=True)
