"""Many cars: the bits of single ones, parameters, resets, rollouts."""

import numpy as np
import pytest

import hamilcar


def drive(simulation, angles):
    for angle in angles:
        simulation.step(20, steering_wheel=float(angle), throttle=0.3)
    return simulation


def test_has_the_bits_of_simulations_whenever_a_car_begins(car, random):
    angles = random.uniform(-0.5, 0.5, (30, 11))
    batch = hamilcar.Batch(car, 11, speed=20.0)
    for row in range(30):
        batch.step(20, steering_wheel=angles[row], throttle=0.3)
        if row == 12:
            batch.reset([3, 7])
    for i in range(11):
        alone = drive(hamilcar.Simulation(car, speed=20.0), angles[13 if i in (3, 7) else 0 :, i])
        assert np.array_equal(batch.states[i], alone.state), i
        assert batch.times[i] == pytest.approx(alone.time)
        assert np.array_equal(batch.read(batch.channels)[i], alone.read(alone.channels)), i


def test_threads_do_not_change_the_bits(car, random):
    controls = random.uniform(-0.3, 0.3, (9, 3))
    states = []
    for threads in (1, 2, 3):
        batch = hamilcar.Batch(car, 9, speed=20.0, threads=threads, powered=False)
        batch.step(100, np.column_stack([controls[:, 0], 300 * controls[:, 1], np.abs(controls[:, 2])]))
        states.append(batch.states)
    assert np.array_equal(states[0], states[1]) and np.array_equal(states[0], states[2])


def test_parameters_take_effect_at_reset(car):
    masses = np.linspace(900, 1300, 5)
    batch = hamilcar.Batch(car, 5, speed=20.0, vary=["chassis.mass_kg", "axle.front.spring.rate_N_per_m"])
    batch.expand("chassis.mass_kg")[:] = masses
    batch.reset()
    batch.step(500, steering_wheel=0.5)
    for i, mass in enumerate(masses):
        alone = hamilcar.Simulation(car.changed({"chassis.mass_kg": mass}), speed=20.0)
        alone.step(500, steering_wheel=0.5)
        assert np.array_equal(batch.states[i], alone.state), i
    batch.expand("chassis.mass_kg")[2] = 1000.0
    batch.expand("axle.front.spring.rate_N_per_m")[4] *= 1.3
    batch.reset([2])  # and not 4
    batch.step(100, steering_wheel=0.2)
    alone = hamilcar.Simulation(car.changed({"chassis.mass_kg": 1000.0}), speed=20.0)
    alone.step(100, steering_wheel=0.2)
    assert np.array_equal(batch.states[2], alone.state)
    assert batch.vehicle_of(4)["axle.front.spring.rate_N_per_m"] > car["axle.front.spring.rate_N_per_m"]


@pytest.mark.parametrize("name", ["bmw_323i", "formula", "bmw_e90_330i"])
def test_any_number_can_vary(name, random):
    """Every fifth number of a vehicle, hardpoints too, at once."""
    car = hamilcar.Vehicle(name)
    numbers = [n for n in car.numbers().values() if not n.is_default and not n.is_whole and n.value != 0][::5]
    names = []
    for number in numbers:
        try:
            car.changed({number.name: number.value * 1.01}), car.changed({number.name: number.value * 0.99})
        except hamilcar.Error:
            continue  # what must fit to others, shares that add up to one
        names.append(number.name)
    assert len(names) > 15
    varied = [n for n in names if _can_vary_alone(car, n)]
    batch = hamilcar.Batch(car, 4, speed=15.0, vary=varied[:12])
    for parameter in varied[:12]:
        batch.expand(parameter)[1:] *= random.uniform(0.995, 1.005, 3)
    batch.reset()
    batch.step(200, steering_wheel=0.3)
    for i in range(4):
        alone = hamilcar.Simulation(batch.vehicle_of(i), speed=15.0)
        alone.step(200, steering_wheel=0.3)
        assert np.array_equal(batch.states[i], alone.state), i


def _can_vary_alone(car, name):
    try:
        hamilcar.Simulation(car.changed({name: car[name] * 1.01}), speed=15.0)
        hamilcar.Simulation(car.changed({name: car[name] * 0.99}), speed=15.0)
    except hamilcar.Error:
        return False
    return True


def test_rollout_is_steps_one_after_the_other(car, random):
    controls = np.zeros((25, 6, 3))
    controls[:, :, 0] = random.uniform(-0.4, 0.4, (25, 6))
    one, other = (hamilcar.Batch(car, 6, speed=20.0) for _ in range(2))
    rolled = one.rollout(controls, steps=20, record=["chassis.yaw_rate", "chassis.speed"])
    assert rolled["chassis.speed"].shape == (25, 6)
    for row in range(25):
        other.step(20, controls[row])
        assert np.array_equal(rolled["chassis.yaw_rate"][row], other["chassis.yaw_rate"])
    assert np.array_equal(one.states, other.states)


def test_snapshots_go_between_batches_and_simulations(car):
    batch = hamilcar.Batch(car, 5, speed=20.0)
    batch.step(200, steering_wheel=np.linspace(0, 0.4, 5), throttle=0.5)
    places = batch.save()
    batch.step(100, steering_wheel=0.0)
    expected = batch.states
    batch.step(57)
    batch.restore(places)
    batch.step(100, steering_wheel=0.0)
    assert np.array_equal(batch.states, expected)
    alone = hamilcar.Simulation(car, speed=20.0)
    alone.restore(places[3])
    alone.step(100, steering_wheel=0.0)
    assert np.array_equal(alone.state, expected[3])
    batch.restore([places[1]] * 2, [0, 4])
    assert np.array_equal(batch.states[0], batch.states[4])


def test_cars_that_end_are_named_and_the_others_go_on(car):
    batch = hamilcar.Batch("truck_semitrailer", 3, speed=25.0, tilt_limit=0.3)
    batch.step(4000, steering_wheel=np.array([0.0, 6.0, 0.1]))
    assert list(batch.ended) == [False, True, False]
    assert "tilt" in batch.why(1) and batch.why(0) == ""
    with pytest.raises(ValueError, match="car 1 has ended"):
        batch.save()
    batch.reset(batch.ended)
    assert not batch.ended.any() and batch.times[1] == 0
    batch.step(10)
    assert batch.times[1] == pytest.approx(0.01)


def test_single_precision_is_near(car):
    one, other = (hamilcar.Batch(car, 3, speed=20.0, precision=p) for p in ("double", "single"))
    one.step(2000, steering_wheel=0.3), other.step(2000, steering_wheel=0.3)
    assert np.allclose(one["chassis.position.x"], other["chassis.position.x"], atol=0.05)


def test_scenarios_of_batches_have_drivers(car, driven):
    batch = hamilcar.Batch(car, 3, driven)
    alone = hamilcar.Simulation(car, driven)
    batch.step(2500), alone.step(2500)
    assert np.array_equal(batch.states[2], alone.state)
    assert "steering_wheel" not in batch.control_names  # the driver has it


def test_prepared_starts_are_those_of_simulations():
    batch = hamilcar.Batch("bmw_323i", 9, speed=20.0, powered=False, vary=["chassis.mass_kg", "road.friction"])
    starts = [
        batch.prepare({"chassis.mass_kg": 950.0 + 50.0 * i}, speed=10.0 + i, friction=0.5 + 0.1 * i) for i in range(3)
    ]
    batch.step(7, steering_wheel=1.0)
    batch.reset([8, 0, 3], starts)
    assert batch.expand("chassis.mass_kg")[[8, 0, 3]].tolist() == [950.0, 1000.0, 1050.0]
    assert batch.expand("road.friction")[1] == 1.0
    batch.step(60, steering_wheel=2.0, drive_torque=400.0)
    for i, car in enumerate([8, 0, 3]):
        vehicle = hamilcar.Vehicle("bmw_323i", {"chassis.mass_kg": 950.0 + 50.0 * i})
        alone = hamilcar.Simulation(vehicle, speed=10.0 + i, friction=0.5 + 0.1 * i, powered=False)
        alone.step(60, steering_wheel=2.0, drive_torque=400.0)
        assert (alone.state == batch.states[car]).all()
    batch.reset([0])
    assert batch["chassis.speed"][0] == pytest.approx(11.0)


def test_starts_that_do_not_fit_are_refused():
    batch = hamilcar.Batch("bmw_323i", 2, vary=["chassis.mass_kg"])
    before = batch.states
    with pytest.raises(KeyError, match="road.friction"):
        batch.prepare(friction=0.5)
    with pytest.raises(ValueError, match="expected one for each of 2 cars"):
        batch.reset(None, [batch.prepare()])
    with pytest.raises(TypeError, match="prepare"):
        batch.reset([0], [None])
    with pytest.raises(ValueError, match="another's"):
        batch.reset([1], hamilcar.Batch("bmw_323i", 2, vary=["chassis.mass_kg"]).prepare())
    assert (batch.states == before).all()


def test_a_start_stays_with_its_car():
    batch = hamilcar.Batch("bmw_323i", 2, speed=20.0, vary=["chassis.mass_kg"])
    batch.reset([0], starts=batch.prepare(speed=10.0))
    batch.expand("chassis.mass_kg")[:] += 100.0
    batch.reset()
    assert batch["chassis.speed"] == pytest.approx([10.0, 20.0])
    assert batch.vehicle_of(0)["chassis.mass_kg"] == batch.vehicle_of(1)["chassis.mass_kg"] == 1102.0
