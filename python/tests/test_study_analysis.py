"""Sensitivity and optimization: against published indices and closed forms, then once on a vehicle."""

import math

import numpy as np
import pytest

from hamilcar.study import Parameter, Study

ANGLES = [Parameter(f"x{i}", -math.pi, math.pi, unit="rad") for i in (1, 2, 3)]
PLANE = [Parameter("x", -2.0, 2.0), Parameter("n", 0, 4, whole=True)]


def ishigami(point):
    """Ishigami and Homma (1990), a = 7, b = 0.1."""
    x1, x2, x3 = point["x1"], point["x2"], point["x3"]
    return {"f": math.sin(x1) + 7 * math.sin(x2) ** 2 + 0.1 * x3**4 * math.sin(x1), "twice x2": 2 * x2}


def patchy(point):
    if 0.5 < point["x1"] < 0.6:
        raise ValueError("does not settle")
    return ishigami(point)


def bowl(point):
    """Smallest at x = 1, n = 3, where the value is 0; it does not exist below x = -1."""
    if point["x"] < -1:
        raise ValueError("x is too small")
    return {"bowl": (point["x"] - 1) ** 2 + (point["n"] - 3) ** 2, "x again": point["x"]}


def study_of(function, parameters, figures):
    return Study(None, parameters, figures, function=function)


def test_sobol_has_the_published_indices_of_ishigami():
    pytest.importorskip("SALib")
    found = study_of(ishigami, ANGLES, ["f", "twice x2"]).sensitivity("sobol", 1024, second_order=True)
    # Saltelli et al., Global Sensitivity Analysis: The Primer (2008), chapter 4
    assert found["S1"][0] == pytest.approx([0.3139, 0.4424, 0.0], abs=0.03)
    assert found["ST"][0] == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.03)
    assert found["S2"][0][0, 2] == pytest.approx(0.2437, abs=0.05)
    assert found["S1"][1] == pytest.approx([0.0, 1.0, 0.0], abs=0.03)  # a figure of its own
    assert [name for name, _ in found.ranking("f")] == ["x1", "x2", "x3"] and found.X.shape == (8192, 3)


def test_points_without_figures_leave_their_group_out():
    pytest.importorskip("SALib")
    found = study_of(patchy, ANGLES, ["f", "twice x2"]).sensitivity("sobol", 1024)
    lost = int(np.isnan(found.Y).any(axis=1).sum())
    assert 0 < lost <= found.left_out[0] and found.left_out[0] % 5 == 0 and found.left_out[0] == found.left_out[1]
    assert found["ST"][0] == pytest.approx([0.5576, 0.4424, 0.2437], abs=0.06)  # a sixtieth of x1's range is not there
    half = Study(None, ANGLES, ["f", "never"], function=lambda point: [point["x1"], math.nan]).sensitivity("sobol", 256)
    assert half["ST"][0] == pytest.approx([1, 0, 0], abs=0.03) and np.isnan(half["ST"][1]).all()
    assert list(half.left_out) == [0, 1280]
    nothing = Study(None, ANGLES, ["f"], function=lambda point: [math.nan])
    with pytest.raises(ValueError, match="40 of 40 points have no figures"):
        nothing.sensitivity("sobol", 8)


def test_morris_gives_the_slopes_of_a_plane():
    pytest.importorskip("SALib")
    parameters = [Parameter("a", 0.0, 2.0), Parameter("b", -1.0, 3.0)]
    found = Study(None, parameters, ["f"], function=lambda point: [3 * point["a"] - point["b"]]).sensitivity("morris", 8)
    assert found["mu"][0] == pytest.approx([6.0, -4.0])  # slope times range
    assert found["mu_star"][0] == pytest.approx([6.0, 4.0]) and found["sigma"][0] == pytest.approx([0, 0], abs=1e-12)
    assert found.ranking("f") == [("a", pytest.approx(6.0)), ("b", pytest.approx(4.0))]


def test_salib_takes_a_study_as_it_is():
    pytest.importorskip("SALib")
    study = study_of(ishigami, ANGLES, ["f", "twice x2"])
    spec = study.problem_spec().sample_sobol(64, calc_second_order=False, seed=1).evaluate(study.evaluate)
    assert spec["outputs"] == ["f", "twice x2"] and spec.results.shape == (320, 2)


def test_pymoo_finds_the_bottom_within_its_limits():
    pytest.importorskip("pymoo")
    from pymoo.algorithms.soo.nonconvex.ga import GA
    from pymoo.optimize import minimize

    study = study_of(bowl, PLANE, ["bowl", "x again"])
    free = minimize(study.pymoo_problem(["bowl"]), GA(pop_size=30), ("n_gen", 25), seed=1)
    assert free.X[0] == pytest.approx(1.0, abs=0.05) and round(free.X[1]) == 3 and free.F[0] < 0.01
    limited = minimize(
        study.pymoo_problem({"bowl": "min"}, {"x again": (None, 0.5)}), GA(pop_size=30), ("n_gen", 25), seed=1
    )
    assert limited.F[0] == pytest.approx(0.25, abs=0.05) and limited.X[0] <= 0.5 + 1e-9


def test_pymoo_counts_points_without_figures_as_infeasible():
    pytest.importorskip("pymoo")
    problem = study_of(bowl, PLANE, ["bowl", "x again"]).pymoo_problem({"bowl": "max", "x again": 0.5}, {"x again": (-0.5, 1.0)})
    out = problem.evaluate(np.array([[0.0, 3.2], [-1.5, 3.0], [2.0, 3.0]]), return_as_dictionary=True)
    assert out["F"][0].tolist() == [-1.0, 0.5] and out["G"][0].tolist() == [-0.5, -1.0, -1.0]  # 3.2 is 3
    assert (out["G"][1] > 1e20).all() and np.isfinite(out["F"]).all()
    assert out["G"][2].tolist() == [-2.5, 1.0, -1.0]


def test_optuna_finds_the_bottom_and_prunes_what_has_no_figures():
    optuna = pytest.importorskip("optuna")
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    search = optuna.create_study(directions=["minimize"], sampler=optuna.samplers.TPESampler(seed=1))
    search.optimize(study_of(bowl, PLANE, ["bowl", "x again"]).optuna_objective(["bowl"], {"x again": (None, 0.5)}), n_trials=80)
    pruned = [trial for trial in search.trials if trial.state == optuna.trial.TrialState.PRUNED]
    assert pruned and all(trial.user_attrs["reason"] == "x is too small" and trial.params["x"] < -1 for trial in pruned)
    assert search.best_trial.params["n"] == 3 and 0.25 <= search.best_value < 0.4 and search.best_trial.params["x"] <= 0.5
    assert search.best_trial.user_attrs["x again"] == search.best_trial.params["x"]


def test_a_vehicle_goes_through_all_of_them():
    for module in ("SALib", "pymoo", "optuna"):
        pytest.importorskip(module)
    import optuna

    bars = [Parameter(f"axle.{axle}.anti_roll_bar.rate_N_per_m", 2e3, 20e3) for axle in ("front", "rear")]
    study = Study("bmw_323i", bars, ["steady roll angle", "yaw rate gain"], maneuver="step_steer")
    found = study.sensitivity("morris", 2)
    assert (found["mu"][0] < 0).all()  # either bar holds the body upright
    problem = study.pymoo_problem(["steady roll angle"], {"yaw rate gain": (0.25, None)})
    out = problem.evaluate(np.array([[5e3, 5e3]]), return_as_dictionary=True)
    roll, gain = study.evaluate([[5e3, 5e3]])[0]
    assert out["F"][0, 0] == roll and out["G"][0, 0] == 0.25 - gain
    search = optuna.create_study(directions=["minimize", "minimize"])
    search.enqueue_trial({bars[0].name: 5e3, bars[1].name: 5e3})
    search.optimize(study.optuna_objective({"steady roll angle": "min", "yaw rate gain": "max"}), n_trials=1)
    assert search.trials[0].values == [roll, -gain]


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda study: study.sensitivity("sobel", 8), "expected 'sobol' or 'morris'"),
        (lambda study: study.sensitivity("sobol", 1), "points = 1"),
        (lambda study: study.sensitivity("sobol", 8, evaluate=lambda X: X[:3]), "evaluate returned"),
        (lambda study: study.pymoo_problem([]), "at least one"),
        (lambda study: study.pymoo_problem(["bow"]), "did you mean 'bowl'"),
        (lambda study: study.pymoo_problem({"bowl": "least"}), "expected 'min', 'max' or the value"),
        (lambda study: study.pymoo_problem(["bowl"], {"bowl": 3.0}), "expected .low, high."),
    ],
)
def test_analyses_refuse(call, text):
    for module in ("SALib", "pymoo"):
        pytest.importorskip(module)
    with pytest.raises((ValueError, KeyError), match=text):
        call(study_of(bowl, PLANE, ["bowl", "x again"]))
