#!/usr/bin/env python3
"""Compares the instructions of a step with those last kept, by callgrind: the same on every run and on every machine.

Usage: tools/count_instructions.py BUILD_FOLDER [--keep]

Exit code 1 where a step takes over 3 percent more instructions than benchmarks/results/instructions.json says. A change
that is worth it acknowledges that by --keep, which writes the new counts into the file. Counts depend on the compiler,
so the file names it, and another compiler only prints. AVX-512 is beyond callgrind.
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEPT = ROOT / "benchmarks" / "results" / "instructions.json"
WORK = [(engine, what, "bmw_323i_paper") for engine in ("sse2", "avx2") for what in ("one", "double", "single")]
WORK += [("avx2", what, vehicle) for vehicle in ("formula", "pickup", "truck_semitrailer") for what in ("one", "double")]
FEW, MANY = 100, 600  # steps; the difference leaves out the start
ALLOWED = 1.03


def instructions(program, engine, what, vehicle, steps):
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", program, engine, what, vehicle, str(steps)],
        capture_output=True, text=True, check=False)
    counted = re.search(r"Collected : (\d+)", run.stderr)
    if run.returncode != 0 or not counted:
        sys.exit(f"{program} {engine} {what} {vehicle} {steps} under valgrind failed:\n{run.stderr}")
    return int(counted[1])


def compiler(build):
    cache = (build / "CMakeCache.txt").read_text()
    path = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.M)[1]
    return subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        print("usage: tools/count_instructions.py BUILD_FOLDER [--keep]", file=sys.stderr)
        return 2
    build = pathlib.Path(sys.argv[1])
    program = build / "benchmarks" / "instruction_count"
    counts = {f"{vehicle} {engine} {what}": round((instructions(program, engine, what, vehicle, MANY) -
                                                   instructions(program, engine, what, vehicle, FEW)) / (MANY - FEW))
              for engine, what, vehicle in WORK}
    found = {"compiler": compiler(build), "instructions_per_step": counts}
    if "--keep" in sys.argv:
        KEPT.write_text(json.dumps(found, indent=2) + "\n")
    kept = json.loads(KEPT.read_text())
    comparable = kept["compiler"] == found["compiler"]
    lost = False
    for name, count in counts.items():
        before = kept["instructions_per_step"].get(name, count)
        worse = comparable and count > ALLOWED * before
        lost = lost or worse
        print(f"{name:<34}{count:>8} instructions a step, {100 * (count / before - 1):+.1f} %{'  <-- too many' if worse else ''}")
    if not comparable:
        print(f"kept with {kept['compiler']}, counted with {found['compiler']}: not compared")
    if lost:
        print("acknowledge a loss that is worth it with: tools/count_instructions.py build/release --keep", file=sys.stderr)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
