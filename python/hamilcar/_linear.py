"""Linear models about operating points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import _core
from ._documents import Source, Vehicle, as_vehicle


@dataclass(frozen=True)
class Mode:
    """Of a conjugate pair the one with positive imaginary part; ``frequency`` [Hz] is 0 of one that does not oscillate."""

    name: str
    eigenvalue: complex  # [1/s]
    frequency: float
    damping_ratio: float


class LinearModel:
    """``z' = A dz + B du, y = C dz + D du`` about steady driving, exact: by dual numbers through the whole model.

    ``states``, ``inputs`` and ``outputs`` name rows and columns; z is without position, heading and dependent coordinates, in SI
    units and radians. ``rack`` [m] and ``drive_torque`` [N m] are what the operating point takes, ``state`` and ``output`` are z and y there.
    The inputs "rack" and "rack_rate" are the rack's displacement and velocity: what turns the steering moves both.
    """

    def __init__(self, linear: _core.Linear):
        self.A: np.ndarray = linear.A()
        self.B: np.ndarray = linear.B()
        self.C: np.ndarray = linear.C()
        self.D: np.ndarray = linear.D()
        self.state: np.ndarray = linear.state()
        self.output: np.ndarray = linear.output()
        self.states: list[str] = linear.states
        named = [text.removesuffix("]").split(" [") for text in linear.inputs]
        self.inputs: list[str] = [name.replace(" ", "_") for name, _ in named]
        self.input_units: list[str] = [unit for _, unit in named]
        self.outputs: list[str] = linear.outputs
        self.output_units: list[str] = linear.output_units
        self.rack: float = linear.rack
        self.drive_torque: float = linear.drive_torque
        self.residual: float = linear.residual
        self.modes = [Mode(name, complex(re, im), f, d) for name, re, im, f, d in linear.modes]

    def discrete(self, step: float) -> tuple[np.ndarray, np.ndarray]:
        """A and B of ``z(t + step) = A z(t) + B u`` for inputs that stay constant in between [s]."""
        if not step > 0:
            raise ValueError(f"step = {step}: expected a positive time [s]")
        n, m = self.B.shape
        both = np.zeros((n + m, n + m))
        both[:n, :n], both[:n, n:] = self.A * step, self.B * step
        whole = _exponential(both)
        return whole[:n, :n], whole[:n, n:]

    def response(self, output: str, input: str, frequencies: np.ndarray) -> np.ndarray:
        """Complex, at frequencies [Hz], per unit of the input; of the rack with its velocity."""
        row, column = _place(output, self.outputs, "output"), _place(input, self.inputs, "input")
        out = []
        for w in 2j * np.pi * np.atleast_1d(np.asarray(frequencies, dtype=float)):
            u = np.zeros(len(self.inputs), dtype=complex)
            u[column] = 1
            if self.inputs[column] == self.inputs[0]:
                u[1] = w
            z = np.linalg.solve(w * np.eye(len(self.A)) - self.A, self.B @ u)
            out.append(self.C[row] @ z + self.D[row] @ u)
        return np.array(out)

    def __repr__(self) -> str:
        return f"<hamilcar.LinearModel: {len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs>"


def _place(name: str, names: list[str], what: str) -> int:
    if name in names:
        return names.index(name)
    raise KeyError(f"there is no {what} {name!r}: expected one of {', '.join(names)}")


def _exponential(m: np.ndarray) -> np.ndarray:
    """By its series where the matrix is small, squared back."""
    halvings = max(0, int(np.ceil(np.log2(max(np.abs(m).sum(axis=1).max(), 1e-300)))) + 4)
    small = m / 2.0**halvings
    term = out = np.eye(len(m))
    for k in range(1, 12):
        term = term @ small / k
        out = out + term
    for _ in range(halvings):
        out = out @ out
    return out


def linearize(
    vehicle: Vehicle | Source = "bmw_323i", speed: float = 0.0, lateral_acceleration: float = 0.0
) -> LinearModel:
    """The vehicle standing on the flat, driving straight at ``speed`` [m/s], or round with ``lateral_acceleration`` to the left
    [m/s^2]. Raises NumericalError where there is no such state."""
    return LinearModel(_core.linearize(as_vehicle(vehicle)._core, speed, lateral_acceleration))
