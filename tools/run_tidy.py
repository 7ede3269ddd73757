#!/usr/bin/env python3
"""clang-tidy on some sources, two at a time. What was clean once is not looked at again: a stamp is kept for the text that the
compiler sees, comments included, with the settings and the version of clang-tidy.

Usage: tools/run_tidy.py BUILD SOURCE...        BUILD has compile_commands.json; stamps are in ~/.cache/hamilcar/tidy
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
STAMPS = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "hamilcar" / "tidy"
# What comes before the compiler, and the precompiled headers of g++: clang-tidy reads each source by itself.
FOREIGN = re.compile(r"^.*ccache |(?<= )-Winvalid-pch |(?<= )-fpch-preprocess |(?<= )-include \S*cmake_pch\S* ")


def commands(build):
    """The compiler's words for each source, without those that clang does not know; writes them for clang-tidy too."""
    entries = json.loads((build / "compile_commands.json").read_text())
    for entry in entries:
        entry["command"] = FOREIGN.sub("", entry["command"])
    folder = ROOT / "build" / "tidy"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "compile_commands.json").write_text(json.dumps(entries))
    return folder, {entry["file"]: entry for entry in entries}


def seen_text(entry):
    """What the compiler sees, with comments and without places."""
    words = shlex.split(entry["command"])
    words = words[: words.index("-o")] + ["-E", "-P", "-C", "-w", entry["file"]]
    return subprocess.run(words, cwd=entry["directory"], check=True, capture_output=True).stdout


def look(source, entry, folder, settings):
    stamp = STAMPS / hashlib.sha256(settings + seen_text(entry)).hexdigest()
    if stamp.exists():
        return True, ""
    result = subprocess.run(["clang-tidy", "-p", str(folder), "--quiet", str(source)], capture_output=True, text=True)
    if result.returncode == 0 and not result.stdout.strip():
        stamp.touch()
        return True, ""
    return False, result.stdout or result.stderr


def main():
    build, sources = pathlib.Path(sys.argv[1]), sys.argv[2:]
    folder, entries = commands(build)
    version = subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout
    settings = version + (ROOT / ".clang-tidy").read_bytes()
    STAMPS.mkdir(parents=True, exist_ok=True)
    clean = True
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(look, ROOT / s, entries[str(ROOT / s)], folder, settings) for s in sources]
        for job in concurrent.futures.as_completed(jobs):
            good, text = job.result()
            clean = clean and good
            if text:
                print(text, end="", flush=True)
    sys.exit(0 if clean else 1)


if __name__ == "__main__":
    main()
