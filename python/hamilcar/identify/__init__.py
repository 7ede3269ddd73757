"""Parameters of a vehicle from measured runs: least squares with the exact Jacobian of a Rollout.

>>> from hamilcar.identify import Measurement, Unknown, identify
>>> run = Measurement(time, {"steering_wheel": angle}, {"chassis.yaw_rate": rate}, sd=0.2, speed=20.0)
>>> found = identify("bmw_323i", [Unknown("chassis.mass_kg", 900.0, 1500.0)], [run])
>>> print(found.text())

The model of a measured column is ``gain * simulated(t - delay) + bias``. A residual is the model minus the measured value, divided
by the standard deviation of the channel's noise.
"""

from ._fit import identify
from ._measurement import Free, Measurement, Unknown
from ._result import Direction, Fit, Identification

__all__ = ["Direction", "Fit", "Free", "Identification", "Measurement", "Unknown", "identify"]
