"""JAX: the rollout by a callback to the host, its adjoint as the rule of differentiation.

Reverse mode alone: ``grad``, ``vjp`` and ``jacrev``, once; not ``jvp``, ``jacfwd`` or ``hessian``. ``vmap`` becomes the runs
``(n, ...)`` of one call, side by side in the lanes of the processor.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .._rollout import Rollout

try:
    import jax
    import jax.numpy as jnp
except ImportError as error:
    raise ImportError("this bridge needs JAX: pip install 'hamilcar[jax]'") from error

_NAMES = ("controls", "parameters", "state", "held")


def bridge(rollout: Rollout) -> Any:
    """``f(controls, parameters=None, state=None, held=None) -> (y, end)`` with the shapes of the rollout's call: ``(t, m)`` or
    ``(n, t, m)`` and so on. Without a state the car starts as the parameters have it settle, and derivatives include that."""
    _check_precision()
    with_state, without_state = _differentiable(rollout, True), _differentiable(rollout, False)
    defaults = {"parameters": rollout.parameters, "held": rollout.held}
    widths = {"parameters": rollout.parameters.size, "state": len(rollout.state_names), "held": rollout.held.size}
    m = widths["held"]

    def f(controls: Any, parameters: Any = None, state: Any = None, held: Any = None) -> tuple[Any, Any]:
        _check_precision()
        given = {"controls": controls, "parameters": parameters, "state": state, "held": held}
        arrays = {
            name: jnp.asarray(defaults[name] if value is None else value, dtype=jnp.float64)
            for name, value in given.items()
            if not (name == "state" and value is None)
        }
        rows = arrays["controls"]
        if rows.ndim not in (2, 3) or rows.shape[-1] != m or rows.shape[-2] < 1:
            raise ValueError(f"controls of shape {rows.shape}: expected (t, {m}) or (n, t, {m}), columns {rollout.control_names}")
        for name, width in widths.items():
            if name in arrays and (arrays[name].ndim not in (1, 2) or arrays[name].shape[-1] != width):
                raise ValueError(f"{name} of shape {arrays[name].shape}: expected ({width},) or (n, {width})")
        counts = {rows.shape[0]} if rows.ndim == 3 else set()
        counts |= {array.shape[0] for name, array in arrays.items() if name != "controls" and array.ndim == 2}
        if len(counts) > 1:
            raise ValueError(f"expected one number of runs, found {sorted(counts)}")
        for n in counts:  # what is shared is broadcast here, so that JAX adds up its derivatives
            arrays = {name: _of_runs(array, n, 3 if name == "controls" else 2) for name, array in arrays.items()}
        return (without_state if state is None else with_state)(*arrays.values())

    return f


def _check_precision() -> None:
    if not jax.config.jax_enable_x64:
        raise RuntimeError(
            "JAX computes in single precision: expected jax.config.update('jax_enable_x64', True) before the bridge is made"
        )


def _of_runs(array: Any, n: int, dimensions: int) -> Any:
    return array if array.ndim == dimensions else jnp.broadcast_to(array, (n, *array.shape))


def _differentiable(rollout: Rollout, has_state: bool) -> Any:
    names = _NAMES if has_state else tuple(name for name in _NAMES if name != "state")

    def run(*arrays: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        flat, lead = _flattened(names, arrays)
        y, end = rollout(**flat)
        return y.reshape(*lead, *y.shape[1:]), end.reshape(*lead, *end.shape[1:])

    def run_back(*arrays: np.ndarray) -> tuple[np.ndarray, ...]:
        *own, y_weights, end_weights = arrays
        flat, lead = _flattened((*names, "y_weights", "end_weights"), [*own, y_weights, end_weights])
        gradient = rollout.gradient(**flat)
        return tuple(gradient[name].reshape(*lead, *gradient[name].shape[1:]) for name in names)

    def shape(*of: int) -> Any:
        return jax.ShapeDtypeStruct(of, jnp.float64)

    @jax.custom_vjp
    def call(*arrays: Any) -> tuple[Any, Any]:
        rows = arrays[0]
        out = (
            shape(*rows.shape[:-1], len(rollout.record)),
            shape(*rows.shape[:-2], len(rollout.state_names)),
        )
        return jax.pure_callback(run, out, *arrays, vmap_method="broadcast_all")

    def forward(*arrays: Any) -> tuple[Any, Any]:
        return call(*arrays), arrays

    def backward(arrays: Any, weights: Any) -> Any:
        out = tuple(shape(*array.shape) for array in arrays)
        return jax.pure_callback(run_back, out, *arrays, *weights, vmap_method="broadcast_all")

    call.defvjp(forward, backward)
    return call


def _flattened(names: tuple[str, ...], arrays: Any) -> tuple[dict[str, np.ndarray], tuple[int, ...]]:
    """All leading axes as one, and what they were."""
    of = {name: np.asarray(array) for name, array in zip(names, arrays)}
    lead = of["controls"].shape[:-2]
    n = int(np.prod(lead))
    keep = {"controls": 2, "y_weights": 2}
    return {name: array.reshape(n, *array.shape[array.ndim - keep.get(name, 1) :]) for name, array in of.items()}, lead
