#!/usr/bin/env python3
"""Fails on an include that climbs: a room may include rooms of lower layers and of its own layer only if named so.

Also on a file or a function that has grown past its size (350 lines a file, 70 lines a function).
"""

import pathlib
import re
import sys

# Lowest first; rooms of one row do not include each other.
LAYERS = [
    ["base"],
    ["description", "program"],
    ["scalar"],
    ["math"],
    ["linkage", "road", "integrator"],
    ["force"],
    ["tire", "driveline", "suspension", "steering"],
    ["vehicle"],
    ["block"],
    ["driver", "analysis", "control"],
    ["engine"],
    ["io"],
    ["run", "template"],
    ["batch", "maneuver"],
    ["live", "study"],
    ["bench"],
]
LEVEL = {room: level for level, rooms in enumerate(LAYERS) for room in rooms}
INCLUDE = re.compile(r'^#include "hamilcar/([^/"]+)/')
FUNCTION_END = re.compile(r"^( {0,4})\}")
MAX_FILE, MAX_FUNCTION = 350, 70


def climbing_includes(root):
    for path in sorted((root / "hamilcar").rglob("*.[hc]pp")):
        room = path.relative_to(root / "hamilcar").parts[0]
        if room not in LEVEL:
            yield f"{path.relative_to(root)}: room '{room}' has no layer in tools/check_layers.py"
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match or match[1] == room:
                continue
            other = match[1]
            if other not in LEVEL or LEVEL[other] >= LEVEL[room]:
                yield f"{path.relative_to(root)}:{number}: '{room}' may not include '{other}'"


def oversized(root):
    for folder in ("hamilcar", "cli", "python", "tests", "benchmarks"):
        for path in sorted((root / folder).rglob("*.[hc]pp")):
            lines = path.read_text().splitlines()
            if len(lines) > MAX_FILE:
                yield f"{path.relative_to(root)}: {len(lines)} lines; a file has at most {MAX_FILE}"
            start = None
            for number, line in enumerate(lines, 1):
                opens = re.match(r"^( {0,4})[^\s#/].*\)( const| override| noexcept)* \{$", line)
                if opens and start is None:
                    start = (number, opens[1])
                end = FUNCTION_END.match(line)
                if end and start and end[1] == start[1]:
                    if number - start[0] >= MAX_FUNCTION:
                        yield f"{path.relative_to(root)}:{start[0]}: a function of {number - start[0] + 1} lines"
                    start = None


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    problems = [*climbing_includes(root), *oversized(root)]
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
