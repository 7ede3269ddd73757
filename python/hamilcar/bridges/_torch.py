"""PyTorch: the rollout as an autograd.Function in double precision on the CPU, with its adjoint; derivatives once."""

from __future__ import annotations

from typing import Any

from .._rollout import Rollout

try:
    import torch
except ImportError as error:
    raise ImportError("this bridge needs PyTorch: pip install 'hamilcar[torch]'") from error

_NAMES = ("controls", "parameters", "state", "held")


def bridge(rollout: Rollout) -> Any:
    """``f(controls, parameters=None, state=None, held=None) -> (y, end)`` of float64 tensors, with the shapes of the rollout's
    call: ``(t, m)`` or ``(n, t, m)`` and so on. Without a state the car starts as the parameters have it settle, and derivatives
    include that."""
    defaults = {"parameters": torch.from_numpy(rollout.parameters.copy()), "held": torch.from_numpy(rollout.held.copy())}

    def f(controls: Any, parameters: Any = None, state: Any = None, held: Any = None) -> tuple[Any, Any]:
        given = {"controls": controls, "parameters": parameters, "state": state, "held": held}
        tensors = {name: defaults.get(name) if value is None else value for name, value in given.items()}
        for name, tensor in tensors.items():
            if tensor is None and name == "state":
                continue
            if not isinstance(tensor, torch.Tensor) or tensor.dtype != torch.float64 or tensor.device.type != "cpu":
                found = f"{tensor.dtype} on {tensor.device}" if isinstance(tensor, torch.Tensor) else type(tensor).__name__
                raise TypeError(f"{name}: expected a float64 tensor on the CPU, found {found}")
        counts = {
            tensor.shape[0] for name, tensor in tensors.items() if tensor is not None and tensor.dim() == _dimensions(name)
        }
        for n in counts if len(counts) == 1 else ():  # what is shared is expanded here, so that PyTorch adds up its derivatives
            tensors = {name: _of_runs(tensor, n, _dimensions(name)) for name, tensor in tensors.items()}
        return _Run.apply(rollout, *tensors.values())

    return f


def _dimensions(name: str) -> int:
    return 3 if name == "controls" else 2


def _of_runs(tensor: Any, n: int, dimensions: int) -> Any:
    return tensor if tensor is None or tensor.dim() == dimensions else tensor.expand(n, *tensor.shape)


class _Run(torch.autograd.Function):
    @staticmethod
    def forward(rollout: Rollout, *tensors: Any) -> tuple[Any, Any]:
        y, end = rollout(*(None if tensor is None else tensor.detach().numpy() for tensor in tensors))
        return torch.from_numpy(y), torch.from_numpy(end)

    @staticmethod
    def setup_context(ctx: Any, inputs: tuple[Any, ...], output: Any) -> None:
        ctx.rollout, *tensors = inputs
        ctx.save_for_backward(*tensors)

    @staticmethod
    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, y_weights: Any, end_weights: Any) -> tuple[Any, ...]:
        arrays = [None if tensor is None else tensor.detach().numpy() for tensor in ctx.saved_tensors]
        gradient = ctx.rollout.gradient(*arrays, y_weights=y_weights.numpy(), end_weights=end_weights.numpy())
        return None, *(None if array is None else torch.from_numpy(gradient[name]) for name, array in zip(_NAMES, arrays))
