"""A run that was killed or asked to stop leaves nothing behind, and the same command goes on."""

import os
import signal
import subprocess
import sys
import time

import psutil
import pytest

SOLVER = """
import tempfile
from pathlib import Path
from nptcs.solvers.contract import Solver, SolverResult
from nptcs.solvers.external import run_command

def solve(inputs):
    c = inputs.values["c"]
    with tempfile.TemporaryDirectory() as folder:
        run_command(["sleep", "0.5"], Path(folder), 60.0)
    return SolverResult(status="ok", vertical_stiffness_n_per_mm=c, displacement_mm=1.0)

SOLVER = Solver("slow", "1", solve, frozenset({"c"}), about="a test")
"""
CONFIG = """
studies:
  - name: f
    title: Slow cases
    factors: [{name: c, label: c, unit: "-", levels: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]}]
    solvers: [slow]
solvers: {slow: {module: slow.py}}
"""
BATCH = "results/5_solve/f/slow/batch_1.jsonl"
WITHIN_S = 5.0


class Run:
    """A run of Snakemake in a project, whose temporary folder is its own."""

    def __init__(self, project):
        self.project, self.temp = project, project.path("temp")
        self.temp.mkdir(exist_ok=True)
        self.log = project.path("run.log")
        environment = {
            **os.environ,
            "PYTHONPATH": str(project.path("workflow/src")),
            "TMPDIR": str(self.temp),
        }
        command = [sys.executable, "-m", "snakemake", "-j2", BATCH]
        with self.log.open("wb") as stream:
            self.process = subprocess.Popen(
                [*command, "--configfile", "config/config.yaml"],
                cwd=project.folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=stream,
                start_new_session=True,
            )

    def records(self):
        return list(self.project.path("results/5_solve/records").glob("??/[0-9a-f]*.json"))

    def wait_for_records(self, number):
        while len(self.records()) < number:
            assert self.process.poll() is None, self.said()
            time.sleep(0.02)

    def family(self):
        root = psutil.Process(self.process.pid)
        return [root, *root.children(recursive=True)]

    def said(self):
        return self.log.read_text(encoding="utf-8")


def all_gone(run, family):
    """Whether processes and temporary files are gone in time."""
    end = time.monotonic() + WITHIN_S
    while time.monotonic() < end:
        left = [one for one in family if one.is_running() and one.status() != "zombie"]
        if not left and not list(run.temp.glob("[!s]*")):  # Snakemake's own: by the next run
            return True
        time.sleep(0.05)
    return False


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads the process table of Linux")
def test_after_a_kill_and_after_a_signal_the_same_command_goes_on(unsolved):
    unsolved.path("slow.py").write_text(SOLVER)
    unsolved.path("config/config.yaml").write_text(CONFIG)

    run = Run(unsolved)
    run.wait_for_records(2)
    family = run.family()
    assert len(family) >= 5  # host, script, fork server, warden, cases
    run.process.kill()
    run.process.wait()
    assert all_gone(run, family)
    assert list(unsolved.path(".snakemake/locks").iterdir())

    run = Run(unsolved)
    run.wait_for_records(5)
    assert "none of its processes is alive: its lock is removed" in run.said()
    family = run.family()
    run.process.send_signal(signal.SIGTERM)
    assert all_gone(run, family[1:])
    assert run.process.wait(timeout=60) != 0
    assert "To continue, type the same command again:\n    python -m snakemake -j2" in run.said()

    known = {file: file.stat().st_mtime_ns for file in run.records()}
    run = Run(unsolved)
    assert run.process.wait() == 0, run.said()
    assert len(run.records()) == 10
    assert known.items() <= {file: file.stat().st_mtime_ns for file in run.records()}.items()
    assert list(run.temp.iterdir()) == []


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads the process table of Linux")
def test_a_kill_before_the_snakefile_is_read_leaves_nothing_in_the_temporary_folder(tmp_path):
    (tmp_path / "Snakefile").write_text("import time\ntime.sleep(60)\n")
    temp = tmp_path / "temp"
    temp.mkdir()
    process = subprocess.Popen(
        [sys.executable, "-m", "snakemake", "-n", "--logger", "nptcs", "-d", str(tmp_path)],
        cwd=tmp_path,
        env={**os.environ, "TMPDIR": str(temp)},
        stdin=subprocess.DEVNULL,
        start_new_session=True,
    )
    until = time.monotonic() + 60.0
    while not list(temp.rglob("snakemake*")) and time.monotonic() < until:
        assert process.poll() is None
        time.sleep(0.02)
    assert list(temp.rglob("snakemake*"))
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    until = time.monotonic() + WITHIN_S
    while list(temp.iterdir()) and time.monotonic() < until:
        time.sleep(0.05)
    assert list(temp.iterdir()) == []
