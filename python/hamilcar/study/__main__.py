"""``python -m hamilcar.study``: works off a folder that ``Study.prepare`` made, here or as a task of Slurm."""

from __future__ import annotations

import argparse
import signal
import sys
from typing import Any

from .._errors import Error
from ._processes import in_processes
from ._run import work_off
from ._slurm import cpus_of_task, submit, work, write_script
from ._store import Folder, open_folder


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m hamilcar.study", description="Works off the folder of a study.")
    commands = parser.add_subparsers(dest="command", required=True)

    def add(name: str, help_: str) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=help_, description=help_)
        command.add_argument("folder", metavar="FOLDER")
        return command

    run = add("run", "Evaluates the chunks that are missing, on this machine.")
    run.add_argument("--processes", type=int, default=1, metavar="N", help="at the same time (1)")
    of_task = add("work", "Evaluates the missing chunks of one task out of several; what each task of a Slurm array does.")
    of_task.add_argument("--task", type=int, required=True, metavar="T", help="from 0 on")
    of_task.add_argument("--of", type=int, required=True, metavar="N", help="so many tasks")
    at_once = "at the same time ($SLURM_CPUS_PER_TASK, or 1)"
    of_task.add_argument("--processes", type=int, default=cpus_of_task(), metavar="N", help=at_once)
    for command in (run, of_task):
        command.add_argument("--retries", type=int, default=2, metavar="N", help="of a chunk whose process died (2)")
    array = add("submit", "Submits an array of Slurm tasks. Options of sbatch follow after --.")
    array.add_argument("--slurm", action="store_true", required=True, help="to Slurm, the only one so far")
    array.add_argument("--tasks", type=int, default=100, metavar="N", help="of the array, no more than chunks (100)")
    array.add_argument("--dry-run", action="store_true", help="write slurm.sh, submit nothing")
    add("status", "Counts chunks, points and failed points. Exit code 1 while some are missing.")
    gather = add("gather", "Writes all rows into one table.")
    gather.add_argument("-o", "--output", required=True, metavar="FILE", help=".parquet, .npz or .csv")
    gather.add_argument("--partial", action="store_true", help="also when chunks are missing; their rows say so")
    return parser


def _status(folder: Folder) -> int:
    found = [folder.find(number) for number in range(folder.chunks)]
    there = [one for one in found if one is not None]
    points, failed = sum(map(len, there)), sum(int(one.failed.sum()) for one in there)
    print(f"{len(there)}/{folder.chunks} chunks, {points}/{len(folder.X)} points, {failed} failed")
    missing = [str(number) for number, one in enumerate(found) if one is None]
    if missing:
        print("missing chunks: " + " ".join(missing[:20]) + (f" and {len(missing) - 20} more" if len(missing) > 20 else ""))
    return 1 if missing else 0


def _gather(folder: Folder, told: Any) -> int:
    missing = [number for number in range(folder.chunks) if folder.find(number) is None]
    if missing and not told.partial:
        print(f"{len(missing)} of {folder.chunks} chunks are missing; --partial writes what is there", file=sys.stderr)
        return 1
    result = folder.load()
    result.write(told.output)
    print(f"{told.output}: {len(result)} points, {int(result.failed.sum())} failed")
    return 0


def _worked(troubles: dict[int, str]) -> int:
    for number, trouble in troubles.items():
        print(f"chunk {number}: {trouble}", file=sys.stderr)
    return 1 if troubles else 0


def _command(told: Any, options: list[str]) -> int:
    folder = open_folder(told.folder)
    if told.command == "run":
        execute = in_processes(folder.study, told.processes, told.retries)
        return _worked(work_off(folder, range(folder.chunks), execute, True))
    if told.command == "work":
        return _worked(work(folder, told.task, told.of, told.processes, told.retries, True))
    if told.command == "status":
        return _status(folder)
    if told.command == "gather":
        return _gather(folder, told)
    if told.dry_run:
        print(write_script(folder, told.tasks, options))
    else:
        print(f"job {submit(folder, told.tasks, options)}")
    return 0


def _end(*_: object) -> None:
    sys.exit(143)  # by way of the cleaning up: Slurm says SIGTERM at the end of the time


def main(arguments: list[str] | None = None) -> int:
    given = sys.argv[1:] if arguments is None else arguments
    cut = given.index("--") if "--" in given else len(given)
    parser = _parser()
    told = parser.parse_args(given[:cut])
    if given[cut + 1 :] and told.command != "submit":
        parser.error("options after -- are for submit alone")
    signal.signal(signal.SIGTERM, _end)
    try:
        return _command(told, given[cut + 1 :])
    except (Error, OSError, ValueError, TypeError, ImportError, RuntimeError) as error:
        print(f"hamilcar.study: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    sys.exit(main())
