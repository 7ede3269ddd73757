"""Designs, and results as tables."""

import csv

import numpy as np
import pytest

from hamilcar.study import (
    Parameter, Study, StudyResult, full_factorial, latin_hypercube, one_at_a_time, open_folder, read_table, sobol,
)

TWO = [Parameter("a", -1.0, 3.0), Parameter("n", 1, 4, whole=True)]


def square(point):
    if point["a"] < 0:
        raise ValueError("a is negative")
    return {"square": point["a"] ** 2, "sum": point["a"] + point["n"]}


def test_latin_hypercube_uses_each_part_of_each_range_once():
    X = latin_hypercube([Parameter("a", -1.0, 3.0), Parameter("b", 10.0, 20.0)], 40, seed=3)
    for column, low, high in ((0, -1.0, 3.0), (1, 10.0, 20.0)):
        parts = np.floor((X[:, column] - low) / (high - low) * 40).astype(int)
        assert sorted(parts) == list(range(40))
    assert abs(np.corrcoef(X.T)[0, 1]) < 0.5  # parts are paired at random
    assert np.array_equal(X, latin_hypercube([Parameter("a", -1.0, 3.0), Parameter("b", 10.0, 20.0)], 40, seed=3))
    assert not np.array_equal(X, latin_hypercube([Parameter("a", -1.0, 3.0), Parameter("b", 10.0, 20.0)], 40, seed=4))


def test_what_counts_something_gets_every_value_equally_often():
    assert sorted(latin_hypercube(TWO, 8)[:, 1]) == [1, 1, 2, 2, 3, 3, 4, 4]


def test_full_factorial_has_every_combination_the_last_fastest():
    expected = [[-1, 1], [-1, 4], [1, 1], [1, 4], [3, 1], [3, 4]]
    assert full_factorial(TWO, [3, 2]).tolist() == expected
    assert full_factorial(TWO, [1, 1]).tolist() == [[1, 2]]  # the middle, half of 5 rounded to the even one


def test_one_at_a_time_moves_one_at_a_time():
    assert one_at_a_time(TWO, 2, base=[0.5, 2]).tolist() == [[0.5, 2], [-1, 2], [3, 2], [0.5, 1], [0.5, 4]]


def test_sobol_is_the_sequence_and_keeps_points_when_there_are_more():
    pytest.importorskip("scipy")
    unit = [Parameter("a", 0.0, 1.0), Parameter("b", 0.0, 1.0)]
    expected = [[0, 0], [0.5, 0.5], [0.75, 0.25], [0.25, 0.75]]  # Sobol's own first points
    assert sobol(unit, 4, scramble=False).tolist() == expected
    assert np.array_equal(sobol(unit, 8, seed=5)[:5], sobol(unit, 5, seed=5))
    assert not np.array_equal(sobol(unit, 8, seed=5), sobol(unit, 8, seed=6))


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: latin_hypercube(TWO, 0), "points = 0: expected a whole number"),
        (lambda: full_factorial(TWO, [2]), "one for each of 2 parameters"),
        (lambda: full_factorial(TWO, [2, 0]), "levels of n = 0"),
        (lambda: one_at_a_time(TWO, 2, base=[1.0]), "base of shape"),
        (lambda: Parameter("a", 1.0, 1.0), "expected min < max"),
        (lambda: Parameter("a", 0.0, np.inf), "expected min < max, both finite"),
        (lambda: Parameter("a", "low", 1.0), "a: min = 'low': expected a number"),
    ],
)
def test_designs_refuse(call, text):
    with pytest.raises((ValueError, TypeError), match=text):
        call()


@pytest.fixture
def result():
    return Study(None, TWO, {"square": "m^2", "sum": ""}, function=square).run([[0.1, 1], [-1.0, 2], [2.0, 3]], progress=False)


def test_results_have_columns_reasons_and_units(result):
    assert result["square"].tolist()[::2] == [0.1**2, 4.0] and result["n"].tolist() == [1, 2, 3]
    assert result.failed.tolist() == [False, True, False] and result.reasons == ["", "a is negative", ""]
    assert np.isnan(result.Y[1]).all()
    with pytest.raises(KeyError, match="did you mean 'square'"):
        result["squar"]


def test_results_read_back_to_the_same_bits(result, tmp_path):
    result.write(tmp_path / "r.csv")
    rows = list(csv.reader((tmp_path / "r.csv").open()))
    assert rows[0] == ["a", "n", "square", "sum", "reason"]
    assert [float(rows[1][i]) for i in range(4)] == [*result.X[0], *result.Y[0]] and rows[2][2:] == ["", "", "a is negative"]
    endings = ["npz"]
    if pytest.importorskip("pyarrow"):
        endings.append("parquet")
    for ending in endings:
        result.write(tmp_path / f"r.{ending}")
        again, _ = read_table(tmp_path / f"r.{ending}")
        assert isinstance(again, StudyResult) and again.heading == result.heading and again.reasons == result.reasons
        assert np.array_equal(again.X, result.X) and np.array_equal(again.Y, result.Y, equal_nan=True)
    with pytest.raises(ValueError, match="expected a name that ends in"):
        result.write(tmp_path / "r.txt")


def test_pandas_and_xarray_know_names_and_units(result):
    xarray, pandas = pytest.importorskip("xarray"), pytest.importorskip("pandas")
    data, frame = result.to_xarray(), result.to_pandas()
    assert isinstance(data, xarray.Dataset) and data["square"].attrs["units"] == "m^2" and data["a"].values[2] == 2.0
    assert isinstance(frame, pandas.DataFrame) and list(frame["reason"]) == ["", "a is negative", ""]
    assert frame.attrs["units"]["square"] == "m^2"


def test_a_folder_without_a_study_is_told(tmp_path):
    with pytest.raises(FileNotFoundError, match="holds no study"):
        open_folder(tmp_path)
