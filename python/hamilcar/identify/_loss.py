"""Losses of residuals, as scipy.optimize.least_squares defines them: rho of z = (residual / scale)^2, and two derivatives."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

Rho = tuple[np.ndarray, np.ndarray, np.ndarray]


def _linear(z: np.ndarray) -> Rho:
    return z, np.ones_like(z), np.zeros_like(z)


def _soft_l1(z: np.ndarray) -> Rho:
    return 2 * (np.sqrt(1 + z) - 1), (1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5


def _huber(z: np.ndarray) -> Rho:
    root = np.sqrt(np.maximum(z, 1.0))
    return np.where(z <= 1, z, 2 * root - 1), 1 / root, np.where(z <= 1, 0.0, -0.5 / root**3)


def _cauchy(z: np.ndarray) -> Rho:
    return np.log1p(z), 1 / (1 + z), -1 / (1 + z) ** 2


LOSSES: dict[str, Callable[[np.ndarray], Rho]] = {
    "linear": _linear, "soft_l1": _soft_l1, "huber": _huber, "cauchy": _cauchy,
}


def loss_of(name: str, count: int) -> Callable[[np.ndarray], np.ndarray]:
    """What least_squares takes: this loss of the first ``count`` residuals, the square of the others, which are priors."""

    def rho(z: np.ndarray) -> np.ndarray:
        out = np.array(_linear(z))
        out[:, :count] = LOSSES[name](z[:count])
        return out

    return rho


def variance_of(name: str, scale: float, residuals: np.ndarray, unknowns: int) -> float:
    """The factor of ``inv(J^T J)`` in the covariance of an M-estimate (Huber, Robust Statistics, 7.6): the mean of psi^2 over the
    squared mean of psi', with the degrees of freedom in the place of the count. Of squares it is the reduced chi-square."""
    z = (residuals / scale) ** 2
    _, first, second = LOSSES[name](z)
    psi, slope = residuals * first, first + 2 * z * second
    return float(psi @ psi / max(residuals.size - unknowns, 1) / np.mean(slope) ** 2)
