#!/usr/bin/env python3
"""Fails where docs/theory/equations.md is stale: a file that is gone, a name no longer in it, an equation left out.

A row of the index is `| equation | what | code | test |`; code and test are `path` or `path: name`, several split by <br>.
"""

import pathlib
import re
import sys

EQUATIONS = [str(n) for n in range(1, 72)]
APPENDIX = ["A.1", "A.2", "A.3", "A.4", "A.5"]
OBJECTS = ["Table 2", "Table 3", "Fig. 9", "Fig. 10", "Fig. 11", "Fig. 12", "Fig. 13", "Fig. 14"]


def expand(cell):
    """'(9)-(11), A.2' -> {'9', '10', '11', 'A.2'}"""
    covered = set()
    for part in cell.split(","):
        part = part.strip()
        span = re.fullmatch(r"\((\d+)\)(?:-\((\d+)\))?", part)
        if span:
            first, last = int(span[1]), int(span[2] or span[1])
            covered.update(str(n) for n in range(first, last + 1))
        elif part:
            covered.add(part)
    return covered


def check_reference(root, reference):
    path, _, name = (word.strip() for word in reference.replace("`", "").partition(": "))
    file = root / path
    if not file.is_file():
        return f"{path}: no such file"
    if name and name not in file.read_text():
        return f"{path}: no '{name}' in it"
    return None


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    index = root / "docs/theory/equations.md"
    problems, covered = [], set()
    for number, line in enumerate(index.read_text().splitlines(), 1):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.startswith("|") or len(cells) != 4 or cells[0] in ("equation", "---"):
            continue
        covered |= expand(cells[0])
        for cell in cells[2:]:
            for reference in cell.split("<br>"):
                problem = check_reference(root, reference)
                if problem:
                    problems.append(f"{index.relative_to(root)}:{number}: {problem}")
    missing = [e for e in EQUATIONS + APPENDIX + OBJECTS if e not in covered]
    if missing:
        problems.append(f"{index.relative_to(root)}: not in the index: {', '.join(missing)}")
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
