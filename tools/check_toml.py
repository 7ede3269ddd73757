#!/usr/bin/env python3
"""Checks every vehicle, scenario and study against its schema with taplo, and that the schemas refuse what is wrong.

The linter is what editors use ("Even Better TOML"), so a file that passes here is clean there. It is installed once
from tools/taplo/package-lock.json and needs no network after that. Without Node.js nothing is checked, and it says so.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
HOME = ROOT / "tools/taplo"
PACKAGE = HOME / "node_modules/@taplo/cli/package.json"
CAR, TRUCK, RUN = "vehicles/bmw_323i.toml", "vehicles/truck_semitrailer.toml", "scenarios/step_steer.toml"
ROUGH, STUDY = "scenarios/rough_road.toml", "studies/front_bar.toml"

# What is wrong, the file, what is changed into what, and a piece of the linter's message.
MISTAKES = [
    ("misspelled key", CAR, "mass_kg = 1002.0", "mas_kg = 1002.0", "'mas_kg' was unexpected"),
    ("missing key", CAR, "mass_kg = 1002.0", "", '"mass_kg" is a required property'),
    ("wrong type", CAR, "mass_kg = 1002.0", 'mass_kg = "heavy"', 'is not of type "number"'),
    ("out of range", CAR, "mass_kg = 1002.0", "mass_kg = -3", "less than or equal to the minimum"),
    ("two numbers for a point", CAR, "at_m = [0.75, 0.70, 0.45]", "at_m = [0.75, 0.70]", "has less than 3 items"),
    ("misspelled word", CAR, '"macpherson"', '"mcpherson"', '"mcpherson" is not one of'),
    ("misspelled table", CAR, "[axle.damper]", "[axle.dampr]", '"damper" is a required property'),
    ("hardpoints of another suspension", CAR, '"macpherson"', '"h_arm"', "('strut_top_m', 'slide_point_m', "),
    ("missing hardpoint", CAR, "ball_joint_m = ", "# ", '"ball_joint_m" is a required property'),
    ("key of another tire model", "vehicles/bmw_e21_320i.toml", 'model = "linear"', 'model = "spring"',
     "'carcass_damping_s', 'rolling_resistance' were unexpected"),
    ("two ways at once", CAR, "camber_deg = -0.69", "camber_deg = 0\nspin_axis = [0, 1, 0]",
     "'camber_deg', 'toe_in_deg' were unexpected"),
    ("a steered axle without kingpins", TRUCK, "kingpin_lower_m = ", "# ", '"kingpin_lower_m" is a required property'),
    ("a trailer without a hitch", TRUCK, "hitch = ", "# ", '"hitch" is a required property'),
    ("misspelled with a base", "vehicles/bmw_323i_digressive.toml",
     "damper.force_N", "damper.force_M", "'force_M' was unexpected"),
    ("key of a tire without a file", CAR, 'model = "magic_formula"', 'model = "fiala"', "'file' was unexpected"),
    ("a road class that is none", ROUGH, 'class = "C"', 'class = "Z"', '"Z" is not one of'),
    ("misspelled key of an obstacle", ROUGH, "height_m = 0.02", "hight_m = 0.02", "'hight_m' was unexpected"),
    ("misspelled key", RUN, "step_s", "stp_s", "'stp_s' was unexpected"),
    ("missing key", RUN, "duration_s", "# ", '"duration_s" is a required property'),
    ("wrong type", RUN, "duration_s = 6.0", "duration_s = true", 'is not of type "number"'),
    ("a list without times", RUN, "time_s = ", "# ", '"time_s" is a required property'),
    ("two steering inputs", RUN, "[inputs.drive]", "[inputs.rack]\ndisplacement_m = 0\n[inputs.drive]",
     "'steering_wheel' was unexpected"),
    ("misspelled key", STUDY, "maneuver = ", "manoeuvre = ", "'manoeuvre' was unexpected"),
    ("missing key", STUDY, "key = ", "# ", '"key" is a required property'),
    ("a goal that is none", STUDY, 'want = "min"', 'want = "small"', '"small" is not one of'),
]


def install():
    """Whether the linter is there in the version that the lock file names, installing it if it is not."""
    wanted = json.loads((HOME / "package-lock.json").read_text())["packages"]["node_modules/@taplo/cli"]["version"]
    if PACKAGE.exists() and json.loads(PACKAGE.read_text())["version"] == wanted:
        return
    print(f"installing @taplo/cli {wanted} in {HOME.relative_to(ROOT)}")
    subprocess.run(["npm", "ci", "--silent", "--no-audit", "--no-fund"], cwd=HOME, check=True)


def lint(*arguments):
    """Exit code, output, and the messages about each file."""
    program = ["node", HOME / "node_modules/@taplo/cli/dist/cli.js", "lint", *map(str, arguments)]
    done = subprocess.run(program, cwd=ROOT, capture_output=True, text=True)
    output = done.stdout + done.stderr
    messages = {}
    for message, path in re.findall(r"^error: (.*)\n\s*┌─ (.*):\d+:\d+$", output, re.MULTILINE):
        of_file = messages.setdefault(pathlib.Path(path).name, [])
        if message not in of_file:  # it is repeated at every token of a table
            of_file.append(message)
    return done.returncode, output, messages


def unrefused(folder):
    """The mistakes that the linter does not see, or sees as something else."""
    for kind, home in (("vehicle", "vehicles/"), ("scenario", "scenarios/"), ("study", "studies/")):
        mistakes = {}
        for number, mistake in enumerate(MISTAKES):
            what, name, old, new, _ = mistake
            text = (ROOT / name).read_text()
            if not name.startswith(home):
                continue
            if old not in text:
                yield f"{what}: '{old}' is not in {name}"
                continue
            path = folder / f"{kind}_{number}.toml"
            path.write_text(text.replace(old, new, 1))
            mistakes[path] = mistake
        schema = (ROOT / f"schemas/{kind}.schema.json").as_uri()
        _, _, messages = lint("--no-auto-config", "--schema", schema, *mistakes)
        for path, (what, name, old, new, message) in mistakes.items():
            found = messages.get(path.name, [])
            if not any(message in line for line in found):
                yield f"{what}: {name} with '{new}' for '{old}': expected '{message}' in {found}"


def main():
    if not shutil.which("node") or not (shutil.which("npm") or PACKAGE.exists()):
        print("check_toml: skipped, Node.js and npm are not installed (scripts/packages installs them)")
        return 0
    try:
        install()
    except subprocess.CalledProcessError:
        # A machine without a network can still build and test; the readers themselves check every shipped file.
        print("check_toml: skipped, npm could not install @taplo/cli: it needs the network once", file=sys.stderr)
        return 0
    code, output, messages = lint()
    if code != 0:
        lines = [f"{name}: {message}" for name, found in messages.items() for message in found]
        print("\n".join(lines) or output, file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        problems = list(unrefused(pathlib.Path(folder)))
    for problem in problems:
        print(f"check_toml: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
