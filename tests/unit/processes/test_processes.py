"""Which processes live, what ended ones leave, and that nothing outlives its run by much."""

import dataclasses
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from nptcs.processes import runs, scratch
from nptcs.processes.identity import RUN, ProcessName, lives, process_name, read_name, wait_for_end
from nptcs.processes.marked import MARK, end_marked
from nptcs.processes.stops import command_again

SLEEP = [sys.executable, "-c", "import time; time.sleep(600)"]


@pytest.fixture
def sleeper():
    """A process that does not end by itself."""
    process = subprocess.Popen(SLEEP)
    yield process
    process.kill()
    process.wait()


def ended(sleeper):
    name = process_name(sleeper.pid)
    sleeper.kill()
    sleeper.wait()
    return name


def python(code, **environment):
    """Start a process that runs `code` with this package."""
    everything = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **environment}
    return subprocess.Popen(
        [sys.executable, "-c", code], env=everything, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )


def gone(condition, seconds=10.0):
    """Wait until a condition holds."""
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)
    return condition()


def test_a_process_is_known_as_long_as_it_lives(sleeper):
    name = process_name(sleeper.pid)
    assert lives(name) is True
    assert read_name(name.text()) == name
    assert (
        lives(dataclasses.replace(name, started="0 ticks")) is False
    )  # the same number, used again
    assert lives(ended(sleeper)) is False
    wait_for_end(name)
    with pytest.raises(ProcessLookupError):
        process_name(sleeper.pid)


def test_what_this_machine_cannot_know_is_not_guessed():
    name = process_name()
    assert lives(dataclasses.replace(name, host="another")) is None
    assert lives(dataclasses.replace(name, space="pid:[1]")) is None
    assert lives(dataclasses.replace(name, boot="before the last start")) is False


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", '{"pid": 1}', "null"])
def test_what_is_not_a_name_is_none(text):
    assert read_name(text) is None


@pytest.fixture
def locked(tmp_path, monkeypatch):
    """Snakemake's folder with locks."""
    monkeypatch.setenv(RUN, "")
    monkeypatch.setattr(runs.atexit, "register", lambda *_: None)
    for name in ("0.input.lock", "0.output.lock"):
        (tmp_path / "locks").mkdir(exist_ok=True)
        (tmp_path / "locks" / name).write_text("results/a.csv\n")
    (tmp_path / "runs").mkdir()
    return tmp_path


def note(folder, name):
    (folder / "runs" / f"{name.pid}.json").write_text(name.text())


def locks(folder):
    return len(list((folder / "locks").iterdir()))


def test_the_lock_of_a_dead_run_is_lifted(locked, sleeper, capsys):
    note(locked, ended(sleeper))
    assert runs.begin_run(locked) is True
    assert locks(locked) == 0
    assert "none of its processes is alive" in capsys.readouterr().err
    noted = (locked / "runs" / f"{os.getpid()}.json").read_text()
    assert read_name(noted.splitlines()[0]) == process_name()


def test_an_earlier_run_with_our_number_is_dead(locked):
    note(locked, dataclasses.replace(process_name(), started="0 ticks"))
    assert runs.begin_run(locked) is True
    assert locks(locked) == 0


def test_the_lock_of_a_run_that_lives_stays(locked, sleeper):
    note(locked, process_name(sleeper.pid))
    assert runs.begin_run(locked) is False
    assert locks(locked) == 2


def test_a_run_on_another_machine_is_named_with_the_command_to_type(locked, capsys):
    note(locked, ProcessName("node7", "boot", "pid:[1]", 4711, "1 ticks"))
    assert runs.begin_run(locked) is False
    assert locks(locked) == 2
    said = capsys.readouterr().err
    assert "node7 (process 4711)" in said
    assert "snakemake --unlock" in said


def test_a_lock_without_a_note_of_its_run_stays(locked):
    assert runs.begin_run(locked) is False
    assert locks(locked) == 2


def test_the_temporary_folder_of_a_dead_run_is_removed_and_no_other(locked, sleeper, tmp_path):
    for name in ("snakemake_a", "precious"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "file").touch()
    dead = ended(sleeper)
    for number, name in enumerate(("snakemake_a", "precious")):
        note = locked / "runs" / f"{number}.json"
        note.write_text(f"{dead.text()}\n{tmp_path / name}\n")
    assert runs.begin_run(locked) is True
    assert not (tmp_path / "snakemake_a").exists()
    assert (tmp_path / "precious/file").exists()


def test_a_note_that_was_cut_off_is_of_a_dead_run(locked):
    (locked / "runs" / "12.json").write_text('{"host"')
    assert runs.begin_run(locked) is True
    assert locks(locked) == 0


def test_a_run_that_ends_normally_leaves_no_note(tmp_path):
    code = f"from nptcs.processes.runs import *; begin_run(Path({str(tmp_path)!r}))"
    process = python(code)
    process.communicate()
    assert process.returncode == 0
    assert list((tmp_path / "runs").glob("*.json")) == []


SCRATCH = """
import os, subprocess, sys, time
from nptcs.processes.scratch import scratch_folder
from nptcs.processes.marked import MARK
folder = scratch_folder()
os.environ[MARK] = str(folder / "case")
child = subprocess.Popen(["sleep", "600"], start_new_session=True)
(folder / "big").write_text("x")
print(folder, child.pid, flush=True)
time.sleep(600)
"""


def test_nothing_is_left_of_a_process_that_was_killed(tmp_path):
    process = python(SCRATCH, TMPDIR=str(tmp_path))
    folder, child = process.stdout.readline().decode().split()
    command = process_name(int(child))
    assert json.loads((Path(folder) / scratch.OWNER).read_text())["pid"] == process.pid
    assert scratch.sweep(tmp_path) == []  # its owner lives
    process.kill()
    process.communicate()
    assert gone(lambda: not lives(command))
    assert gone(lambda: list(tmp_path.iterdir()) == [])


def test_a_long_temporary_folder_leaves_sockets_a_short_name(tmp_path):
    deep = tmp_path / ("d" * 60)
    deep.mkdir()
    code = (
        "from nptcs.processes.scratch import *\n"
        "print(scratch_folder(), socket_folder(), socket_folder() == socket_folder())"
    )
    process = python(code, TMPDIR=str(deep))
    scratch_of, sockets, same = process.communicate()[0].decode().split()
    assert Path(scratch_of).parent == deep
    assert len(sockets) <= scratch.LONGEST
    assert same == "True"
    assert gone(lambda: not Path(sockets).exists() and not Path(scratch_of).exists())


def test_a_process_ends_with_its_run_and_so_does_its_command(tmp_path, sleeper):
    run = process_name(sleeper.pid).text()
    process = python(SCRATCH, TMPDIR=str(tmp_path), **{RUN: run})
    _, child = process.stdout.readline().decode().split()
    command = process_name(int(child))
    sleeper.kill()
    sleeper.wait()
    process.communicate(timeout=20)
    assert gone(lambda: not lives(command))
    assert gone(lambda: list(tmp_path.iterdir()) == [])


def test_a_folder_whose_owner_and_warden_were_killed_is_swept(tmp_path, sleeper):
    left, young = tmp_path / "nptcs-a", tmp_path / "nptcs-b"
    for folder in (left, young, tmp_path / "other"):
        folder.mkdir()
    command = subprocess.Popen(["sleep", "600"], env={**os.environ, MARK: str(left / "case")})
    (left / scratch.OWNER).write_text(ended(sleeper).text())
    assert scratch.sweep(tmp_path) == [left]
    assert command.wait(timeout=20) == -signal.SIGTERM
    assert sorted(path.name for path in tmp_path.iterdir()) == ["nptcs-b", "other"]


def test_only_what_carries_the_mark_is_ended(tmp_path):
    marked, other = (
        subprocess.Popen(["sleep", "600"], env={**os.environ, MARK: str(tmp_path / name)})
        for name in ("a", "ab")
    )
    end_marked(str(tmp_path / "a"))
    assert marked.wait(timeout=20) == -signal.SIGTERM
    assert other.poll() is None
    other.kill()
    other.wait()


SCRIPT = """
import sys, time
from nptcs.console import clear_errors
from nptcs.files import atomic_path
with clear_errors(sys.argv[1] if len(sys.argv) > 1 else {log!r}), atomic_path({table!r}):
    print("ready", flush=True)
    time.sleep(600)
"""


def test_a_script_ends_with_its_run_and_leaves_no_half_file(tmp_path, sleeper):
    code = SCRIPT.format(log=str(tmp_path / "a.log"), table=str(tmp_path / "results/a.csv"))
    process = python(code, **{RUN: process_name(sleeper.pid).text()})
    assert process.stdout.readline() == b"ready\n"
    sleeper.kill()
    sleeper.wait()
    process.communicate(timeout=20)
    assert list((tmp_path / "results").iterdir()) == []


STOPPED = """
import signal, subprocess, sys, time
from nptcs.processes.stops import stop_jobs_on_signals
signal.signal(signal.SIGTERM, lambda *_: None)  # as Snakemake: it waits for its jobs
signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored by jobs in the background
stop_jobs_on_signals(["/opt/bin/snakemake", "-j2"])
job = subprocess.Popen(["sleep", "600"])
print("ready", flush=True)
job.wait()
"""


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_the_jobs_and_says_how_to_go_on(number):
    process = python(STOPPED)
    assert process.stdout.readline() == b"ready\n"
    process.send_signal(number)
    _, said = process.communicate(timeout=20)
    assert b"type the same command again:\n    snakemake -j2\n" in said


def test_the_command_of_make_is_make(monkeypatch):
    monkeypatch.setenv("MAKELEVEL", "1")
    assert command_again(["snakemake", "-j2"]) == "make run"
