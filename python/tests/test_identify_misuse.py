"""What identify refuses, and with which message."""

import numpy as np
import pytest

from hamilcar.identify import Free, Measurement, Unknown, identify

pytest.importorskip("scipy")


def test_mistakes_are_refused_with_what_was_expected():
    t = 0.02 * np.arange(1, 61)
    run = Measurement(t, {}, {"chassis.yaw_rate": np.zeros(60)}, 0.1, speed=20.0)
    mass = Unknown("chassis.mass_kg", 900.0, 1300.0)
    with pytest.raises(ValueError, match="min = 3"):
        Unknown("chassis.mass_kg", 3.0, 2.0)
    with pytest.raises(ValueError, match="nominal = 5"):
        Unknown("chassis.mass_kg", 900.0, 1300.0, nominal=5.0)
    with pytest.raises(TypeError, match="multiplies"):
        Unknown("factor", 0.5, 2.0, multiplies="chassis.mass_kg")
    with pytest.raises(ValueError, match="expected each parameter once"):
        identify("bmw_323i", [mass, Unknown("factor", 0.5, 2.0, multiplies=["chassis.mass_kg"])], [run])
    with pytest.raises(ValueError, match="expected 1200 to 1300, or give a nominal"):
        identify("bmw_323i", [Unknown("chassis.mass_kg", 1200.0, 1300.0)], [run])
    with pytest.raises(ValueError, match="run 1: expected each run once"):
        identify("bmw_323i", [mass], [run, Measurement(t, {}, {"chassis.yaw_rate": np.zeros(60)}, 0.1, name="run 1")])
    with pytest.raises(ValueError, match="bias: expected the same range"):
        biases = [Free(-one, one, name="bias") for one in (1.0, 2.0)]
        identify("bmw_323i", [mass], [Measurement(t, {}, {"chassis.yaw_rate": np.zeros(60)}, 0.1, bias=b) for b in biases])
    with pytest.raises(ValueError, match="did you mean 'soft_l1'"):
        identify("bmw_323i", [mass], [run], loss="soft_l2")
    with pytest.raises(KeyError, match="did you mean 'chassis.yaw_rate'"):
        identify("bmw_323i", [mass], [Measurement(t, {}, {"chassis.yaw_rat": np.zeros(60)}, 0.1)])
    with pytest.raises(KeyError, match="did you mean 'steering_wheel'"):
        identify("bmw_323i", [mass], [Measurement(t, {"steering_whel": 0.0}, {"chassis.yaw_rate": np.zeros(60)}, 0.1)])
    with pytest.raises(ValueError, match=r"expected \(60,\)"):
        Measurement(t, {}, {"chassis.yaw_rate": np.zeros(59)}, 0.1)
    with pytest.raises(ValueError, match="sd of chassis.speed"):
        Measurement(t, {}, {"chassis.speed": np.zeros(60)}, {"chassis.yaw_rate": 0.1})
    with pytest.raises(ValueError, match="increasing"):
        Measurement(t[::-1], {}, {"chassis.yaw_rate": np.zeros(60)}, 0.1)
    with pytest.raises(ValueError, match="more samples than unknowns"):
        few = {"chassis.yaw_rate": np.where(t < 0.03, 0.0, np.nan)}
        identify("bmw_323i", [mass], [Measurement(t, {}, few, 0.1, bias=Free(-1.0, 1.0))], step=4e-3)
