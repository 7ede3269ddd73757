"""Studies: points against single runs, physics, refusals, JSON."""

import json
import pickle

import numpy as np
import pytest

import hamilcar
from hamilcar.study import Parameter, Study, latin_hypercube

MASS = Parameter("chassis.mass_kg", 900.0, 1300.0)
TWO = [Parameter("a", -1.0, 3.0), Parameter("n", 1, 4, whole=True)]


def ends_high(outcome):
    return outcome.runs[-1]["chassis.rate.yaw"][-1] + outcome["steady roll angle"]


def slowest(recorded):
    return min(recorded["chassis.speed"])


def square(point):
    if point["a"] < 0:
        raise ValueError("a is negative")
    return {"square": point["a"] ** 2, "sum": point["a"] + point["n"]}


# Points against single runs


def test_a_maneuver_has_the_bits_of_single_drives(car):
    parameters = [MASS, Parameter("scenario.road.friction", 0.6, 1.0), Parameter("maneuver.speed", 60.0, 100.0)]
    study = Study(car, parameters, ["yaw rate gain", ends_high], maneuver="step_steer", settings={"lateral_acceleration": 3})
    assert study.units == {
        "chassis.mass_kg": "kg", "scenario.road.friction": "", "maneuver.speed": "km/h", "yaw rate gain": "deg/s/deg",
        "ends_high": "",
    }
    X = latin_hypercube(study.parameters, 2)
    Y = study.evaluate(X)
    for (mass, friction, speed), figures in zip(X, Y):
        road = {"name": "r", "vehicle": car.source, "duration_s": 1.0, "road": {"friction": friction}}
        outcome = hamilcar.maneuver(
            "step_steer", car.changed({"chassis.mass_kg": mass}), scenario=road, speed=speed, lateral_acceleration=3
        )
        assert list(figures) == [outcome["yaw rate gain"], ends_high(outcome)]
    again = Study.from_dict(json.loads(json.dumps(study.to_dict())))
    assert np.array_equal(again.evaluate(X), Y) and again.units == study.units
    assert np.array_equal(pickle.loads(pickle.dumps(study)).evaluate(X[:1]), Y[:1])
    car["axle.front.spring.rate_N_per_m"] *= 1.5
    assert np.array_equal(study.evaluate(X[:1]), Y[:1])  # a study keeps the vehicle that it was given


def test_a_scenario_is_reduced_over_its_rows(car):
    figures = [f"{word} chassis.rate.yaw" for word in ("min", "max", "mean", "rms", "last", "peak-to-peak")]
    parameters = [MASS, Parameter("scenario.initial.velocity_m_per_s", 10, 25)]
    study = Study(car, parameters, [*figures, slowest], scenario="step_steer", record=["chassis.speed"])
    Y = study.evaluate([[1000.0, 15.0]])
    scenario = hamilcar.Scenario("step_steer", {"initial.velocity_m_per_s": 15.0})
    channels = ["chassis.rate.yaw", "chassis.speed"]
    driven = hamilcar.run(scenario, car.changed({"chassis.mass_kg": 1000.0}), channels=channels)
    rate = driven["chassis.rate.yaw"].tolist()
    mean = sum(rate) / len(rate)
    rms = (sum(value * value for value in rate) / len(rate)) ** 0.5
    assert Y[0, :6].tolist() == pytest.approx([min(rate), max(rate), mean, rms, rate[-1], max(rate) - min(rate)], rel=1e-12)
    assert Y[0, 6] == driven["chassis.speed"].tolist()[0]  # the torque of the scenario makes it faster from then on
    assert study.units["max chassis.rate.yaw"] == "deg/s" and study.units["scenario.initial.velocity_m_per_s"] == "m/s"


def test_a_batch_has_the_bits_of_single_cars(car):
    angles = np.linspace(0.0, 0.8, 12)
    batch = {"controls": {"steering_wheel": angles, "drive_torque": 90.0}, "steps": 20, "speed": 20.0, "powered": False}
    parameters = [MASS, Parameter("scenario.road.friction", 0.3, 1.0)]
    figures = ["max chassis.rate.yaw", "last chassis.speed", slowest]
    study = Study(car, parameters, figures, batch=batch, record=["chassis.speed"])
    study = Study.from_dict(json.loads(json.dumps(study.to_dict())))
    X = [[950.0, 0.4], [-5.0, 0.4], [1250.0, 0.9]]
    Y, reasons = study.rows(X)
    for row in (0, 2):
        own = car.changed({"chassis.mass_kg": X[row][0]})
        alone = hamilcar.Simulation(own, speed=20.0, powered=False, friction=X[row][1])
        rates, speeds = [], []
        for angle in angles:
            alone.step(20, steering_wheel=angle, drive_torque=90.0)
            rates.append(alone["chassis.rate.yaw"]), speeds.append(alone["chassis.speed"])
        assert Y[row].tolist() == [max(rates), speeds[-1], min(speeds)]
        assert np.array_equal(study.evaluate([X[row]])[0], Y[row])  # by itself, as well
    assert np.isnan(Y[1]).all() and "expected a positive number" in reasons[1] and reasons[0] == reasons[2] == ""
    assert np.array_equal(study.evaluate(X), Y, equal_nan=True)  # the refused car leaves nothing behind


def test_points_that_cannot_be_driven_are_rows_of_nan_with_a_reason(car):
    study = Study(car, [MASS], ["yaw rate gain", "steady roll angle"], maneuver="step_steer")
    Y, reasons = study.rows([[1000.0], [-1.0]])
    assert np.isfinite(Y[0]).all() and np.isnan(Y[1]).all()
    assert reasons == ["", "Vehicle: key 'chassis.mass_kg' = -1.0: expected a positive number [kg]"]


def test_what_counts_something_stays_whole(car):
    attempts, search = Parameter("maneuver.attempts", 1, 3), {"search": True}
    study = Study(car, [attempts], ["entry speed"], maneuver="double_lane_change", settings=search)
    assert study.parameters[0].whole and sorted(latin_hypercube(study.parameters, 3)[:, 0]) == [1, 2, 3]
    _, reasons = study.rows([[1.5]])
    assert "whole" in reasons[0]


def test_several_keys_get_one_value(car):
    both = Parameter("springs", 20e3, 30e3, keys=("axle.front.spring.rate_N_per_m", "axle.rear.spring.rate_N_per_m"))
    study = Study(car, [both], ["steady roll angle"], maneuver="step_steer")
    changed = car.changed({key: 22e3 for key in both.keys})
    assert study.evaluate([[22e3]])[0, 0] == hamilcar.maneuver("step_steer", changed)["steady roll angle"]
    assert study.units["springs"] == "N/m"


# Physics


def test_a_stiffer_front_bar_understeers_more_and_a_stiffer_rear_bar_less():
    bars = [Parameter(f"axle.{axle}.anti_roll_bar.rate_N_per_m", 1e3, 30e3) for axle in ("front", "rear")]
    study = Study("bmw_323i", bars, ["understeer gradient of the wheels at 4 m/s^2"], maneuver="constant_speed")
    soft, front, rear = study.evaluate([[3e3, 3e3], [20e3, 3e3], [3e3, 20e3]])[:, 0]
    assert rear < 0.9 * soft and 1.05 * soft < front


def test_with_the_pedal_held_deceleration_goes_by_one_over_the_mass(car):
    """Half-applied brakes have a torque, not a slip: force over everything's mass, drag and the wheels' inertia apart."""
    study = Study(car, [MASS], ["MFDD", "stopping distance"], maneuver="straight_braking", settings={"pedal": 30, "speed": 60})
    Y = study.evaluate([[900.0], [1300.0]])
    masses = [car.changed({"chassis.mass_kg": mass}).total_mass for mass in (900.0, 1300.0)]
    assert Y[0, 0] / Y[1, 0] == pytest.approx(masses[1] / masses[0], rel=0.02)
    assert Y[1, 1] / Y[0, 1] == pytest.approx(masses[1] / masses[0], rel=0.05)


# Refusals


def step_steer(parameter, figures=("yaw rate gain",), **more):
    return Study("bmw_323i", [parameter], list(figures), maneuver="step_steer", **more)


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: step_steer(Parameter("chassis.mas_kg", 1, 2)), "did you mean 'mass_kg'"),
        (lambda: step_steer(Parameter("chassis.mass_kg", 0, 2)), "takes more than 0 to inf .kg."),
        (lambda: step_steer(Parameter("chassis.mass_kg", 1, 2, unit="t")), "in 't': expected 'kg'"),
        (lambda: step_steer(Parameter("maneuver.spee", 50, 90)), "did you mean 'maneuver.speed'"),
        (lambda: step_steer(Parameter("maneuver.speed", 50, 900)), "takes 20 to 250 .km/h."),
        (lambda: step_steer(Parameter("maneuver.speed", 50, 90), settings={"speed": 80}), "both a parameter and a setting"),
        (lambda: step_steer(Parameter("scenario.road.frictio", 0.5, 1)), "did you mean 'friction'"),
        (lambda: step_steer(Parameter("scenario.duration_s", 1, 2)), "road and solver alone"),
        (lambda: step_steer(MASS, ["yaw rate gan"]), "did you mean 'yaw rate gain'"),
        (lambda: step_steer(MASS, settings={"speeed": 3}), "did you mean 'speed'"),
        (lambda: step_steer(MASS, ["TB value", "TB value"]), "wanted twice"),
        (lambda: step_steer(MASS, scenario="step_steer", function=square), "expected one of maneuver"),
        (lambda: Study("bmw_323i", [MASS], maneuver="step_ster"), "did you mean 'step_steer'"),
        (lambda: Study("bmw_323i", [MASS, MASS], maneuver="step_steer"), "varied twice"),
        (lambda: Study("bmw_323i", [], maneuver="step_steer"), "at least one"),
        (lambda: Study("bmw_323i", [Parameter("maneuver.low_side", 0, 1)], maneuver="split_braking"), "a setting that is a number"),
        (lambda: Study("bmw_323i", [MASS], scenario="step_steer"), "at least one, such as"),
        (lambda: Study("bmw_323i", [MASS], ["mx chassis.speed"], scenario="step_steer"), "did you mean 'max'"),
        (lambda: Study("bmw_323i", [MASS], ["max chassis.sped"], scenario="step_steer"), "did you mean 'chassis.speed'"),
        (lambda: Study("bmw_323i", [MASS], ["max chassis.speed"], batch={"controls": {"brake": 0.1}}), "rows=..."),
        (lambda: Study("bmw_323i", [MASS], ["max chassis.speed"], batch={"controls": {"brak": [0.1]}}), "did you mean 'brake'"),
        (lambda: Study("bmw_323i", [MASS], ["max chassis.speed"], batch={"rows": 2, "sped": 3}), "did you mean 'speed'"),
        (lambda: Study("bmw_323i", TWO, ["a"], function=square), "expected one of|None in the place"),
        (lambda: Study(None, TWO, ["a", "b"], function=square), "rename one"),
        (lambda: Study(None, TWO, [], function=square), "names of what the function returns"),
        (lambda: Study("bmw_323i", [MASS]), "expected one of maneuver"),
    ],
)
def test_studies_refuse(call, text):
    with pytest.raises((ValueError, TypeError, KeyError), match=text):
        call()


def test_points_of_another_shape_are_refused():
    study = Study(None, TWO, ["square", "sum"], function=square)
    for X, text in (([[1.0]], "expected .n, 2., columns a, n"), ([1.0], "expected .n, 2."), ([[1.0, np.nan]], "0, 1. = nan")):
        with pytest.raises(ValueError, match=text):
            study.evaluate(X)


def test_functions_that_others_cannot_import_stay_here():
    study = Study(None, TWO, {"f": "m"}, function=lambda point: [point["a"]])
    assert study.evaluate([[2.0, 1.0]]).tolist() == [[2.0]] and study.units["f"] == "m"
    with pytest.raises(TypeError, match="cannot import this function"):
        study.to_dict()
