#!/usr/bin/env python3
"""Tests of the tests: small faults, one by one, in the equations; every one must be caught by some test.

The faults are listed in tests/mutations/*.toml: a file, the rooms of tests that are asked first, and of each fault its name, the text
to find (once in the file; where it stands several times, «» marks it within a longer one) and what takes its place. A text that
ends in a semicolon is a statement, any other an expression. All faults are compiled into one copy of the sources, in
build/mutations; an environment variable picks one.

Usage: tools/mutate.py --check                 the list fits the sources, and docs/mutations.md the list (scripts/lint)
       tools/mutate.py [--only NAME]... [--jobs N] [--write]
           builds, runs every fault (or those named), tells what is not caught; --write: docs/mutations.md
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/mutations"
PAGE = ROOT / "docs/mutations.md"
# Asked in this order after the rooms that a file names. None of them compares with figures that the program itself gave.
ROOMS = ["math", "scalar", "tire", "force", "driveline", "steering", "control", "integrator", "linkage", "suspension", "block", "paper",
         "vehicle", "run", "oracle", "analysis", "driver", "engine"]
LIMIT = 600  # seconds for a room; a fault that makes it longer is caught


class Fault:
    def __init__(self, number, path, rooms, name, find, replacement):
        self.number, self.path, self.name = number, path, name
        self.rooms = rooms + [room for room in ROOMS if room not in rooms]
        self.find, self.replacement = find, replacement

    def span(self, text):
        """Where the text to replace stands; complains unless it stands once."""
        before, mark, rest = self.find.partition("«")
        inner, _, after = rest.partition("»")
        if not mark:
            before, inner, after = "", self.find, ""
        whole = before + inner + after
        if text.count(whole) != 1:
            raise SystemExit(f"{self.path}: '{whole}' stands {text.count(whole)} times, expected once ({self.name})")
        start = text.index(whole) + len(before)
        return start, start + len(inner)


def faults():
    out = []
    for listing in sorted((ROOT / "tests/mutations").glob("*.toml")):
        for entry in tomllib.loads(listing.read_text())["file"]:
            for name, find, replacement in entry["faults"]:
                out.append(Fault(len(out) + 1, entry["path"], entry["tests"], name, find, replacement))
    names = [fault.name for fault in out]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise SystemExit(f"tests/mutations: two faults have one name: {', '.join(sorted(twice))}")
    return out


def with_fault(fault, original):
    """The text that has the fault where it is picked."""
    if fault.find.rstrip("»").endswith(";"):
        return f"{{ if (::hamilcar_fault::active == {fault.number}) {{ {fault.replacement} }} else {{ {original} }} }}"
    plain = "[&] {{ return ::hamilcar_fault::plain({}); }}"
    return f"::hamilcar_fault::pick({fault.number}, {plain.format(original)}, {plain.format(fault.replacement)})"


def mutated(text, those, start=0, end=None):
    """`text[start:end]` with all faults in it, one inside the other where they overlap."""
    end = len(text) if end is None else end
    out, at = [], start
    those = sorted(those, key=lambda item: (item[0], -item[1]))
    while those:
        (first, last, fault), *rest = those
        inside = [item for item in rest if item[0] < last]
        if any(item[1] > last for item in inside):
            raise SystemExit(f"{fault.path}: the text of '{fault.name}' overlaps with another's")
        out.append(text[at:first] + with_fault(fault, mutated(text, inside, first, last)))
        at, those = last, rest[len(inside):]
    return "".join(out) + text[at:end]


def write_sources(all_faults):
    """A copy of the tracked files with the faults; files that are the same are left alone, so that little is built anew."""
    source = BUILD / "source"
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True).stdout.decode().split("\0")
    for name in filter(None, listed):
        content = (ROOT / name).read_bytes()
        here = [fault for fault in all_faults if fault.path == name]
        if here:
            text = content.decode()
            text = mutated(text, [(*fault.span(text), fault) for fault in here])
            include = '#include "tests/mutations/fault.hpp"\n'
            content = re.sub(r"(?m)^#include", include + "#include", text, count=1).encode()
        to = source / name
        if to.exists() and to.read_bytes() == content:
            continue
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_bytes(content)
        shutil.copymode(ROOT / name, to)


def build(rooms):
    page = ROOT / "build/release/page.html"
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DHAMILCAR_BUILD_TESTS=ON", f"-DHAMILCAR_PAGE={page if page.exists() else ''}"]
    subprocess.run(["cmake", "-S", BUILD / "source", "-B", BUILD / "tree", "-G", "Ninja", *options], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", BUILD / "tree", "--target", *(f"{room}_tests" for room in rooms)], check=True)


def failure(room, number):
    """The first test of a room that fails with a fault, or None."""
    command = [BUILD / f"tree/tests/{room}_tests", "--gtest_fail_fast", "--gtest_brief=1", "--gtest_color=no"]
    try:
        done = subprocess.run(command, env=os.environ | {"HAMILCAR_FAULT": str(number)}, cwd=BUILD, text=True, errors="replace",
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return f"{room} (takes too long)"
    if done.returncode == 0:
        return None
    named = re.search(r"^\[  FAILED  \] ([\w/.]+)", done.stdout, re.M)
    return f"{room}.{named.group(1)}" if named else f"{room} (ends)"


def run(fault):
    return next((caught for room in fault.rooms if (caught := failure(room, fault.number))), "")


def row(fault, results):
    if fault.name not in results:
        return f"| {fault.name} | not run yet |"
    caught = results[fault.name]
    return f"| {fault.name} | {f'`{caught}`' if caught else '**nothing**'} |"


def page(all_faults, results):
    caught = sum(1 for fault in all_faults if results.get(fault.name))
    ran = sum(1 for fault in all_faults if fault.name in results)
    lines = ["# Faults that the tests catch", "",
             "Each of these small faults was put into the equations, alone; the test beside it was the first to fail. The list is",
             "in `tests/mutations`, `tools/mutate.py --write` makes this page, and `scripts/lint` compares it with the list.", "",
             f"{caught} of the {ran} that ran are caught; {len(all_faults)} are listed.", ""]
    for path in dict.fromkeys(fault.path for fault in all_faults):
        lines += [f"## {path}", "", "| Fault | Caught by |", "| --- | --- |"]
        lines += [row(fault, results) for fault in all_faults if fault.path == path]
        lines.append("")
    return "\n".join(lines[:-1]) + "\n"


def check(all_faults):
    for fault in all_faults:
        fault.span((ROOT / fault.path).read_text())
    told = re.findall(r"^\| (.*) \| (?!---|Caught)(.*) \|$", PAGE.read_text(), re.M)
    told = [name for name, caught in told if caught != "**nothing**"]
    if told != [fault.name for fault in all_faults]:
        missing = [fault.name for fault in all_faults if fault.name not in told]
        raise SystemExit(f"docs/mutations.md does not tell the faults of tests/mutations as caught ({', '.join(missing[:5]) or 'their order'}): "
                         "run tools/mutate.py --write")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--check", action="store_true")
    options.add_argument("--only", action="append", metavar="NAME")
    options.add_argument("--jobs", type=int, default=os.cpu_count())
    options.add_argument("--write", action="store_true")
    asked = options.parse_args()
    all_faults = faults()
    if asked.check:
        return check(all_faults)
    chosen = [fault for fault in all_faults if not asked.only or fault.name in asked.only]
    write_sources(all_faults)
    build(ROOMS)
    for room in ROOMS:
        if (wrong := failure(room, 0)):
            raise SystemExit(f"without any fault {wrong} fails")
    kept = BUILD / "results.json"
    results = json.loads(kept.read_text()) if asked.only and kept.exists() else {}
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        for fault, caught in zip(chosen, pool.map(run, chosen)):
            results[fault.name] = caught
            print(f"{fault.name}: {caught or 'NOT CAUGHT'}", flush=True)
            kept.write_text(json.dumps(results, indent=1))
    if asked.write:
        PAGE.write_text(page(all_faults, results))
    missed = [fault.name for fault in all_faults if results.get(fault.name) == ""]
    if missed:
        sys.exit(f"{len(missed)} of {len(results)} faults are not caught: " + "; ".join(missed))
    print(f"all {len(results)} faults that ran are caught")


if __name__ == "__main__":
    main()
