"""The whole picture of a sketch: its views on one page, and a legend below them."""

from suspension_sketches.elements import CHASSIS, COLORS, INK, JOINT, LINK_WIDTH, SOFT, page, text
from suspension_sketches.view import View


def legend(x, y, driven):
    out = []

    def entry(shape, words, room):
        nonlocal x
        out.append(shape)
        out.append(text((x + 14, y + 4), words, SOFT, 12, "start"))
        x += room

    entry(f'<circle cx="{x}" cy="{y}" r="{JOINT}" fill="{INK}"/>', "ball", 58)
    entry(f'<circle cx="{x}" cy="{y}" r="{JOINT}" fill="#ffffff" stroke="{INK}" stroke-width="1.8"/>', "hinge", 66)
    entry(f'<rect x="{x - 8}" y="{y - 8}" width="16" height="16" rx="4" fill="{CHASSIS}"/>', "on the chassis", 130)
    if driven:
        entry(f'<line x1="{x - 8}" y1="{y}" x2="{x + 8}" y2="{y}" stroke="{COLORS["driven"]}" '
              f'stroke-width="{LINK_WIDTH}"/>', "moved by the rack", 0)
    return out


def picture(sketch):
    """Views side by side; a third one stands below the first."""
    views = [View(sketch, kind) for kind in sketch.views]
    gap, top, bottom = 14, 30, 34  # [px]
    widths, heights = [v.box[2] - v.box[0] for v in views], [v.box[3] - v.box[1] for v in views]
    width, row = sum(widths[:2]) + 3 * gap, max(heights[:2])
    height = row + top + bottom + (heights[2] + gap if len(views) > 2 else 0)
    level = all(view.kind in ("front", "side") for view in views[:2])  # on the same ground
    places = [(gap, top + (row - heights[0] if level else (row - heights[0]) / 2)),
              (2 * gap + widths[0], top + (row - heights[1] if level else (row - heights[1]) / 2)),
              (gap + views[-1].box[0] - views[0].box[0], top + row + gap)]
    out = []
    for view, place in zip(views, places):
        out += view.svg(*place)
    driven = any(part[0] == "bar" and part[4] == COLORS["driven"] for part in sketch.parts)
    return page(sketch.name, width, height, out + legend(26, height - 18, driven))
