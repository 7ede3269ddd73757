"""Figures of a study: numbers by their names, reductions of channels, functions of one's own."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from importlib import import_module
from typing import Any, Union

import numpy as np

REDUCTIONS: dict[str, Callable[[np.ndarray], float]] = {
    "min": np.min,
    "max": np.max,
    "mean": np.mean,
    "rms": lambda values: np.sqrt(np.mean(np.square(values))),
    "last": lambda values: values[-1],
    "peak-to-peak": np.ptp,
}

Wanted = Union[str, Callable[[Any], float]]


@dataclass(frozen=True)
class FigureColumn:
    """A column of ``Y``: what is wanted, under which name, in which unit."""

    name: str
    unit: str
    wanted: Wanted  # a figure's name, "max chassis.speed", or a function

    def to_dict(self) -> dict[str, str]:
        return {"name": self.name, "unit": self.unit, "wanted": reference_to(self.wanted)}


def reference_to(wanted: Wanted) -> str:
    """A text from which another process finds it: a name, or "python MODULE:FUNCTION" of a function that can be imported."""
    if isinstance(wanted, str):
        return wanted
    module, name = getattr(wanted, "__module__", None), getattr(wanted, "__qualname__", None)
    if module in (None, "__main__") or name is None or getattr(sys.modules.get(module), name, None) is not wanted:
        raise TypeError(
            f"{name or wanted!r}: another process cannot import this function; put it at the top level of a module,"
            " or use evaluate, which stays in this process"
        )
    return f"python {module}:{name}"


def wanted_from(text: str) -> Wanted:
    if not text.startswith("python "):
        return text
    module, name = text[len("python ") :].split(":")
    function: Callable[[Any], float] = getattr(import_module(module), name)
    return function


def split_reduction(text: str) -> tuple[str, str]:
    """ "max chassis.speed" as the reduction and the channel."""
    word, _, channel = text.partition(" ")
    if word not in REDUCTIONS or not channel:
        near = get_close_matches(word, list(REDUCTIONS), 1)
        hint = f"; did you mean {near[0]!r}?" if near and channel else ""
        raise ValueError(
            f"figure {text!r}: expected a reduction and a channel, such as 'max chassis.speed'; reductions are"
            f" {', '.join(REDUCTIONS)}{hint}"
        )
    return word, channel


def reduction_columns(figures: list[Wanted], channels: Mapping[str, tuple[str, str]]) -> list[FigureColumn]:
    """Reductions of channels and functions as columns; ``channels``: unit and meaning of each."""
    out = []
    for wanted in figures:
        if callable(wanted):
            out.append(FigureColumn(_name_of(wanted), "", wanted))
            continue
        _, channel = split_reduction(wanted)
        if channel not in channels:
            near = get_close_matches(channel, list(channels), 1)
            raise KeyError(f"{channel!r} is no channel of this car" + (f"; did you mean {near[0]!r}?" if near else ""))
        out.append(FigureColumn(wanted, channels[channel][0], wanted))
    return out


def outcome_columns(figures: list[Wanted], found: Mapping[str, Any], failed: str | None) -> list[FigureColumn]:
    """Figures of a maneuver's outcome and functions of it as columns; none named: all that it has."""
    out = []
    for wanted in figures or list(found):
        if callable(wanted):
            out.append(FigureColumn(_name_of(wanted), "", wanted))
            continue
        if wanted not in found:
            near = get_close_matches(wanted, list(found), 1)
            hint = f"; did you mean {near[0]!r}?" if near else f": expected one of {', '.join(found)}"
            why = f" ({failed})" if failed else ""
            raise KeyError(f"in the middle of the ranges the maneuver has no figure {wanted!r}{hint}{why}")
        out.append(FigureColumn(wanted, found[wanted].unit, wanted))
    if not out:
        raise ValueError(f"in the middle of the ranges the maneuver has no figures: {failed or 'none was found'}")
    return out


def check_figures(figures: Any) -> list[Wanted]:
    if isinstance(figures, (str, Mapping)) or callable(figures):
        raise TypeError("figures: expected a list; only those of a function come with units")
    out = list(figures)
    for one in out:
        if not isinstance(one, str) and not callable(one):
            raise TypeError(f"figures: expected names and functions, not {one!r}")
    names = [one if isinstance(one, str) else _name_of(one) for one in out]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"figure {name!r} is wanted twice")
    return out


def _name_of(function: Callable[..., Any]) -> str:
    return getattr(function, "__name__", type(function).__name__)
