"""The example with a measured car, as far as the run tells something by another route."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("scipy")
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "python" / "identify_m8.py"


@pytest.mark.skipif(not EXAMPLE.is_file(), reason="the examples are not here")
def test_the_rolling_radius_is_that_of_the_measured_speeds():
    spec = importlib.util.spec_from_file_location("identify_m8", EXAMPLE)
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    found = example.identify(example.car(), example.unknowns(), [example.measurement(7.15)], step=2e-3)
    fast = np.genfromtxt(example.DATA / "fast.csv", delimiter=",", skip_header=1)
    coasting = fast[(fast[:, 0] > 5.2) & (fast[:, 0] < 6.6)]  # front wheels roll freely: neither drive nor brake
    expected = np.median(coasting[:, 4] / coasting[:, 7:9].mean(axis=1))
    assert found.values["tire.front.rolling_radius_m"] == pytest.approx(expected, rel=0.01)
    assert found.warnings  # one run in a straight line: the report says what it does not tell
