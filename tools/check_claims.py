#!/usr/bin/env python3
"""Fails where README, CHANGELOG or docs claim an accuracy that no test asserts.

A claim is a sentence, or a row of a table, with a figure of accuracy; it names its test as `Suite.Name`. The test must exist below tests/,
and each figure of the claim must stand there: in the test's body, or outside all tests of its file and of the headers beside it that
it includes (constants, tables, helpers). 0.2 percent is found as 2e-3 or 0.002, 3 um as 3e-6; 0.2 degrees as 0.2 on a line that says so.
What a maneuver asks of a car (paragraphs that begin with "Passed" or "Verdicts") is a criterion, no accuracy.
Usage: check_claims.py [BUILD]       with a build folder, its tests must also be among those that ctest runs there
"""

import json
import math
import pathlib
import re
import subprocess
import sys

NUMBER = r"(?<![\w.^-])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w^]|\.\d)"
SCALE = {"percent": 1e-2, "%": 1e-2, "um": 1e-6, "mm": 1e-3, "cm": 1e-2, "ms": 1e-3, "degrees": math.pi / 180}
UNIT = r"(?: ?(percent|%|um|mm|cm|ms|degrees)(?!\w))?"
# A figure of accuracy: a small power of ten, or a number behind a word of closeness.
SMALL = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?e-\d+)" + UNIT)
CLOSENESS = re.compile(
    rf"\b(?:(?:agree|match|correspond|coincid|equal|accura|reproduc|deviat|differ)\w*(?: [\w']+){{0,5}}? (?:to|by)"
    rf"|errors? (?:of|below|under)|off by|within|divid\w* the error by|at most|(?:more|less) than) ({NUMBER}){UNIT}"
)
FURTHER = re.compile(rf"(?:,| and|, and| to) ({NUMBER}){UNIT}")
# Sentences that are about accuracy: "within" alone also tells ranges and rules.
ABOUT = re.compile(r"\b(?:agree|reproduc|deviat|accura|correspond|coincid|match)\w*"
                   r"|\b(?:errors?|differs?|off by|asserts?|asserted|(?:stay|keep)s? within)\b|(?<!\d)(?<!\d m) to \d[\d.]*e-\d")
CLAIM_HEADERS = {"asserted", "holds to"}
WITHOUT_FIGURE = re.compile(r"the same (?:bits|numbers)|as stated|blows up")
NAME = re.compile(r"`([A-Z]\w+\.[A-Z]\w+)`")
TEST = re.compile(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+),\s*(\w+)\)\s*\{.*?^\}", re.S | re.M)
LITERAL = re.compile(r"(?<![\w.])(\d+\.?\d*(?:e-?\d+)?|\.\d+(?:e-?\d+)?)f?(?![\w.])")


class Tests:
    def __init__(self, root):
        self.text = {}
        for file in sorted((root / "tests").rglob("*.cpp")):
            source = file.read_text()
            headers = [root / "tests" / include for include in re.findall(r'^#include "(.+?)"', source, re.M)]
            common = "\n".join([TEST.sub("", source), *(h.read_text() for h in headers if h.parent == file.parent)])
            for test in TEST.finditer(source):
                self.text[f"{test[1]}.{test[2]}"] = self.text.get(f"{test[1]}.{test[2]}", "") + test[0] + common

    def assert_figure(self, name, figure, unit):
        for line in self.text[name].splitlines():
            literals = [float(literal) for literal in LITERAL.findall(line.split("//")[0])]
            raw = unit in (None, "ms") or (unit == "degrees" and "deg" in line)
            wanted = ([figure] if raw else []) + ([figure * SCALE[unit]] if unit else [])
            # "Faster by 12 percent at most" is `> 0.88 * published`.
            wanted += [1 - figure * SCALE[unit]] if unit in ("percent", "%") else []
            if any(math.isclose(literal, value, rel_tol=1e-9) for literal in literals for value in wanted):
                return True
        return False


def figures(text, whole):
    """Figures of accuracy as (number, unit); beside a test's name (whole) lists go on: 'at most 5, 8 and 12 percent'."""
    text = re.sub(r"`[^`]*`(?: = \S+)?", "", text)  # names, and keys with their defaults
    found = [(match[1], match[2]) for match in SMALL.finditer(text)]
    for match in CLOSENESS.finditer(text):
        items, at = [(match[1], match[2])], match.end()
        while whole and (more := FURTHER.match(text, at)):
            items.append((more[1], more[2]))
            at = more.end()
        unit = items[-1][1]  # 8, 12 and 5 percent: all of them are percent
        found += [(number, own or (unit if unit in ("percent", "%") else None)) for number, own in items]
    return list(dict.fromkeys(found))


def passages(text):
    """(line, text, claim or None): rows of tables with the cell of their claim, sentences of paragraphs."""
    paragraph, start, header, code = [], 0, [], False

    def sentences():
        whole = " ".join(paragraph)
        if not re.match(r"(?:Passed|Verdicts)\b", whole):
            for sentence in re.split(r"(?<=[.;])(?=\s+[A-Z*`(])", whole):
                yield start, sentence, None
        paragraph.clear()

    for number, line in enumerate([*text.splitlines(), ""], 1):
        if line.startswith("```"):
            code = not code
            continue
        stripped = line.strip()
        if code or not stripped or stripped.startswith(("|", "#", "* ", "- ")):
            yield from sentences()
        if code:
            continue
        if stripped.startswith("|"):
            cells = [cell.strip() for cell in stripped.strip("|").split("|")]
            if not header:
                header = cells
            claims = [cell for name, cell in zip(header, cells) if name in CLAIM_HEADERS]
            yield number, stripped, claims[0] if claims and cells != header and "---" not in cells[0] else None
            continue
        header = []
        if stripped and not stripped.startswith("#"):
            start = start if paragraph else number
            paragraph.append(stripped)


def check(file, tests, run):
    for line, text, claim in passages(file.read_text()):
        names = NAME.findall(text)
        known = [name for name in names if name in tests.text]
        for name in names:
            if name not in tests.text:
                yield line, f"no test `{name}` below tests/"
            elif run is not None and name not in run:
                yield line, f"test `{name}` is not among those that ctest runs"
        if claim is not None and not names:
            yield line, "a claim without its test; name it as `Suite.Name`"
        found = figures(claim if claim is not None else text, claim is not None or bool(names))
        if claim is None and not names:
            if found and ABOUT.search(text):
                figure = " ".join(part for part in found[0] if part)
                yield line, f"{figure}: a figure of accuracy without its test; name it as `Suite.Name`, or leave it out"
        elif known and claim is not None and not found and not WITHOUT_FIGURE.search(claim):
            yield line, f"no figure of accuracy found in \"{claim}\""
        elif known:
            for number, unit in found:
                if not any(tests.assert_figure(name, float(number), unit) for name in known):
                    yield line, f"{number} {unit or ''} stands in no assertion or constant of {', '.join(known)}"


def tests_that_run(build):
    listed = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True).stdout)
    names = set()
    for test in listed["tests"]:
        disabled = any(p["name"] == "DISABLED" and p["value"] for p in test.get("properties", []))
        # room.Suite.Name, room.Instances/Suite.Name/parameter  # GetParam() = ...
        match = re.match(r"\w+\.(?:\w+/)?(\w+)(?:/\w+)?\.(\w+)", test["name"])
        if match and not disabled:
            names.add(f"{match[1]}.{match[2]}")
    return names


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    tests = Tests(root)
    run = tests_that_run(sys.argv[1]) if len(sys.argv) > 1 else None
    problems = 0
    for file in [root / "README.md", root / "CHANGELOG.md", root / "benchmarks/README.md", *sorted((root / "docs").rglob("*.md"))]:
        for line, message in check(file, tests, run):
            print(f"{file.relative_to(root)}:{line}: {message}", file=sys.stderr)
            problems += 1
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
