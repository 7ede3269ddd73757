#!/usr/bin/env python3
"""Follows a tutorial literally, in an empty folder: types its commands, puts its numbers into its files, compares what it shows.

    tools/follow_tutorial.py PROGRAM TUTORIAL EXAMPLE [--keep]

A block ```sh is typed, `hamilcar` being PROGRAM. A block ```text shows the output of the commands before it: its lines come in this order,
"..." stands for any others. A block ```toml whose first line is "# FILE: put in" replaces the keys that it has in that file, or adds them to
their tables; with "# FILE" alone it is the whole file. What lies in EXAMPLE in the end has to be what came out; --keep copies it there instead.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(sh|text|toml)\n(.*?)^```$", re.M | re.S)
HEADER = re.compile(r"^\[+([\w.]+)\]+")
KEY = re.compile(r"^([\w.]+) = (.*)$")


def sections(lines):
    """The table that each line stands in, entries of lists by their names: "axle[front].spring"."""
    table, entry, out = "", {}, []
    for number, text in enumerate(lines):
        header = HEADER.match(text)
        if header:
            top, dot, rest = header[1].partition(".")
            if text.startswith("[["):
                entry[top] = "[" + next(t for t in lines[number:] if t.startswith("name = ")).split('"')[1] + "]"
            table = top + entry.get(top, "") + dot + rest
        out.append(table)
    return out


def put_in(text, fragment):
    """The text with the keys of the fragment in place of its own."""
    lines, new = text.splitlines(), fragment.splitlines()
    for table, line in zip(sections(new), new):
        key = KEY.match(line)
        if not key or key[1] == "name":
            continue
        places = [n for n, t in enumerate(sections(lines)) if t == table]
        if not places:
            if "[" in table:
                sys.exit(f"there is no table {table} to put {key[1]} in")
            lines += ["", f"[{table}]"]
            places = [len(lines) - 1]
        same = [n for n in places if lines[n].startswith(key[1] + " = ")]
        if same:
            lines[same[0]] = line
        else:
            last = max(n for n in places if HEADER.match(lines[n]) or KEY.match(lines[n]))
            lines.insert(last + 1, line)
    return "\n".join(lines) + "\n"


def expect_lines(wanted, output):
    """Fails where a line that the tutorial shows did not come, or too late."""
    rest = [" ".join(line.split()) for line in output.splitlines()]
    for line in wanted.splitlines():
        line = " ".join(line.split())
        if line == "..." or not line:
            continue
        if line not in rest:
            sys.exit(f"the tutorial shows a line that did not come:\n  {line}\namong\n{output}")
        rest = rest[rest.index(line) + 1:]


def follow(program, tutorial, folder):
    """Every block, in order; names of files that were written."""
    (folder / "bin").mkdir()
    (folder / "bin/hamilcar").symlink_to(program)
    environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}")
    work, output = folder / "work", ""
    work.mkdir()
    for kind, text in BLOCK.findall(tutorial.read_text()):
        if kind == "sh":
            ran = subprocess.run(["bash", "-e", "-c", text], cwd=work, env=environment, text=True, capture_output=True)
            output = ran.stdout + ran.stderr
            if ran.returncode:
                sys.exit(f"{text}\nended with {ran.returncode}:\n{output}")
        elif kind == "text":
            expect_lines(text, output)
        else:
            first, rest = text.split("\n", 1)
            file = work / first.removeprefix("# ").removesuffix(": put in")
            file.write_text(put_in(file.read_text(), rest) if first.endswith(": put in") else rest)
    return sorted(work.glob("*.toml"))


def main():
    program, tutorial, example = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
    with tempfile.TemporaryDirectory() as folder:
        files = follow(program, tutorial, pathlib.Path(folder))
        for file in files:
            if "--keep" in sys.argv:
                shutil.copy(file, example)
            elif file.read_text() != (example / file.name).read_text():
                sys.exit(f"{example / file.name} is not what the tutorial makes; write it anew with --keep")
    print(f"{tutorial.name}: followed, {len(files)} files as in {example.name}")


if __name__ == "__main__":
    main()
