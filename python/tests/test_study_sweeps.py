"""Sweeps that are interrupted: nothing is lost, nothing is counted twice, whatever dies."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from study_help import (  # noqa: F401  a fixture is used by its name
    POINTS, assert_whole, command, done, evaluated, gated_square, mortal_square, notes, slow_square, square, study_of, wait_until,
    workers_of,
)

import hamilcar
from hamilcar.study import Parameter, Progress, Study, latin_hypercube, open_folder


def test_a_folder_goes_on_with_what_is_missing_or_damaged(notes, tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    study = study_of(square)
    assert_whole(study.run(POINTS, tmp_path / "f", chunk=4, progress=False))
    tables = sorted((tmp_path / "f").glob("chunk_*"))
    assert len(tables) == 5 and evaluated(notes) == POINTS[:, 0].tolist()
    tables[0].unlink()  # points 0 to 3
    whole = tables[1].read_bytes()
    tables[1].write_bytes(whole[: len(whole) // 2])  # 4 to 7: cut off
    tables[2].write_bytes(tables[4].read_bytes())  # 8 to 11: another chunk's rows
    table = parquet.read_table(tables[3])  # 12 to 15: a good file with another figure in the place of 14^2
    figures = np.where(table["square"].to_numpy() == 196.0, 197.0, table["square"].to_numpy())
    parquet.write_table(table.set_column(1, table.schema.field(1), [figures]), tables[3])
    for file in notes.iterdir():
        file.unlink()
    assert_whole(study.run(POINTS, tmp_path / "f", progress=False))
    assert evaluated(notes) == POINTS[:16, 0].tolist()  # and 16 to 19 not again
    assert not list((tmp_path / "f").glob(".*.tmp"))


def test_another_study_or_other_points_are_refused(tmp_path, monkeypatch):
    study_of(square).run(POINTS, tmp_path, progress=False)
    with pytest.raises(ValueError, match="another study, different in function"):
        study_of(slow_square).run(POINTS, tmp_path, progress=False)
    with pytest.raises(ValueError, match="other points: 20 there, 20 here"):
        study_of(square).run(POINTS + 1.0, tmp_path, progress=False)
    monkeypatch.setattr("hamilcar.study._store._core", type("Core", (), {"version": "9.9"}))
    with pytest.raises(ValueError, match="this is 9.9"):
        study_of(square).run(POINTS, tmp_path, progress=False)


def test_a_changed_tire_file_makes_another_study(car, tmp_path):
    tables = car.to_dict()
    tire = tmp_path / "own.tir"
    tire.write_text(Path(tables["tire"]["road"]["file"]).read_text())
    tables["tire"]["road"]["file"] = str(tire)
    study = Study(tables, [Parameter("chassis.mass_kg", 900, 1300)], ["max chassis.speed"], scenario="step_steer")
    study.run([[1000.0]], tmp_path / "f", progress=False)
    tire.write_text(tire.read_text() + "\n$ changed\n")
    with pytest.raises(ValueError, match="a file that the vehicle or the scenario names"):
        study.run([[1000.0]], tmp_path / "f", progress=False)


def test_without_pyarrow_tables_are_npz(tmp_path, monkeypatch):
    monkeypatch.setattr("hamilcar.study._store.has_parquet", lambda: False)
    assert_whole(study_of(square).run(POINTS, tmp_path, chunk=6, progress=False))
    assert len(list(tmp_path.glob("chunk_*.npz"))) == 4
    assert_whole(open_folder(tmp_path).load())


def test_a_table_that_cannot_be_written_leaves_the_old_one(tmp_path):
    from hamilcar.study._tables import write_whole

    def fails(beside):
        beside.write_text("half")
        raise OSError("disk full")

    (tmp_path / "t").write_text("old")
    with pytest.raises(OSError, match="disk full"):
        write_whole(tmp_path / "t", fails)
    assert [file.name for file in tmp_path.iterdir()] == ["t"] and (tmp_path / "t").read_text() == "old"


def test_processes_may_die(notes, tmp_path):
    """SIGKILL once: the chunk is evaluated again. Exit every time: given up, the others go on, and the next run tries it again."""
    study, seen = study_of(mortal_square), []
    result = study.run(POINTS, tmp_path / "f", chunk=2, processes=2, retries=1, progress=seen.append)
    for i, (figure,) in enumerate(result.Y):
        if i in (16, 17):  # one chunk
            assert np.isnan(figure) and result.reasons[i] == "its process ended 2 times, the last time by exit code 7"
        else:
            assert figure == i * i and result.reasons[i] == ""
    times = evaluated(notes)
    assert times.count(5.0) == 2 and times.count(17.0) == 2 and times.count(19.0) == 1
    assert len(list((tmp_path / "f").glob("chunk_*"))) == 9
    assert isinstance(seen[-1], Progress) and (seen[-1].done, seen[-1].total, seen[-1].failed) == (20, 20, 2)
    study.run(POINTS, tmp_path / "f", chunk=2, processes=1, retries=0, progress=False)
    assert evaluated(notes).count(17.0) == 3 and evaluated(notes).count(5.0) == 2


def test_processes_give_the_bits_of_this_one(car):
    study = Study(car, [Parameter("chassis.mass_kg", 900, 1300)], ["max chassis.rate.yaw"], scenario="step_steer")
    X = latin_hypercube(study.parameters, 7)
    assert np.array_equal(study.run(X, chunk=2, processes=2, progress=False).Y, study.evaluate(X))


def test_a_script_without_a_guard_is_told(tmp_path):
    (tmp_path / "script.py").write_text(
        "import study_help as t\nt.study_of(t.square).run(t.POINTS, processes=1, retries=0, progress=False)\n"
    )
    places = os.pathsep.join([str(Path(__file__).parent), str(Path(hamilcar.__file__).parents[1])])
    environment = {**os.environ, "PYTHONPATH": places}
    ran = subprocess.run([sys.executable, tmp_path / "script.py"], env=environment, capture_output=True, text=True, timeout=60)
    assert ran.returncode == 1 and 'if __name__ == "__main__":' in ran.stderr.splitlines()[-1]


@pytest.mark.parametrize(("sent", "expected"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_ctrl_c_ends_all_and_the_next_run_goes_on(notes, tmp_path, sent, expected):
    """Ctrl-C goes to all processes of the terminal, the end of a task's time to the driver."""
    study_of(gated_square).prepare(POINTS, tmp_path / "f", chunk=2)
    listens = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)}  # shells ignore it in the background
    process = command("run", tmp_path / "f", "--processes", 2, start_new_session=True, **listens)
    wait_until(lambda: len(workers_of(notes)) == 2 and len(list((tmp_path / "f").glob("chunk_*"))) == 2)
    os.killpg(process.pid, sent) if sent == signal.SIGINT else process.send_signal(sent)
    assert process.wait(10) == expected and "Traceback" not in process.stderr.read()
    workers = workers_of(notes)
    wait_until(lambda: not any(Path(f"/proc/{worker}").exists() for worker in workers))
    assert done("status", tmp_path / "f")[:2] == (1, "2/10 chunks, 4/20 points, 0 failed\nmissing chunks: 2 3 4 5 6 7 8 9\n")
    (notes / "go").touch()
    code, _, err = done("run", tmp_path / "f")
    assert code == 0 and "20/20 points, 1 failed" in err
    assert_whole(open_folder(tmp_path / "f").load())
