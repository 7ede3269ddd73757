"""Tasks of an array without Slurm, and the command; by_hand/slurm_array.sh has the real one."""

import json
import os
import signal
import subprocess
from pathlib import Path

from study_help import (  # noqa: F401  a fixture is used by its name
    POINTS, assert_whole, done, evaluated, gated_square, notes, square, study_of, wait_until,
)

from hamilcar.study import open_folder


def test_a_killed_task_of_an_array_is_run_again(notes, tmp_path):
    """The script that sbatch would get, its tasks by hand: one is killed with all that it started, and run again."""
    folder = study_of(gated_square).prepare(POINTS, tmp_path / "f o", chunk=2).path
    code, out, _ = done("submit", folder, "--slurm", "--tasks", 2, "--dry-run", "--", "--time=1:00:00")
    script = Path(out.strip())
    assert code == 0
    assert {"#SBATCH --array=0-1", "#SBATCH --requeue", "#SBATCH --time=1:00:00"} <= set(script.read_text().splitlines())

    def start(task):
        environment = {**os.environ, "SLURM_ARRAY_TASK_ID": str(task)}
        return subprocess.Popen(["bash", str(script)], env=environment, start_new_session=True, stderr=subprocess.DEVNULL)

    tasks = [start(0), start(1)]
    wait_until(lambda: list(folder.glob("chunk_00000*")))
    os.killpg(tasks[0].pid, signal.SIGKILL)
    assert tasks[0].wait(10) == -signal.SIGKILL
    (notes / "go").touch()
    assert tasks[1].wait(30) == 0
    code, out, _ = done("status", folder)
    assert code == 1 and out.endswith("missing chunks: 2 4 6 8\n")  # task 1 had the odd ones
    assert done("gather", folder, "-o", tmp_path / "r.csv")[0] == 1 and not (tmp_path / "r.csv").exists()
    assert start(0).wait(30) == 0
    assert done("gather", folder, "-o", tmp_path / "r.npz")[0] == 0
    assert_whole(open_folder(folder).load())
    times = evaluated(notes)
    assert all(times.count(a) == 1 for a in POINTS[:, 0] if a // 2 not in (2, 4, 6, 8))  # what was done is not done again


def test_the_command_tells_what_is_wrong(notes, tmp_path):
    assert "holds no study" in done("status", tmp_path)[2]
    folder = study_of(square).prepare(POINTS, tmp_path / "f", chunk=5).path
    assert "task 2 of 2: expected a number from 0 to 1" in done("work", folder, "--task", 2, "--of", 2)[2]
    assert "expected an option of sbatch" in done("submit", folder, "--slurm", "--dry-run", "--", "time")[2]
    assert done("submit", folder, "--slurm", "--dry-run")[0] == 0
    assert "#SBATCH --array=0-3" in (folder / "slurm.sh").read_text()  # no more tasks than chunks
    told = json.loads((folder / "manifest.json").read_text())
    (folder / "manifest.json").write_text(json.dumps({**told, "format": 2}))
    assert "format 2: expected 1" in done("status", folder)[2]
