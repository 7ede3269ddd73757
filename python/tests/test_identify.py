"""Identification: numbers that are known are found again, those that cannot be known are named."""

import numpy as np
import pytest

import hamilcar
from hamilcar.identify import Free, Measurement, Unknown, identify

optimize = pytest.importorskip("scipy.optimize")

STEP, STEPS = 4e-3, 5
NOISE = {
    "chassis.yaw_rate": 0.1, "chassis.lateral_acceleration": 0.05, "chassis.longitudinal_acceleration": 0.05,
    "chassis.rate.roll": 0.1, "chassis.rate.pitch": 0.1, "chassis.speed": 0.02, "front_left.wheel.travel": 2e-4,
    "front_right.wheel.travel": 2e-4, "rear_left.wheel.travel": 2e-4, "rear_right.wheel.travel": 2e-4,
}


def times(rows=125):
    return STEP * STEPS * np.arange(1, rows + 1)


def drive(car, controls, speed, channels):
    """Columns of channels from a car that is stepped by hand."""
    simulation = hamilcar.Simulation(car, speed=speed, step=STEP, integrator="rk4", powered=False, controllers=False)
    rows = []
    for i in range(len(next(iter(controls.values())))):
        simulation.step(STEPS, **{name: float(values[i]) for name, values in controls.items()})
        rows.append(simulation.read(channels))
    return np.array(rows).T


def measured(car, controls, speed, noise, random, **more):
    t = times(len(next(iter(controls.values()))))
    columns = drive(car, controls, speed, list(noise))
    noisy = {name: column + random.normal(0, noise[name], t.size) for name, column in zip(noise, columns)}
    return Measurement(t, controls, noisy, noise, speed=speed, **more)


def sweep(rows=125):
    t = times(rows)
    return {"steering_wheel": 0.6 * np.sin(2 * np.pi * (0.4 * t + 0.5 * t**2))}


@pytest.fixture(scope="module")
def e90():
    return hamilcar.Vehicle("bmw_e90_330i")


STARTS = {
    "chassis.mass_kg": 1.2, "chassis.inertia_kg_m2.0": 1.25, "chassis.inertia_kg_m2.1": 1.2, "chassis.inertia_kg_m2.2": 0.88,
    "chassis.center_of_mass_m.0": 1.1, "chassis.center_of_mass_m.2": 1.15, "axle.front.spring.rate_N_per_m": 0.75,
    "axle.rear.spring.rate_N_per_m": 1.3, "axle.front.anti_roll_bar.rate_N_per_m": 1.3,
    "axle.rear.anti_roll_bar.rate_N_per_m": 0.7, "tire.front.cornering_reference_N_per_rad": 1.25,
    "tire.rear.cornering_reference_N_per_rad": 0.8, "axle.front.brake.max_torque_N_m": 0.75, "front damper": 1.25,
    "rear damper": 0.75,
}


def test_fifteen_numbers_of_a_car_are_found_from_noisy_runs(e90, random):
    t = times()
    runs = [
        sweep(),
        {"steering_wheel": 0.9 * np.clip(t / 0.2, 0, 1), "drive_torque": np.full_like(t, 300.0)},
        {"drive_torque": 1500.0 * (np.sin(2.4 * np.pi * t) > 0), "brake": 0.25 * (np.sin(1.4 * np.pi * t) < -0.3)},
    ]
    unknowns, true = [], {}
    for name, factor in STARTS.items():
        axle = name.split()[0]
        dampers = [f"axle.{axle}.damper.force_N.{i}" for i in (0, 1, 2, 3, 5, 6, 7, 8)] if "damper" in name else []
        true[name] = 1.0 if dampers else e90[name]
        low, high = sorted([0.5 * true[name], 1.6 * true[name]])
        unknowns.append(Unknown(name, low, high, nominal=factor * true[name], multiplies=dampers))
    found = identify(e90, unknowns, [measured(e90, run, 22.0, NOISE, random) for run in runs], step=STEP)
    inside = [low <= true[name] <= high for name, (low, high) in found.intervals.items()]
    errors = np.array([(found.values[name] - true[name]) / found.standard_errors[name] for name in true])
    assert sum(inside) >= 13, found.text()
    assert np.all(np.abs(errors) < 3), found.text()
    assert all(found.standard_errors[name] < 0.01 * abs(true[name]) for name in true)  # so that being inside says something
    assert found.reduced_chi_square == pytest.approx(1, abs=0.1) and found.warnings == []
    assert found.vehicle["axle.front.damper.force_N.8"] == pytest.approx(1892.0, rel=0.01)


def test_the_jacobian_is_that_of_the_residuals(e90, random):
    """Against differences of the residuals, with all that an instrument may do, and a prior."""
    from hamilcar.identify._problem import Problem

    noise = {"chassis.yaw_rate": 0.1, "chassis.lateral_acceleration": 0.05}
    shared = Free(0.0, 0.08, nominal=0.033, name="delay")
    run = measured(
        e90, sweep(60), 20.0, noise, random, delay=shared, gain={"chassis.yaw_rate": Free(0.5, 1.5, nominal=1.1)},
        bias={"chassis.lateral_acceleration": Free(-1.0, 1.0)},
    )
    dampers = [f"axle.front.damper.force_N.{i}" for i in (0, 1, 2, 3, 5, 6, 7, 8)]
    unknowns = [Unknown("chassis.mass_kg", 1000.0, 2000.0, prior=(1500.0, 50.0)), Unknown("damper", 0.5, 2.0, multiplies=dampers)]
    problem = Problem(e90, unknowns, [run], step=STEP, integrator="rk4", threads=1)
    assert problem.names[2:] == ["delay", "run 1: gain of chassis.yaw_rate", "run 1: bias of chassis.lateral_acceleration"]
    x = problem.start
    exact = problem.jacobian(x)
    for i, spacing in enumerate([0.01, 1e-5, 1e-6, 1e-3, 1e-3]):  # small: dampers have kinks
        ahead, behind = x.copy(), x.copy()
        ahead[i] += spacing
        behind[i] -= spacing
        other = (problem.residuals(ahead) - problem.residuals(behind)) / (2 * spacing)
        assert np.abs(exact[:, i] - other).max() < 1e-6 * np.abs(other).max(), problem.names[i]


def test_two_numbers_of_which_only_the_product_counts_are_named(e90, random):
    coasting = {"drive_torque": np.zeros(100)}
    run = measured(e90, coasting, 40.0, {"chassis.speed": 0.005}, random)
    drag, area, mass = "aerodynamics.drag_coefficient", "aerodynamics.frontal_area_m2", "chassis.mass_kg"
    unknowns = [Unknown(name, 0.7 * e90[name], 1.3 * e90[name], nominal=1.1 * e90[name]) for name in (drag, area)]
    found = identify(e90, [*unknowns, Unknown(mass, 1400.0, 1500.0, prior=(1442.1, 5.0))], [run], step=STEP)
    weakest = found.directions[-1]
    assert not weakest.is_known and sum(one.is_known for one in found.directions) == 2
    assert abs(weakest.shares[drag]) == pytest.approx(0.5**0.5, abs=0.1) and weakest.shares[drag] * weakest.shares[area] < 0
    assert abs(weakest.shares[mass]) < 0.05
    (named,) = [line for line in found.warnings if "not identifiable" in line]
    assert drag in named and area in named and mass not in named and named in found.text()
    assert found.values[drag] * found.values[area] == pytest.approx(0.30 * 2.09, rel=0.03)


def test_bias_gain_and_delay_of_instruments_are_found(e90, random):
    """Two runs with one inertial unit: its delay and gain are shared, its bias differs."""
    noise = {"chassis.yaw_rate": 0.1, "chassis.lateral_acceleration": 0.05}
    runs = []
    for speed, bias in ((20.0, 0.8), (26.0, -0.5)):
        columns = drive(e90, sweep(), speed, list(noise))
        late = {}  # by two rows, 0.04 s; before the start nothing turns
        for name, column in zip(noise, columns):
            late[name] = np.concatenate([[0.0, 0.0], column[:-2]]) + random.normal(0, noise[name], column.size)
        late["chassis.yaw_rate"] = 1.05 * late["chassis.yaw_rate"] + bias
        runs.append(
            Measurement(
                times(), sweep(), late, noise, speed=speed, delay=Free(0.0, 0.1, name="delay"),
                gain={"chassis.yaw_rate": Free(0.8, 1.2, name="gain")}, bias={"chassis.yaw_rate": Free(-3.0, 3.0)},
            )
        )
    found = identify(e90, [Unknown("chassis.mass_kg", 1000.0, 2000.0, nominal=1700.0)], runs, step=STEP)
    bias = "bias of chassis.yaw_rate"
    expected = {"chassis.mass_kg": 1442.1, "delay": 0.04, "gain": 1.05, f"run 1: {bias}": 0.8, f"run 2: {bias}": -0.5}
    assert set(found.names) == set(expected)
    for name, true in expected.items():
        assert abs(found.values[name] - true) < 3.5 * found.standard_errors[name], found.text()
    assert found.standard_errors["delay"] < 1e-3 and found.standard_errors["gain"] < 0.01


def test_outliers_hardly_count_with_soft_l1(e90, random):
    noise = {"chassis.yaw_rate": 0.1, "chassis.lateral_acceleration": 0.05}
    run = measured(e90, sweep(), 22.0, noise, random)
    for name, values in run.measured.items():
        values[random.choice(values.size, 12, replace=False)] += 60 * noise[name]
    unknowns = [
        Unknown("tire.front.cornering_reference_N_per_rad", 150e3, 350e3, nominal=190e3),
        Unknown("chassis.inertia_kg_m2.2", 2100.0, 3000.0, nominal=2400.0),
    ]
    robust = identify(e90, unknowns, [run], step=STEP, loss="soft_l1")
    plain = identify(e90, unknowns, [run], step=STEP)

    def off(found, name):
        return abs(found.values[name] - e90[name])

    for one in unknowns:
        assert off(robust, one.name) < 3 * robust.standard_errors[one.name], robust.text()
        assert robust.standard_errors[one.name] < 0.5 * plain.standard_errors[one.name]
    front = unknowns[0].name
    assert off(robust, front) < 0.3 * off(plain, front)
    assert any("as large as the stated noise" in line for line in plain.warnings)


def test_standard_errors_are_those_of_a_straight_line():
    """With one bias as the only thing that matters, the standard error is that of a mean: sd / sqrt(n)."""
    random = np.random.default_rng(2)
    t = times(100)
    readings = 3.0 + random.normal(0, 0.5, t.size)
    run = Measurement(t, {}, {"chassis.yaw_rate": readings}, 0.1, speed=20.0, bias=Free(-10.0, 10.0, name="bias"))
    mass = Unknown("chassis.mass_kg", 900.0, 1300.0, prior=(1050.0, 20.0))
    found = identify("bmw_323i", [mass], [run], step=STEP)
    assert found.values["bias"] == pytest.approx(readings.mean(), abs=1e-6)
    assert found.standard_errors["bias"] == pytest.approx(readings.std(ddof=2) / 10, rel=1e-3)
    assert found.standard_errors["chassis.mass_kg"] == pytest.approx(20.0, rel=1e-3)  # of which the run says nothing
    assert found.values["chassis.mass_kg"] == pytest.approx(1050.0, abs=1.0)
    assert found.intervals["bias"][1] - found.values["bias"] == pytest.approx(1.984 * found.standard_errors["bias"], rel=2e-3)
    assert found.interval("bias", 0.5)[1] - found.values["bias"] == pytest.approx(0.677 * found.standard_errors["bias"], rel=2e-3)


def test_several_starts_find_what_one_does_not(random):
    """A delay of several waves' length has many best places nearby; the best of all starts counts."""
    t, wave = times(), sweep()
    (column,) = drive("bmw_323i", wave, 15.0, ["chassis.yaw_rate"])
    late = np.concatenate([np.zeros(40), column[:-40]]) + random.normal(0, 0.1, t.size)
    run = Measurement(t, wave, {"chassis.yaw_rate": late}, 0.1, speed=15.0, delay=Free(0.0, 1.0, name="delay", nominal=0.02))
    mass = Unknown("chassis.mass_kg", 900.0, 1300.0, prior=(1050.0, 20.0))
    one = identify("bmw_323i", [mass], [run], step=STEP, max_evaluations=30)
    several = identify("bmw_323i", [mass], [run], step=STEP, max_evaluations=30, starts=6)
    assert len(several.start_costs) == 6 and min(several.start_costs) < 0.1 * one.start_costs[0]
    assert several.values["delay"] == pytest.approx(0.8, abs=0.005) and abs(one.values["delay"] - 0.8) > 0.1


def test_what_stands_on_a_bound_and_a_wrong_model_are_told(e90, random):
    run = measured(e90, sweep(), 22.0, {"chassis.yaw_rate": 0.1}, random)
    found = identify(e90, [Unknown("tire.front.cornering_reference_N_per_rad", 100e3, 180e3, nominal=150e3)], [run], step=STEP)
    text = " ".join(found.warnings)
    assert "bound 180000" in text and "stated noise" in text and "autocorrelation" in text


def test_reports_tell_values_warnings_and_plots(random, tmp_path):
    run = measured("bmw_323i", sweep(60), 20.0, {"chassis.yaw_rate": 0.1}, random, name="sweep <1>")
    found = identify("bmw_323i", [Unknown("chassis.mass_kg", 900.0, 1300.0)], [run], step=STEP)
    found.to_html(tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert page.count("<svg") == 1 and "sweep &lt;1&gt;" in page and "chassis.mass_kg" in page and "http" not in page
    assert f"{found.values['chassis.mass_kg']:.6g}" in found.text() and f"{found.values['chassis.mass_kg']:.6g}" in page
    (fit,) = found.fits
    assert fit.sd == pytest.approx(0.1, rel=0.3) and fit.durbin_watson == pytest.approx(2, abs=0.6)


def test_missing_samples_and_own_intervals_are_no_matter(random):
    """Samples at uneven times, some of them missing, between the rows of the rollout."""
    noise = {"chassis.yaw_rate": 0.02}
    whole = measured("bmw_323i", sweep(), 20.0, noise, random)
    values = whole.measured["chassis.yaw_rate"].copy()
    values[10:30] = np.nan
    run = Measurement(whole.time, whole.controls, {"chassis.yaw_rate": values}, 0.02, speed=20.0, interval=STEPS * STEP)
    found = identify("bmw_323i", [Unknown("chassis.mass_kg", 900.0, 1300.0, nominal=1250.0)], [run], step=STEP)
    true = hamilcar.Vehicle("bmw_323i")["chassis.mass_kg"]
    assert abs(found.values["chassis.mass_kg"] - true) < 3.5 * found.standard_errors["chassis.mass_kg"]
    assert found.fits[0].time.size == 105
