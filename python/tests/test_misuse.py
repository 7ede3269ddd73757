"""Wrong shapes, types, names, numbers: a Python exception each time, and the object is as before."""

import math

import numpy as np
import pytest

import hamilcar


@pytest.fixture(scope="module")
def simulation():
    return hamilcar.Simulation("bmw_323i", speed=10.0)


@pytest.fixture(scope="module")
def batch():
    return hamilcar.Batch("bmw_323i", 4, speed=10.0, vary=["chassis.mass_kg"])


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda s: s.step(0), ValueError, "at least one step"),
        (lambda s: s.step(-5), ValueError, "at least one step"),
        (lambda s: s.step(1.5), TypeError, ""),
        (lambda s: s.step(1, brake=1.1), ValueError, "brake = 1.1: expected 0 to 1"),
        (lambda s: s.step(1, brake=math.nan), ValueError, "not a NaN"),
        (lambda s: s.step(1, brake="full"), ValueError, ""),
        (lambda s: s.step(1, steering_wheel=99.0), ValueError, r"expected -12.56\d+ to 12.56\d+ \[rad\]"),
        (lambda s: s.step(1, steering_wheel=math.inf), ValueError, "steering_wheel = inf"),
        (lambda s: s.step(1, stering_wheel=0.1), TypeError, "did you mean 'steering_wheel'"),
        (lambda s: s.step(1, gear=2), TypeError, "no control 'gear'"),
        (lambda s: s["chassis.yaw_rte"], KeyError, "did you mean 'chassis.yaw_rate'"),
        (lambda s: s[3], KeyError, ""),
        (lambda s: s.restore(None), TypeError, ""),
        (lambda s: s.restore("here"), TypeError, ""),
    ],
)
def test_of_a_simulation(simulation, call, error, words):
    before = simulation.state
    with pytest.raises((error, TypeError) if error is KeyError else error, match=words or None):
        call(simulation)
    assert np.array_equal(simulation.state, before)


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda b: b.step(1, np.zeros((4, 2))), ValueError, r"shape \(4, 2\): expected \(4, 3\)"),
        (lambda b: b.step(1, np.zeros(3)), ValueError, "expected"),
        (lambda b: b.step(1, np.full((4, 3), 7.0)), ValueError, "throttle = 7: expected 0 to 1"),
        (lambda b: b.step(1, np.zeros((4, 3)), brake=0.1), TypeError, "not both"),
        (lambda b: b.step(1, steering_wheel=np.zeros(5)), ValueError, r"steering_wheel: .* shape \(4,\)"),
        (lambda b: b.step(1, pedal=np.zeros(4)), TypeError, "no control 'pedal'"),
        (lambda b: b.step(1, [["a"] * 3] * 4), ValueError, ""),
        (lambda b: b.rollout(np.zeros((4, 3))), ValueError, r"expected \(t, 4, 3\)"),
        (lambda b: b.rollout(np.zeros((2, 4, 3)), record=["nonsense"]), KeyError, ""),
        (lambda b: b.reset([4]), IndexError, "0 to 3"),
        (lambda b: b.reset([-1]), IndexError, "0 to 3"),
        (lambda b: b.reset(np.array([True, False])), ValueError, "mask"),
        (lambda b: b.reset([0.5]), TypeError, "numbers of cars"),
        (lambda b: b.expand("chassis.center_of_mass_m.0"), KeyError, "vary"),
        (lambda b: b.restore([], [0]), ValueError, "a snapshot for each car"),
        (lambda b: b.restore([None], [0]), TypeError, ""),
        (lambda b: b["nonsense"], KeyError, ""),
        (lambda b: b.why(9), IndexError, ""),
    ],
)
def test_of_a_batch(batch, call, error, words):
    before = batch.states
    with pytest.raises(error, match=words or None):
        call(batch)
    assert np.array_equal(batch.states, before)


def test_of_what_makes_them():
    for wrong in (0, -3):
        with pytest.raises(ValueError, match="at least one car"):
            hamilcar.Batch("bmw_323i", wrong)
    with pytest.raises(ValueError, match="'double' or 'single'"):
        hamilcar.Batch("bmw_323i", 1, precision="half")
    with pytest.raises(hamilcar.InputError, match="did you mean"):
        hamilcar.Simulation("bmw_323i", integrator="ab33")
    with pytest.raises(hamilcar.InputError, match="step_s"):
        hamilcar.Simulation("bmw_323i", step=3.0)
    with pytest.raises(TypeError, match="a name, a path or a dict"):
        hamilcar.Simulation(3)
    with pytest.raises(TypeError, match="keys of a table must be texts"):
        hamilcar.Vehicle({1: 2})
    with pytest.raises(TypeError, match="not 'object'"):
        hamilcar.Vehicle("bmw_323i", {"chassis.mass_kg": object()})
    with pytest.raises(hamilcar.InputError, match="missing|mistakes"):
        hamilcar.Vehicle({})
    with pytest.raises(ValueError, match="nested too deep"):
        deep = []
        for _ in range(100):
            deep = [deep]
        hamilcar.Vehicle("bmw_323i", {"chassis.mass_kg": deep})


def test_random_values_for_random_keys_never_crash(random):
    """A brief fuzz: whatever is put anywhere is taken or refused."""
    car = hamilcar.Vehicle("bmw_e90_330i")
    names = list(car.numbers())
    odd = [0, -1, 1e308, -1e308, 1e-308, math.nan, math.inf, "word", True, [], [1, 2], {}, {"a": 1}, None, 10**400]
    refused = taken = 0
    for _ in range(400):
        key = names[random.integers(len(names))]
        if random.random() < 0.3:
            key = key[: random.integers(len(key) + 1)]
        value = odd[random.integers(len(odd))]
        try:
            hamilcar.Simulation(car.changed({key: value}), speed=10.0).step(3)
            taken += 1
        except (hamilcar.Error, TypeError, ValueError, OverflowError):
            refused += 1
    assert refused > 100
