"""A Rollout inside programs that differentiate: JAX, PyTorch, CasADi. Each is imported when its bridge is made.

>>> from hamilcar import bridges
>>> f = bridges.jax(rollout)                 # f(controls, parameters, state, held) -> (y, end)
>>> f = bridges.torch(rollout)
>>> step = bridges.casadi(rollout)           # step(x, u_from, u_to, p) -> (x_next, y)
"""

from __future__ import annotations

from typing import Any

from .._rollout import Rollout

__all__ = ["casadi", "jax", "torch"]


def jax(rollout: Rollout) -> Any:
    """A function of JAX arrays, for ``jit``, ``grad``, ``vjp``, ``jacrev`` and ``vmap``; see ``_jax``."""
    from ._jax import bridge

    return bridge(rollout)


def torch(rollout: Rollout) -> Any:
    """A function of PyTorch tensors, for ``backward``; see ``_torch``."""
    from ._torch import bridge

    return bridge(rollout)


def casadi(rollout: Rollout, name: str = "car") -> Any:
    """One row of the rollout as a CasADi function with its Jacobian; see ``_casadi``."""
    from ._casadi import bridge

    return bridge(rollout, name)
