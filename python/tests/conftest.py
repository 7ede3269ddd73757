import numpy as np
import pytest

import hamilcar


@pytest.fixture
def car():
    return hamilcar.Vehicle("bmw_323i")


@pytest.fixture
def random():
    return np.random.default_rng(1)


@pytest.fixture
def driven(car):
    """A scenario whose driver has all controls."""
    return {
        "name": "driven", "vehicle": car.source, "duration_s": 9.0, "initial": {"velocity_m_per_s": 10.0},
        "driver": {
            "path": {"x_m": [0.0, 30.0, 60.0, 200.0], "y_m": [0.0, 0.0, 3.0, 3.0]},
            "speed": {"speed_m_per_s": 12.0}, "gear": {},
        },
    }
