import numpy as np
import pytest

import hamilcar

RECORD = ["chassis.yaw_rate", "chassis.position.y", "chassis.speed"]


def rows(random, names, t, n=None):
    sizes = {"steering_wheel": 0.4, "rack": 0.005, "drive_torque": 200.0, "brake": 0.05, "throttle": 0.2}
    shape = (t, len(names)) if n is None else (n, t, len(names))
    out = np.zeros(shape)
    for i, name in enumerate(names):
        if name in sizes:
            out[..., i] = random.uniform(0 if name in ("brake", "throttle") else -1, 1, shape[:-1]) * sizes[name]
        if name == "gear":
            out[..., i] = 3
    return out


@pytest.fixture
def rollout():
    return hamilcar.Rollout(
        "bmw_323i", record=RECORD, speed=20.0, steps=10, threads=1,
        parameters=["chassis.mass_kg", "axle.front.spring.rate_N_per_m", "road.friction"],
    )


def test_has_the_bits_of_a_batch(rollout, random):
    controls = rows(random, rollout.control_names, 7, 9)
    y, end = rollout(controls)
    batch = hamilcar.Batch("bmw_323i", 9, speed=20.0, powered=False, integrator="rk4", energy_balance=False)
    recorded = batch.rollout(np.moveaxis(controls, 0, 1), steps=10, record=RECORD)
    for i, name in enumerate(RECORD):
        assert (recorded[name].T == y[:, :, i]).all()
    assert (batch.states == end).all()
    one, one_end = rollout(controls[4])
    assert (one == y[4]).all() and (one_end == end[4]).all()


@pytest.mark.parametrize("wrt, size, tolerance", [("controls", None, 1e-6), ("parameters", None, 1e-5), ("state", 1e-5, 1e-4)])
def test_jacobians_are_those_of_differences(rollout, random, wrt, size, tolerance):
    controls = rows(random, rollout.control_names, 4)
    controls[:, 2] = 0.02  # brakes that turn on have a kink at rest
    at = {"controls": controls, "parameters": rollout.parameters, "state": rollout.start}
    dy, dend = rollout.jacobian(**{**at, "state": None} if wrt == "parameters" else at, wrt=wrt)
    value = at[wrt].ravel()
    assert dy.shape == (4, 3, value.size) and dend.shape == (len(rollout.state_names), value.size)
    for k in range(value.size):
        if wrt == "state" and "windup" in rollout.state_names[k]:
            continue  # at rest, where the brake's friction has a kink
        h = size or (1e-3 if wrt == "parameters" else 1e-4) * max(1.0, abs(value[k]))
        found = []
        for sign in (1, -1):
            other = value.copy()
            other[k] += sign * h
            given = {**at, wrt: other.reshape(at[wrt].shape)}
            if wrt == "parameters":
                given["state"] = None
            found.append(rollout(**given))
        for derivative, plus, minus in zip((dy[..., k], dend[..., k]), *found):
            expected = (plus - minus) / (2 * h)
            scale = np.abs(expected).max() + 1e-6
            assert np.abs(derivative - expected).max() < tolerance * scale, (wrt, k)


def test_gradients_are_weighted_jacobians(rollout, random):
    controls = rows(random, rollout.control_names, 5, 3)
    y_weights, end_weights = random.normal(size=(3, 5, 3)), random.normal(size=(3, len(rollout.state_names)))
    found = rollout.gradient(controls, y_weights=y_weights, end_weights=end_weights)
    for wrt in ("controls", "parameters", "held", "state"):
        dy, dend = rollout.jacobian(controls, wrt=wrt)
        expected = np.einsum("ntc,ntck->nk", y_weights, dy) + np.einsum("ns,nsk->nk", end_weights, dend)
        terms = np.einsum("ntc,ntck->nk", np.abs(y_weights), np.abs(dy))
        terms += np.einsum("ns,nsk->nk", np.abs(end_weights), np.abs(dend))
        assert (np.abs(found[wrt].reshape(expected.shape) - expected) < 1e-10 * terms + 1e-15).all(), wrt


def test_a_start_of_its_own_is_one_more_variable(rollout, random):
    controls = rows(random, rollout.control_names, 3)
    weights = {"y_weights": np.ones((3, 3))}
    settled = rollout.gradient(controls, **weights)
    fixed = rollout.gradient(controls, state=rollout.start, **weights)
    assert (settled["state"] == fixed["state"]).all()
    assert abs(settled["parameters"][0] - fixed["parameters"][0]) > 1e-7  # a heavier car settles lower


def test_power_units_are_driven_through(random):
    scenario = {
        "name": "powered", "vehicle": "vehicle", "duration_s": 10.0, "initial": {"velocity_m_per_s": 20.0},
        "inputs": {"throttle": {"pedal": 0.1}, "gear": {"number": 3}},
    }
    rollout = hamilcar.Rollout("bmw_e90_330i", scenario, record=RECORD, steps=10, threads=1)
    assert {"throttle", "clutch", "gear"} <= set(rollout.control_names)
    controls = rows(random, rollout.control_names, 4)
    controls[:, rollout.control_names.index("throttle")] += 0.3
    by_throttle = rollout.jacobian(controls, wrt="controls")[0].reshape(4, 3, *controls.shape)
    at = (1, rollout.control_names.index("throttle"))
    found = []
    for sign in (1, -1):
        other = controls.copy()
        other[at] += sign * 1e-4
        found.append(rollout(other)[0])
    expected = (found[0] - found[1]) / 2e-4
    assert expected[3, 2] > 0  # more throttle, faster
    assert np.abs(by_throttle[:, :, at[0], at[1]] - expected).max() < 1e-5 * np.abs(expected).max()


def test_a_run_that_fails_is_not_a_number_and_the_others_go_on(rollout, random):
    controls = rows(random, rollout.control_names, 4, 2)
    state = np.stack([rollout.start, rollout.start])
    state[0, rollout.state_names.index("front_left.dependent.1")] += 0.5  # torn apart
    y, end = rollout(controls, state=state)
    assert np.isnan(y[0]).all() and np.isnan(end[0]).all()
    assert (y[1] == rollout(controls[1])[0]).all()
    found = rollout.gradient(controls, state=state, y_weights=np.ones(y.shape))
    alone = rollout.gradient(controls[1], state=state[1], y_weights=np.ones(y.shape[1:]))
    for name in ("controls", "held", "state"):
        assert np.isnan(found[name][0]).all()
        assert np.allclose(found[name][1], alone[name], rtol=1e-12)


@pytest.mark.parametrize("steps", [1, 4, 5])
def test_the_steering_ratio_is_a_parameter(steps, random):
    """It is no number of the model, but stands between the wheel and the rack."""
    name = "steering.rack_m_per_revolution"
    rollout = hamilcar.Rollout("bmw_323i", parameters=[name], record=RECORD, speed=20.0, steps=steps, threads=1)
    controls = rows(random, rollout.control_names, 5)
    controls[:, 2] = 0.0
    dy, _ = rollout.jacobian(controls)
    h = 1e-6
    expected = (rollout(controls, rollout.parameters + h)[0] - rollout(controls, rollout.parameters - h)[0]) / (2 * h)
    assert np.abs(expected).max() > 0.01
    assert np.abs(dy[..., 0] - expected).max() < 1e-5 * np.abs(expected).max()
    weights = random.normal(size=expected.shape)
    found = rollout.gradient(controls, y_weights=weights)["parameters"][0]
    assert found == pytest.approx(np.sum(weights * dy[..., 0]), rel=1e-9)


def test_cars_with_other_controls_are_refused():
    names = ["axle.front.brake.max_torque_N_m", "axle.rear.brake.max_torque_N_m"]
    rollout = hamilcar.Rollout("bmw_323i", parameters=names, record=["chassis.speed"], speed=20.0, threads=1)
    with pytest.raises(ValueError, match="controls"):
        rollout(np.zeros((4, 3)), parameters=[0.0, 0.0])
    batch = hamilcar.Batch("bmw_323i", 3, speed=20.0)
    windy = batch.prepare(scenario={"wind": {"toward_deg": 90.0, "speed_m_per_s": 15.0}})
    with pytest.raises(ValueError, match="controls"):
        batch.reset([1], starts=windy)


def test_a_car_without_controls_rolls():
    vehicle = hamilcar.Vehicle("bmw_323i").to_dict()
    del vehicle["steering"]
    for axle in vehicle["axle"]:
        axle["brake"]["max_torque_N_m"] = 0.0
        axle.pop("drive_share", None)
    rollout = hamilcar.Rollout(vehicle, record=["chassis.speed"], speed=20.0, threads=1)
    y, _ = rollout(np.zeros((3, 0)))
    assert y.shape == (3, 1) and (np.diff(y[:, 0]) < 0).all()
    assert rollout.gradient(np.zeros((3, 0)), y_weights=np.ones((3, 1)))["controls"].shape == (3, 0)


def test_toe_can_vary():
    """It moves numbers of the model that it changes in their last digits alone."""
    rollout = hamilcar.Rollout("bmw_323i", parameters=["axle.rear.wheel.toe_in_deg"], record=RECORD, speed=20.0, threads=1)
    dy, _ = rollout.jacobian(np.tile([0.3, 0.0, 0.0], (5, 1)))
    assert np.isfinite(dy).all()


def test_parameters_at_a_limit_have_derivatives_to_one_side():
    rollout = hamilcar.Rollout("bmw_323i", record=["chassis.speed"], speed=20.0, parameters=["axle.front.anti_roll_bar.rate_N_per_m"], threads=1)
    controls = np.zeros((2, 3))
    dy, _ = rollout.jacobian(controls, parameters=[0.0])
    assert np.isfinite(dy).all()


@pytest.mark.parametrize(
    "call, error, message",
    [
        (lambda r: r(np.zeros((4, 2))), ValueError, r"expected \(t, 3\)"),
        (lambda r: r(np.zeros((4, 3)), parameters=[1.0]), ValueError, "parameters of shape"),
        (lambda r: r(np.zeros((2, 4, 3)), state=np.zeros((3, 44))), ValueError, "one number of runs"),
        (lambda r: r(np.full((4, 3), np.nan)), ValueError, "NaN"),
        (lambda r: r(np.zeros((0, 4, 3))), ValueError, "at least one run"),
        (lambda r: r._core.run([None], np.zeros((1, 2, 3)), r.start[None]), TypeError, "start"),
        (lambda r: hamilcar.Rollout(threads=-1), ValueError, "threads"),
        (lambda r: r(np.full((4, 3), 7e9)), ValueError, "steering_wheel"),
        (lambda r: r.jacobian(np.zeros((4, 3)), wrt="mass"), ValueError, "expected one of"),
        (lambda r: r.gradient(np.zeros((4, 3)), y_weights=np.zeros(4)), ValueError, "y_weights"),
        (lambda r: hamilcar.Rollout(integrator="ab3"), ValueError, "rk4"),
        (lambda r: hamilcar.Rollout(record=["chassis.yawrate"]), KeyError, "did you mean"),
        (lambda r: hamilcar.Rollout(parameters="chassis.mass_kg"), TypeError, "list of names"),
        (lambda r: hamilcar.Rollout(steps=0), ValueError, "at least one step"),
        (lambda r: hamilcar.Rollout("bmw_e90_330i", powered=True), ValueError, "driver"),
    ],
)
def test_misuse_is_refused(rollout, call, error, message):
    with pytest.raises(error, match=message):
        call(rollout)


def test_linear_steps_about_steady_driving_have_the_eigenvalues_of_the_linear_model():
    """That one is by dual numbers and continuous; dampers of this car have no kink at rest."""
    model = hamilcar.linearize("bmw_323i", speed=20.0)
    rollout = hamilcar.Rollout("bmw_323i", speed=20.0, steps=20, threads=1)
    controls = np.zeros((100, 3))
    controls[:, rollout.control_names.index("drive_torque")] = model.drive_torque
    _, settled = rollout(controls, held=controls[0])
    steps = rollout.linearize(controls[:2], state=settled, held=controls[0])
    assert steps.A.shape == (2, 36, 36) and steps.B.shape == steps.B_before.shape == (2, 36, 3)
    assert len(steps.states) == len(steps.units) == 36 and steps.states[3:6] == ["rotation.x", "rotation.y", "rotation.z"]
    found = np.linalg.eigvals(steps.A[1])
    expected = np.concatenate([np.exp(rollout.interval * np.linalg.eigvals(model.A)), [1.0, 1.0, 1.0]])  # x, y and heading
    for one in expected:
        assert np.abs(found - one).min() < 2e-4
    assert abs(np.prod(np.abs(found)) / np.prod(np.abs(expected)) - 1) < 0.05


def test_linear_steps_follow_a_change_of_the_controls(random):
    rollout = hamilcar.Rollout("bmw_323i", speed=20.0, steps=10, threads=1)
    controls = rows(random, rollout.control_names, 6)
    controls[:, 2] = 0.02
    steps = rollout.linearize(controls)
    change = 1e-5 * random.normal(size=controls.shape) * [1, 1000, 0]
    z = np.zeros(36)
    before = np.zeros(3)
    for k in range(6):
        z = steps.A[k] @ z + steps.B_before[k] @ before + steps.B[k] @ change[k]
        before = change[k]
    expected = rollout(controls + change)[1] - rollout(controls)[1]
    for i, name in enumerate(rollout.state_names):
        if name in steps.states:
            assert z[steps.states.index(name)] == pytest.approx(expected[i], rel=1e-3, abs=1e-4 * np.abs(expected).max() * 1e-3)
    # Row by row each begins at time 0: shares of a row's time differ in their last digit.
    assert steps.points.shape == (7, 44) and np.allclose(steps.points[-1], rollout(controls)[1], rtol=1e-9, atol=1e-9)
