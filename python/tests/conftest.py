import numpy as np
import pytest

import hamilcar


@pytest.fixture
def car():
    return hamilcar.Vehicle("bmw_323i")


@pytest.fixture
def random():
    return np.random.default_rng(1)
