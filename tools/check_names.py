#!/usr/bin/env python3
"""Fails on a class or an inline function of one qualified name that two files define: the linker would merge them in silence.
Fails also on words that were retired for standard ones (docs/glossary.md), in names and in prose.

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

# Retired words and what to write instead. A name counts word by word, `SpokeSize` and `spoke_size` as "spoke size".
RETIRED = {
    r"abreast": "side by side",
    r"(?:energy )?books|energy book": "energy balance",
    r"c[ao]mes? apart": "constraint violation",
    r"contestants?": "benchmark case",
    r"films?": "replay",
    r"flush tiny numbers": "FlushDenormals",
    r"garage": "catalog",
    r"guests?": "client",
    r"(?<!wheel )(?<!crash )hubs?": "chassis, or wheel hub",
    r"lay over": "merge",
    r"lobby|(wake up )?bell(?! crank)": "connections, wake-up",
    r"nobodys?|whoever": "no driver, a caller",
    r"senses": "observation",
    r"spokes?": "suspension",
    r"turns? of the ring|turn ring|ring turn": "right-hand side",
    r"workshop": "background worker",
}
RETIRED_ANY = re.compile("|".join(rf"(?P<w{i}>\b(?:{words})\b)" for i, words in enumerate(RETIRED)))
WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])|\d+")


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


def retired_words(path):
    """Yields (word, replacement, line) of a source or a page."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        words = " ".join(WORD.findall(line.replace('nobody"', "")))  # a value of the page's protocol
        for found in RETIRED_ANY.finditer(words.lower()):
            yield found[0], list(RETIRED.values())[int(found.lastgroup[1:])], number


def texts(root):
    """Sources, tests and pages; the change log quotes old names."""
    for folder in ("hamilcar", "cli", "tests"):
        yield from sorted((root / folder).rglob("*.[hc]pp"))
    yield from sorted(path for path in root.glob("*.md") if path.name != "CHANGELOG.md")
    yield from sorted((root / "docs").rglob("*.md"))
    yield root / "benchmarks" / "README.md"


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
    for path in texts(root):
        for word, instead, line in retired_words(path):
            print(f"{path.relative_to(root)}:{line}: retired word '{word}', write: {instead}", file=sys.stderr)
            bad = 1
    return bad


if __name__ == "__main__":
    sys.exit(main())
