#!/usr/bin/env python3
"""Writes docs/vehicles.md's table of where the numbers of the shipped vehicles come from, as their files say; fails with --check
where it is not up to date.

A number is a key whose value has digits; a vector or a curve counts once. Its grade is the first [P], [D] or [E] of its comment, or that of
the key that the comment names ("as length_m"); failing these the weakest of the comment lines directly above, which the keys below them
share, or that of the head of a file ("[E] All of it"). "from memory" beside an [E] is counted apart. What has none of
these has no source given.
Usage: tools/vehicle_sources.py [--check]
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/vehicles.md"
BEGIN, END = "<!-- written by tools/vehicle_sources.py -->\n", "<!-- end -->\n"
COLUMNS = ["published", "derived", "estimated", "from memory", "no source given"]
NAMES = {"P": "published", "D": "derived", "E": "estimated"}
KEY = re.compile(r'([\w.]+) *= *("(?:[^"\\]|\\.)*"|[^"#]*?(?:"[^"]*"[^"#]*?)*)\s*(#.*)?$')


def grade(comment, weakest=False):
    marks = re.findall(r"\[([PDE])\]", comment)
    if not marks:
        return None
    name = NAMES[max(marks, key="PDE".index) if weakest else marks[0]]
    return "from memory" if name == "estimated" and "from memory" in comment else name


def count(text):
    numbers = dict.fromkeys(COLUMNS, 0)
    known, above = {}, ""
    whole = re.search(r"^# (\[[PDE]\]) All of it", text, re.M)
    for line in text.splitlines():
        line = line.strip()
        if line.startswith("#"):
            above += line + " "
        match = KEY.match(line)
        if not match:
            above = above if line.startswith("#") else ""
            continue
        key, value, comment = match[1], re.sub(r'"[^"]*"', "", match[2]), match[3] or ""
        if not re.search(r"\d", value):
            continue
        other = re.match(r"# as (\w+)", comment)
        found = grade(comment) or (known.get(other[1]) if other else None) or grade(above, weakest=True)
        found = found or (grade(whole[1]) if whole else None) or "no source given"
        known[key] = found
        numbers[found] += 1
    return numbers


def table():
    rows = [f"| file | {' | '.join(COLUMNS)} |", f"| --- |{' --- |' * len(COLUMNS)}"]
    for file in sorted((ROOT / "vehicles").glob("*.toml")):
        numbers = count(file.read_text())
        rows.append(f"| `{file.name}` | {' | '.join(str(numbers[column]) for column in COLUMNS)} |")
    return "\n".join(rows) + "\n"


def main():
    page = PAGE.read_text()
    before, rest = page.split(BEGIN)
    wanted = before + BEGIN + "\n" + table() + "\n" + END + rest.split(END)[1]
    if sys.argv[1:] != ["--check"]:
        PAGE.write_text(wanted)
    elif page != wanted:
        print("docs/vehicles.md: its table is not what the vehicles' files say; run tools/vehicle_sources.py", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
