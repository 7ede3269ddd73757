#!/usr/bin/env python3
"""Fails on a class or an inline function of one qualified name that two files define: the linker would merge them in silence.

Reads clang-formatted sources, where a namespace's contents are not indented; anonymous namespaces are left out.
"""

import collections
import pathlib
import re
import sys

NAMESPACE = re.compile(r"^(?:inline )?namespace ?([\w:]*) ?\{$")
NAMESPACE_END = re.compile(r"^\}  // namespace")
CLASS = re.compile(r"^(?:template <.*> )?(?:struct|class|union|enum class|enum) (\w+)(?: final)?(?: : [^;()]*)? \{")
FUNCTION = re.compile(r"^inline [^=]*?(\w+)(\([^{;]*\)) (?:const )?(?:noexcept )?\{")


def definitions(path):
    """Yields (qualified name, line) of what a file defines at the level of its namespaces."""
    spaces = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if opened := NAMESPACE.match(line):
            spaces.append(opened[1])
        elif NAMESPACE_END.match(line):
            spaces.pop()
        elif "" not in spaces:
            inside = "::".join(spaces)
            if found := CLASS.match(line):
                yield f"{inside}::{found[1]}", number
            elif found := FUNCTION.match(line):
                yield f"{inside}::{found[1]}{found[2]}", number


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    places = collections.defaultdict(list)
    for folder in ("hamilcar", "cli"):
        for path in sorted((root / folder).rglob("*.[hc]pp")):
            for name, number in definitions(path):
                places[name].append((path.relative_to(root), number))
    bad = 0
    for name, found in places.items():
        if len({path for path, _ in found}) > 1:
            print(f"{name} is defined in " + ", ".join(f"{path}:{line}" for path, line in found), file=sys.stderr)
            bad = 1
    return bad


if __name__ == "__main__":
    sys.exit(main())
