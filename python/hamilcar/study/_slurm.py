"""Sweeps as arrays of Slurm jobs: task t of n works off the chunks t, t + n, t + 2 n, ... of a folder that all nodes see.

No two tasks have a chunk in common and each appears whole or not at all, so there is nothing to lock: a task that Slurm starts
again, or an array that is submitted again, finds what is done and evaluates the rest.
"""

from __future__ import annotations

import os
import shlex
import stat
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from ._processes import in_processes
from ._progress import Shown
from ._run import work_off
from ._store import Folder

_SCRIPT = """#!/bin/bash
#SBATCH --job-name={name}
#SBATCH --array=0-{last}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output={folder}/slurm_%A_%a.log
{options}
# Task $SLURM_ARRAY_TASK_ID of {tasks}; by hand: SLURM_ARRAY_TASK_ID=0 bash slurm.sh
exec {python} -m hamilcar.study work {folder} --task "$SLURM_ARRAY_TASK_ID" --of {tasks}
"""


def write_script(folder: Folder, tasks: int, options: Sequence[str] = ()) -> Path:
    """``slurm.sh`` in the folder, for sbatch; ``options``: of sbatch, such as ``--time=1:00:00``."""
    if isinstance(tasks, bool) or not isinstance(tasks, int) or tasks < 1:
        raise ValueError(f"tasks = {tasks!r}: expected a whole number, at least 1")
    for option in options:
        if not option.startswith("-") or "\n" in option:
            raise ValueError(f"{option!r}: expected an option of sbatch, such as --time=1:00:00")
    path = folder.path / "slurm.sh"
    count = min(tasks, folder.chunks)
    text = _SCRIPT.format(
        name="hamilcar", last=count - 1, tasks=count, folder=shlex.quote(str(folder.path)), python=shlex.quote(sys.executable),
        options="".join(f"#SBATCH {option}\n" for option in options),
    )
    path.write_text(text, encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


def submit(folder: Folder, tasks: int, options: Sequence[str] = ()) -> str:
    """Writes ``slurm.sh`` and gives it to sbatch. Returns the number of the job."""
    script = write_script(folder, tasks, options)
    try:
        done = subprocess.run(["sbatch", "--parsable", str(script)], capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise FileNotFoundError(f"there is no sbatch here: submit {script} where Slurm is") from error
    if done.returncode != 0:
        raise RuntimeError(f"sbatch {script}: {done.stderr.strip() or done.stdout.strip()}")
    return done.stdout.strip()


def work(folder: Folder, task: int, of: int, processes: int, retries: int, progress: Shown) -> dict[int, str]:
    """The chunks of one task, in processes of their own. Returns why, of each that could not be evaluated."""
    if of < 1 or not 0 <= task < of:
        raise ValueError(f"task {task} of {of}: expected a number from 0 to {of - 1}")
    return work_off(folder, range(task, folder.chunks, of), in_processes(folder.study, processes, retries), progress)


def cpus_of_task() -> int:
    """As many processes as Slurm gave this task cores; 1 elsewhere."""
    return int(os.environ.get("SLURM_CPUS_PER_TASK", "1"))
