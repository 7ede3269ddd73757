"""The right-hand side and its Jacobian as C that CasADi loads: against the simulation and against differences."""

import shutil
import subprocess
import sys

import numpy as np
import pytest

import hamilcar

casadi = pytest.importorskip("casadi")
compiler = shutil.which("cc") or shutil.which("gcc")
pytestmark = pytest.mark.skipif(compiler is None, reason="no C compiler here")


@pytest.fixture(scope="module")
def car(tmp_path_factory):
    folder = tmp_path_factory.mktemp("casadi")
    vehicle = hamilcar.Vehicle("bmw_323i_paper").source
    subprocess.run([sys.executable, "-m", "hamilcar", "program", vehicle, "--casadi", folder / "car.c"], check=True, capture_output=True)
    command = [compiler, "-std=c99", "-O0", "-ffp-contract=off", "-shared", "-fPIC", folder / "car.c", "-o", folder / "car.so", "-lm"]
    subprocess.run(command, check=True)
    return casadi.external("car", str(folder / "car.so"))


@pytest.fixture(scope="module")
def moving():
    """A car that turns, its brakes on so that they are off their kink at rest; state, and inputs: torque and brake alone."""
    rollout = hamilcar.Rollout("bmw_323i_paper", speed=20.0, steps=1, threads=1)
    held = np.array([0.0, 300.0, 0.02])
    _, state = rollout(np.tile(held, (300, 1)), held=held)
    return rollout, held, state, np.array([0, 0, 0, 300.0, 0.02, 0, 0, 0, 0, 0, 1, 0, 0])


def test_a_step_of_its_rates_is_a_step_of_the_simulation(car, moving):
    rollout, held, x, u = moving
    h = 1e-3

    def rate(x):
        return np.array(car(x, u)).ravel()

    k1 = rate(x)
    k2 = rate(x + h / 2 * k1)
    k3 = rate(x + h / 2 * k2)
    k4 = rate(x + h * k3)
    found = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    assert np.abs(found - rollout(held[None], state=x, held=held)[1]).max() < 1e-9


def test_its_jacobian_is_that_of_differences(car, moving):
    _, _, x, u = moving
    xs, us = casadi.MX.sym("x", x.size), casadi.MX.sym("u", u.size)
    rate = car(xs, us)
    jacobian = casadi.Function("jacobian", [xs, us], [casadi.jacobian(rate, xs), casadi.jacobian(rate, us)])
    by_state, by_input = (np.array(m) for m in jacobian(x, u))
    for found, value, call in (
        (by_state, x, lambda v: car(v, u)),
        (by_input[:, :5], u[:5], lambda v: car(x, np.concatenate([v, u[5:]]))),
    ):
        for k in range(value.size):
            h = 1e-5 * max(1.0, abs(value[k]))
            step = h * np.eye(value.size)[k]
            expected = (np.array(call(value + step)) - np.array(call(value - step))).ravel() / (2 * h)
            assert np.abs(found[:, k] - expected).max() < 1e-5 * (np.abs(expected).max() + 1)


def test_runge_kutta_of_casadi_differentiates_through_it(car, moving):
    """As an optimal control problem does: a map of CasADi's own, and its Jacobian by the chain rule."""
    _, _, x, u = moving
    xs = casadi.MX.sym("x", x.size)
    half = xs + 5e-4 * car(xs, u)
    step = casadi.Function("step", [xs], [xs + 1e-3 * car(half, u)])
    slope = casadi.Function("slope", [xs], [casadi.jacobian(step(xs), xs)])
    row = list(range(x.size))
    assert np.isfinite(np.array(slope(x))[row, row]).all()
    direction = np.zeros(x.size)
    direction[10:13] = 1e-3
    expected = (np.array(step(x + direction)) - np.array(step(x - direction))).ravel() / 2
    assert np.abs(np.array(slope(x)) @ direction - expected).max() < 1e-6 * np.abs(expected).max()
