"""A vehicle as a drawing of lines: from the side and from above."""

from __future__ import annotations

from html import escape
from typing import Any

_COLORS = {"spring": "#c96", "damper": "#69c", "strut": "#69c", "rod": "#555", "hinge": "#999", "body": "#aaa"}


def svg_of_scene(scene: dict[str, Any], width: int = 640) -> str:
    """Side view above, top view below, to one scale; x to the left, as a car that drives to the left."""
    links = [(link["kind"], link["a"]["point"], link["b"]["point"], link["name"]) for link in scene["links"]]
    wheels = scene["wheels"]
    bodies = scene["bodies"]
    points = [p for _, a, b, _ in links for p in (a, b)]
    for wheel in wheels:
        x, y, z = wheel["center"]
        r = wheel["radius"]
        points += [[x - r, y, z - r], [x + r, y, z + r]]
    for body in bodies:
        points += [body["low"], body["high"]]
    if not points:
        return ""
    low = [min(p[i] for p in points) for i in range(3)]
    high = [max(p[i] for p in points) for i in range(3)]
    scale = width / (high[0] - low[0] + 0.2)
    side = scale * (high[2] - low[2] + 0.1)
    top = scale * (high[1] - low[1] + 0.1)

    def at_side(p: list[float]) -> tuple[float, float]:
        return scale * (high[0] - p[0] + 0.1), scale * (high[2] - p[2] + 0.05)

    def at_top(p: list[float]) -> tuple[float, float]:
        return scale * (high[0] - p[0] + 0.1), side + scale * (high[1] - p[1] + 0.05)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{side + top:.0f}" fill="none">']
    for view in (at_side, at_top):
        for body in bodies:
            (x0, y0), (x1, y1) = view(body["high"]), view(body["low"])
            out.append(f'<rect x="{x0:.1f}" y="{y0:.1f}" width="{x1 - x0:.1f}" height="{y1 - y0:.1f}" stroke="#ccc"/>')
        for kind, a, b, name in links:
            (x0, y0), (x1, y1) = view(a), view(b)
            color = _COLORS.get(kind, "#555")
            out.append(
                f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" stroke="{color}" stroke-width="1.5">'
                f"<title>{escape(name)}</title></line>"
            )
    for wheel in wheels:
        x, y = at_side(wheel["center"])
        radius = scale * wheel["radius"]
        out.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" stroke="#333"/>')
        for offset in wheel["tires"]:
            middle = [c + offset * a for c, a in zip(wheel["center"], wheel["axis"])]
            x, y = at_top(middle)
            half = scale * wheel["width"] / 2
            out.append(
                f'<rect x="{x - radius:.1f}" y="{y - half:.1f}" width="{2 * radius:.1f}" height="{2 * half:.1f}" stroke="#333"/>'
            )
    out.append("</svg>")
    return "".join(out)
