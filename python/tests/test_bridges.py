"""Bridges: the numbers and the derivatives of the rollout arrive in other programs, and follow their rules there."""

import numpy as np
import pytest

import hamilcar
from hamilcar import bridges

PARAMETERS = ["chassis.mass_kg", "axle.front.spring.rate_N_per_m"]
RECORD = ["chassis.yaw_rate", "chassis.position.y"]


@pytest.fixture(scope="module")
def rollout():
    return hamilcar.Rollout("bmw_323i", parameters=PARAMETERS, record=RECORD, steps=5, step=4e-3, speed=20.0, threads=1)


@pytest.fixture
def controls():
    rows = np.zeros((6, 3))
    rows[:, 0] = np.linspace(0.1, 0.4, 6)
    rows[:, 1] = 100.0
    return rows


def loss_of(y, end):
    """A smooth function of all results."""
    return (y**2).sum() + 1e-3 * (end[..., 1] ** 2).sum()


def slope(rollout, controls, parameters, which, spacing):
    """Of the loss, by differences of runs."""

    def at(sign):
        given = {"controls": controls.copy(), "parameters": parameters.copy()}
        name, place = which
        given[name][place] += sign * spacing
        return loss_of(*rollout(**given))

    return (at(1) - at(-1)) / (2 * spacing)


@pytest.fixture
def jax():
    jax = pytest.importorskip("jax")
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield jax
    jax.config.update("jax_enable_x64", before)


def test_jax_gives_the_bits_and_derivatives_of_the_rollout(rollout, controls, jax):
    f = bridges.jax(rollout)
    for found, expected in zip(jax.jit(f)(controls), rollout(controls)):
        assert np.array_equal(found, expected)
    gradient = jax.jit(jax.grad(lambda *given: loss_of(*f(*given)), argnums=(0, 1)))(controls, rollout.parameters)
    for argument, name, place, spacing in ((0, "controls", (2, 0), 1e-4), (1, "parameters", (0,), 0.1)):
        expected = slope(rollout, controls, rollout.parameters, (name, place), spacing)
        assert gradient[argument][place] == pytest.approx(expected, rel=1e-5)
    by_controls, by_parameters = jax.jacrev(f, argnums=(0, 1))(controls, rollout.parameters)[0]
    assert np.allclose(by_controls.reshape(6, 2, 18), rollout.jacobian(controls, wrt="controls")[0], rtol=1e-9, atol=1e-12)
    assert np.allclose(by_parameters, rollout.jacobian(controls)[0], rtol=1e-9, atol=1e-12)


def test_jax_differentiates_by_state_and_held_controls(rollout, controls, jax):
    from jax.test_util import check_grads

    f = bridges.jax(rollout)

    def yaw(shift, held):  # along a direction of the state that is of the size of its numbers
        state = rollout.start * (1 + shift)
        return f(controls, None, state, held)[0][:, 0]

    check_grads(yaw, (1e-3, rollout.held + 0.05), order=1, modes=["rev"], eps=1e-4, atol=1e-5, rtol=1e-5)


def test_jax_maps_and_shares(rollout, controls, jax):
    """vmap, runs as a leading axis and a loop have the same values; what runs share gets the sum of their derivatives."""
    f = bridges.jax(rollout)
    many = np.stack([controls, 2 * controls, -controls])
    expected, _ = rollout(many)
    assert np.array_equal(jax.vmap(f)(many)[0], expected) and np.array_equal(f(many)[0], expected)
    by_parameters = jax.grad(lambda p: loss_of(*f(many, p)))(rollout.parameters)
    one_by_one = jax.vmap(jax.grad(lambda c, p: loss_of(*f(c, p)), argnums=1), in_axes=(0, None))(many, rollout.parameters)
    alone = sum(jax.grad(lambda p: loss_of(*f(c, p)))(rollout.parameters) for c in many)
    assert one_by_one.shape == (3, 2)
    assert np.allclose(by_parameters, alone, rtol=1e-9) and np.allclose(one_by_one.sum(axis=0), alone, rtol=1e-9)
    two = np.stack([rollout.parameters, rollout.parameters * 1.01])
    nested = jax.vmap(lambda p: jax.vmap(lambda c: f(c, p)[0])(many))(two)
    assert nested.shape == (2, 3, 6, 2) and np.array_equal(nested[0], expected)
    assert np.array_equal(nested[1], rollout(many, rollout.parameters * 1.01)[0])


def test_jax_refuses_single_precision_and_wrong_shapes(rollout, controls, jax):
    f = bridges.jax(rollout)
    with pytest.raises(ValueError, match=r"expected \(t, 3\)"):
        f(controls[:, :2])
    with pytest.raises(ValueError, match=r"parameters of shape \(3,\)"):
        f(controls, np.zeros(3))
    with pytest.raises(ValueError, match="one number of runs"):
        f(np.stack([controls] * 2), np.tile(rollout.parameters, (3, 1)))
    jax.config.update("jax_enable_x64", False)
    for call in (lambda: bridges.jax(rollout), lambda: f(controls)):
        with pytest.raises(RuntimeError, match="jax_enable_x64"):
            call()


def test_torch_gives_the_bits_and_derivatives_of_the_rollout(rollout, controls):
    torch = pytest.importorskip("torch")
    f = bridges.torch(rollout)
    rows = torch.tensor(controls, requires_grad=True)
    parameters = torch.tensor(rollout.parameters, requires_grad=True)
    y, end = f(rows, parameters)
    expected = rollout(controls)
    assert np.array_equal(y.detach().numpy(), expected[0]) and np.array_equal(end.detach().numpy(), expected[1])
    loss_of(y, end).backward()
    for found, which, spacing in ((rows.grad[2, 0], ("controls", (2, 0)), 1e-4), (parameters.grad[0], ("parameters", 0), 0.1)):
        assert found.item() == pytest.approx(slope(rollout, controls, rollout.parameters, which, spacing), rel=1e-5)
    many = torch.stack([rows.detach(), 2 * rows.detach()])
    parameters.grad = None
    loss_of(*f(many, parameters)).backward()
    alone = sum(rollout.gradient(c, **weights_of(rollout, c))["parameters"] for c in (controls, 2 * controls))
    assert np.allclose(parameters.grad.numpy(), alone, rtol=1e-9)


def weights_of(rollout, controls):
    y, end = rollout(controls)
    return {"y_weights": 2 * y, "end_weights": np.where(np.arange(end.size) == 1, 2e-3 * end, 0.0)}


def test_torch_passes_its_own_check_of_gradients(rollout, controls):
    torch = pytest.importorskip("torch")
    f = bridges.torch(rollout)
    start = torch.tensor(rollout.start)

    def yaw(rows, shift, held):
        return f(rows, None, start * (1 + shift), held)[0][:, 0]

    rows, held = controls[:2] + [0.0, 0.0, 0.1], rollout.held + 0.05  # the brake away from its stop
    given = [torch.tensor(one, dtype=torch.float64, requires_grad=True) for one in (rows, 1e-3, held)]
    assert torch.autograd.gradcheck(yaw, given, eps=1e-5, atol=1e-5, rtol=1e-4)
    with pytest.raises(TypeError, match="float64"):
        f(torch.zeros(6, 3))
    with pytest.raises(ValueError, match=r"expected \(t, 3\)"):
        f(torch.zeros(6, 2, dtype=torch.float64))


def test_casadi_has_a_row_and_its_jacobian(rollout, controls):
    ca = pytest.importorskip("casadi")
    step = bridges.casadi(rollout, "row")
    u_from, u_to = controls[0], controls[1]
    parameters = rollout.parameters * 1.02
    x_next, y = step(rollout.start, u_from, u_to, parameters)
    expected = rollout(u_to[None], parameters, rollout.start, u_from)
    assert np.array_equal(np.array(x_next)[:, 0], expected[1]) and np.array_equal(np.array(y)[:, 0], expected[0][0])
    symbols = [ca.MX.sym("s", n) for n in (rollout.start.size, 3, 3, 2)]
    results = step(*symbols)
    for result, out in zip(results, (1, 0)):
        for symbol, wrt in zip(symbols, ("state", "held", "controls", "parameters")):
            block = ca.Function("block", symbols, [ca.jacobian(result, symbol)])(rollout.start, u_from, u_to, parameters)
            found = rollout.jacobian(u_to[None], parameters, rollout.start, u_from, wrt=wrt)[out]
            assert np.array_equal(np.array(block), found if out else found[0]), (wrt, out)


def test_casadi_finds_a_lane_change():
    """Steering in 20 rows of 0.1 s that brings a car 2 m to the left and straight ahead again, with the least changes."""
    ca = pytest.importorskip("casadi")
    record = ["chassis.position.y", "chassis.angle.yaw", "chassis.yaw_rate"]
    rollout = hamilcar.Rollout("bmw_323i", record=record, steps=25, step=4e-3, speed=20.0, threads=1)
    step = bridges.casadi(rollout)
    steering = ca.MX.sym("steering", 20)
    x, before, cost = ca.DM(rollout.start), ca.DM(rollout.held), 0
    for k in range(20):
        target = ca.vertcat(steering[k], 0, 0)
        x, y = step(x, before, target, ca.DM(0, 1))
        cost += (target[0] - before[0]) ** 2
        before = target
    options = {"hessian_approximation": "limited-memory", "print_level": 0, "max_iter": 60, "tol": 1e-5}
    solver = ca.nlpsol("solver", "ipopt", {"x": steering, "f": cost, "g": y}, {"ipopt": options, "print_time": False})
    found = solver(x0=0, lbx=-2, ubx=2, lbg=[2, 0, 0], ubg=[2, 0, 0])
    assert solver.stats()["success"], solver.stats()["return_status"]
    simulation = hamilcar.Simulation("bmw_323i", speed=20.0, step=4e-3, integrator="rk4", powered=False)
    for angle in np.array(found["x"])[:, 0]:
        simulation.step(25, steering_wheel=float(angle), drive_torque=0.0, brake=0.0)
    assert simulation["chassis.position.y"] == pytest.approx(2.0, abs=1e-3)
    assert simulation["chassis.angle.yaw"] == pytest.approx(0.0, abs=1e-2) and abs(simulation["chassis.yaw_rate"]) < 1e-2
