"""CasADi: one row of a rollout as a Callback with its Jacobian.

    (x, u_from, u_to, p) ─► (x_next, y)

x is the state at the row's start, u_from and u_to are where the controls are there and at its end, p the parameters; y are the
recorded channels at the row's end. The start does not depend on p here, as x is given.

A Callback calls Python back: it cannot be pickled, written to C or mapped over threads, and has no second derivatives: IPOPT takes
``hessian_approximation="limited-memory"``. CasADi holds no reference to it: keep the function that the bridge gives for as long
as expressions of it are used.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .._rollout import Rollout

try:
    import casadi as ca
except ImportError as error:
    raise ImportError("this bridge needs CasADi: pip install 'hamilcar[casadi]'") from error

_INPUTS = ("x", "u_from", "u_to", "p")
_OUTPUTS = ("x_next", "y")
_WRT = {"x": "state", "u_from": "held", "u_to": "controls", "p": "parameters"}


def bridge(rollout: Rollout, name: str) -> Any:
    return _Row(rollout, name)


class _Of(ca.Callback):
    """What the function and its Jacobian share: sizes and names."""

    def __init__(self, rollout: Rollout):
        ca.Callback.__init__(self)
        self.rollout = rollout
        m = len(rollout.control_names)
        self.sizes = {
            "x": len(rollout.state_names), "u_from": m, "u_to": m, "p": len(rollout.parameter_names),
            "x_next": len(rollout.state_names), "y": len(rollout.record),
        }

    def arguments(self, values: Any) -> dict[str, np.ndarray]:
        x, u_from, u_to, p = (np.array(value, dtype=np.float64).reshape(-1) for value in values[:4])
        return {"controls": u_to[None], "parameters": p, "state": x, "held": u_from}


class _Row(_Of):
    def __init__(self, rollout: Rollout, name: str):
        _Of.__init__(self, rollout)
        self._jacobians: list[_Jacobian] = []  # which CasADi holds no reference to
        self.construct(name, {})

    def get_n_in(self) -> int:
        return len(_INPUTS)

    def get_n_out(self) -> int:
        return len(_OUTPUTS)

    def get_name_in(self, i: int) -> str:
        return _INPUTS[i]

    def get_name_out(self, i: int) -> str:
        return _OUTPUTS[i]

    def get_sparsity_in(self, i: int) -> Any:
        return ca.Sparsity.dense(self.sizes[_INPUTS[i]], 1)

    def get_sparsity_out(self, i: int) -> Any:
        return ca.Sparsity.dense(self.sizes[_OUTPUTS[i]], 1)

    def eval(self, values: Any) -> Any:
        y, end = self.rollout(**self.arguments(values))
        return [end, y[0]]

    def has_jacobian(self) -> bool:
        return True

    def get_jacobian(self, name: str, names_in: Any, names_out: Any, options: Any) -> Any:
        self._jacobians.append(_Jacobian(self.rollout, name, list(names_in), list(names_out), dict(options)))
        return self._jacobians[-1]


class _Jacobian(_Of):
    """Blocks of every output by every input; inputs are those of the function and its outputs, which are not needed."""

    def __init__(self, rollout: Rollout, name: str, names_in: list[str], names_out: list[str], options: dict[str, Any]):
        _Of.__init__(self, rollout)
        self._names = names_in, names_out
        self._blocks = [(out, by) for out in _OUTPUTS for by in _INPUTS]
        self.construct(name, options)

    def get_n_in(self) -> int:
        return len(self._names[0])

    def get_n_out(self) -> int:
        return len(self._names[1])

    def get_name_in(self, i: int) -> str:
        return self._names[0][i]

    def get_name_out(self, i: int) -> str:
        return self._names[1][i]

    def get_sparsity_in(self, i: int) -> Any:
        if i < len(_INPUTS):
            return ca.Sparsity.dense(self.sizes[_INPUTS[i]], 1)
        return ca.Sparsity(self.sizes[_OUTPUTS[i - len(_INPUTS)]], 1)

    def get_sparsity_out(self, i: int) -> Any:
        out, by = self._blocks[i]
        return ca.Sparsity.dense(self.sizes[out], self.sizes[by])

    def eval(self, values: Any) -> Any:
        arguments = self.arguments(values)
        found = {}
        for by in _INPUTS:
            if self.sizes[by]:
                dy, dend = self.rollout.jacobian(**arguments, wrt=_WRT[by])
                found["x_next", by], found["y", by] = dend, dy[0]
        empty = {(out, by): np.zeros((self.sizes[out], self.sizes[by])) for out, by in self._blocks}
        return [ca.DM({**empty, **found}[block]) for block in self._blocks]
