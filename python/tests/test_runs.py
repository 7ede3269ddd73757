"""Whole runs and maneuvers: the numbers of the command line, as arrays."""

import json
import subprocess
import sys

import numpy as np
import pytest

import hamilcar


def program(*arguments, cwd):
    return subprocess.run(
        [sys.executable, "-m", "hamilcar", *arguments], cwd=cwd, capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("name", ["step_steer", "slalom", "rough_road"])
def test_has_the_bits_of_the_program(name, tmp_path):
    scenario = hamilcar.Scenario(name)
    done = program("run", scenario.source, "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    theirs, ours = hamilcar.read(tmp_path / "out" / "results.nc"), hamilcar.run(name)
    assert set(theirs.names) == set(ours.names)
    for column in ("time", *ours.names):
        assert np.array_equal(theirs[column], ours[column]), column
    assert theirs.units == ours.units and theirs.meanings == ours.meanings


def test_maneuvers_have_the_figures_of_the_program(car, tmp_path):
    done = program(
        "run", "--maneuver", "step_steer", "--vehicle", car.source, "--set", "speed=70", "--no-recording", "-o", "out",
        cwd=tmp_path,
    )
    assert done.returncode in (0, 1), done.stderr
    theirs = json.loads((tmp_path / "out" / "outcome.json").read_text())
    outcome = hamilcar.maneuver("step_steer", car, speed=70, record=False)
    assert outcome.to_dict()["figures"] == theirs["figures"]
    assert outcome.figures and not outcome.runs
    assert outcome["yaw rate gain"] == outcome.figures["yaw rate gain"].value


def test_maneuver_keeps_what_was_driven(car, tmp_path):
    outcome = hamilcar.maneuver("double_lane_change", car, channels=["chassis.position.*"])
    assert outcome.passed is all(verdict.passed for verdict in outcome.verdicts)
    run = outcome.runs[-1]
    assert run["chassis.position.x"][-1] > 100
    outcome.to_html(tmp_path / "page.html")
    assert "<html" in (tmp_path / "page.html").read_text()[:200].lower()
    assert "double_lane_change" in repr(outcome)


def test_mistakes_in_maneuvers_are_told(car):
    with pytest.raises(hamilcar.InputError, match="did you mean 'step_steer'"):
        hamilcar.maneuver("step_stear", car)
    with pytest.raises(hamilcar.InputError, match="speed.*expected.*km/h"):
        hamilcar.maneuver("step_steer", car, speed=-5)
    with pytest.raises(hamilcar.InputError, match="there is no setting|has no setting|speeed"):
        hamilcar.maneuver("step_steer", car, speeed=80)
    with pytest.raises(KeyError, match="did you mean 'yaw rate gain'"):
        hamilcar.maneuver("step_steer", car, record=False)["yaw rate gian"]
    assert "speed" in car.maneuvers()["step_steer"]["settings"]


def test_another_vehicle_takes_the_scenarios_place():
    light = hamilcar.Vehicle("bmw_323i", {"chassis.mass_kg": 800.0})
    ours, theirs = (hamilcar.run("step_steer", v, channels=["chassis.yaw_rate"], picture=False) for v in (light, None))
    assert ours.names == ["chassis.yaw_rate"]
    assert ours["chassis.yaw_rate"][-1] != theirs["chassis.yaw_rate"][-1]


def test_results_are_arrays_with_units():
    result = hamilcar.run("step_steer", channels=["chassis.yaw_rate", "chassis.position.x"], interval=0.05)
    assert result.units["chassis.yaw_rate"] == "deg/s"
    assert len(result) == 121 and result.time[1] == pytest.approx(0.05)
    assert "chassis.yaw_rate" in result and "time" not in list(result)
    with pytest.raises(ValueError):
        result["chassis.yaw_rate"][0] = 1  # what was recorded stays
    with pytest.raises(KeyError, match="was not recorded; did you mean 'chassis.yaw_rate'"):
        result["chassis.yaw_rte"]
    assert result.summary["duration_s"] == 6
    assert result.summary["max_violation_m"] < 1e-6
    assert "121 rows" in repr(result)


def test_results_go_to_files_and_back(tmp_path):
    result = hamilcar.run("step_steer")
    result.to_netcdf(tmp_path / "a.nc")
    again = hamilcar.read(tmp_path / "a.nc")
    assert all(np.array_equal(again[name], result[name]) for name in result.names)
    assert again.units == result.units
    result.to_html(tmp_path / "a.html")
    assert (tmp_path / "a.html").stat().st_size > 100_000
    assert "iframe" in result._repr_html_()
    shown = program("view", "a.nc", "-o", "view.html", cwd=tmp_path)
    assert shown.returncode == 0, shown.stderr


def test_results_go_to_xarray():
    xarray = pytest.importorskip("xarray")
    result = hamilcar.run("step_steer", channels=["chassis.yaw_rate"], picture=False)
    data = result.to_xarray()
    assert isinstance(data, xarray.Dataset)
    assert data["chassis.yaw_rate"].attrs["units"] == "deg/s"
    assert float(data["chassis.yaw_rate"].sel(time=3.0)) == result["chassis.yaw_rate"][300]


def test_results_draw_themselves():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    result = hamilcar.run("step_steer")
    axes = result.plot("chassis.rate.yaw", "chassis.lateral_acceleration")
    assert "[deg/s]" in axes[0].get_ylabel()
    with pytest.raises(KeyError):
        result.plot("nonsense")


def test_a_run_that_cannot_go_on_keeps_its_rows(car):
    scenario = hamilcar.Scenario("step_steer", {"solver.step_s": 0.01})
    stiff = car.changed({"axle.front.spring.rate_N_per_m": 9e8, "axle.rear.spring.rate_N_per_m": 9e8})
    with pytest.raises(hamilcar.NumericalError) as told:
        hamilcar.run(scenario, stiff)
    assert len(told.value.results) > 0


def test_a_maneuvers_scenario_is_told_so():
    with pytest.raises(ValueError, match="use hamilcar.maneuver"):
        hamilcar.run({"name": "m", "vehicle": hamilcar.Vehicle().source, "maneuver": {"name": "step_steer"}})


def test_the_command_line_is_there(tmp_path):
    assert program("--version", cwd=tmp_path).stdout.startswith(f"hamilcar {hamilcar.__version__}")
    assert program("check", cwd=tmp_path).returncode == 2  # of usage, as it says
    assert program("run", "--maneuver", "nonsense", cwd=tmp_path).returncode == 2
