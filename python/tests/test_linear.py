"""The linear model against the whole one: small motions about steady driving."""

import numpy as np
import pytest

import hamilcar


def test_names_its_rows_and_columns(car):
    model = hamilcar.linearize(car, speed=20.0)
    n, m, p = len(model.states), len(model.inputs), len(model.outputs)
    assert model.A.shape == (n, n) and model.B.shape == (n, m)
    assert model.C.shape == (p, n) and model.D.shape == (p, m)
    assert model.inputs[:2] == ["rack", "rack_rate"] and model.input_units[:2] == ["m", "m/s"]
    assert set(model.outputs) - {"seat.vertical_velocity"} <= set(car.channels)
    assert len(model.output_units) == p and model.residual < 1e-3
    assert max(mode.eigenvalue.real for mode in model.modes) < 0.1


@pytest.mark.parametrize("name", ["bmw_323i", "formula", "hatchback"])
def test_yaw_follows_the_steering_as_the_whole_model_does(name):
    """The steering wheel turns by a hundredth of a radian within 0.2 s: the linear model, discrete in time, beside the simulation."""
    simulation = hamilcar.Simulation(name, speed=20.0, powered=False)
    simulation.step(2500, drive_torque=hamilcar.linearize(name, speed=20.0).drive_torque)
    model = hamilcar.linearize(name, speed=simulation["chassis.speed"])  # a little less: the tires wound up
    before = simulation.read(["chassis.yaw_rate", "input.rack"])
    a, b = model.discrete(0.001)
    yaw, z, rack = model.outputs.index("chassis.rate.yaw"), np.zeros(len(a)), 0.0
    largest = worst = 0.0
    for i in range(1200):
        simulation.step(1, steering_wheel=0.01 * min(1.0, (i + 1) / 200))
        now = simulation.read(["chassis.yaw_rate", "input.rack"])
        rate = (now[1] - before[1] - rack) / 0.001
        z = a @ z + b[:, 0] * (rack + 0.0005 * rate) + b[:, 1] * rate
        rack = now[1] - before[1]
        linear = model.C[yaw] @ z + model.D[yaw, 0] * rack
        largest = max(largest, abs(linear))
        worst = max(worst, abs(np.radians(now[0] - before[0]) - linear))
    assert largest > 1e-3
    assert worst < 0.002 * largest


def test_discrete_model_is_the_exponential(car):
    model = hamilcar.linearize(car, speed=15.0)
    a, b = model.discrete(0.01)
    half, half_b = model.discrete(0.005)
    assert np.allclose(half @ half, a, atol=1e-9 * np.abs(a).max())
    assert np.allclose(half @ half_b + half_b, b, atol=1e-9 * np.abs(b).max())
    eigenvalues = np.exp(0.01 * np.linalg.eigvals(model.A))
    assert np.allclose(np.sort(np.abs(np.linalg.eigvals(a))), np.sort(np.abs(eigenvalues)), atol=1e-8)


def test_frequency_response_tends_to_the_steady_gain(car):
    model = hamilcar.linearize(car, speed=20.0)
    slow, fast = model.response("chassis.rate.yaw", "rack", np.array([1e-3, 5.0]))
    turned = hamilcar.linearize(car, speed=20.0, lateral_acceleration=0.05)
    assert slow.real == pytest.approx((0.05 / 20.0) / turned.rack, rel=0.02)
    assert abs(fast) < abs(slow)


def test_mistakes_are_told(car):
    with pytest.raises(ValueError, match="not below zero"):
        hamilcar.linearize(car, speed=-1.0)
    with pytest.raises(ValueError, match="needs a speed"):
        hamilcar.linearize(car, lateral_acceleration=1.0)
    with pytest.raises(hamilcar.NumericalError, match="BMW"):
        hamilcar.linearize(car, speed=20.0, lateral_acceleration=30.0)
    with pytest.raises(KeyError, match="expected one of"):
        hamilcar.linearize(car).response("yaw", "rack", np.array([1.0]))
    with pytest.raises(ValueError, match="positive time"):
        hamilcar.linearize(car).discrete(0)
