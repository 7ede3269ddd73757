#!/usr/bin/env python3
"""Draws docs/suspensions/pictures/*.svg from hardpoints; --check fails where a picture is not what it would draw.

Hardpoints are those of a shipped vehicle, or of the example on the suspension's own page where no vehicle has that
kind. A sketch is a list of parts in space; each of its views projects them, and labels look for a free place by
themselves. A new suspension is a function in suspension_sketches/ and its name in SKETCHES; so is its picture named.
"""

import sys

from suspension_sketches.axles import four_link_axle, leaf_axle, panhard_axle, twist_beam, watt_axle
from suspension_sketches.hardpoints import PAGES, ROOT
from suspension_sketches.independent import (double_wishbone, five_link, h_arm, integral_link, linkage, macpherson, semi_trailing_arm,
                                             swing_axle, trailing_arm)
from suspension_sketches.picture import picture
from suspension_sketches.trailers import trailers

SKETCHES = [macpherson, double_wishbone, five_link, semi_trailing_arm, trailing_arm, swing_axle, h_arm, integral_link, twist_beam,
            four_link_axle, panhard_axle, watt_axle, leaf_axle, linkage]


def main():
    stale = []
    for make in [*SKETCHES, trailers]:
        svg = trailers() if make is trailers else picture(make())
        file = PAGES / "pictures" / f"{make.__name__}.svg"
        if "--check" in sys.argv[1:]:
            if not file.is_file() or file.read_text() != svg:
                stale.append(file.relative_to(ROOT))
        else:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(svg)
    for file in stale:
        print(f"{file}: stale; run tools/draw_suspensions.py", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
