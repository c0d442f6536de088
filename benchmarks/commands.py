"""Time and memory of a command and everything it starts, for the benchmarks of whole runs."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import psutil

ROOT = Path(__file__).resolve().parents[1]
PAUSE_S = 0.1


@dataclass(frozen=True)
class Used:
    """What a command used: wall and processor time (s), largest memory of all processes (MB)."""

    wall_s: float
    cpu_s: float
    memory_mb: float
    code: int


def environment() -> dict[str, str]:
    """Return an environment in which this checkout's package and this Python are found first."""
    source = str(ROOT / "workflow/src")
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    return {**os.environ, "PYTHONPATH": source, "PATH": path, "OMP_NUM_THREADS": "1"}


def run(command: Sequence[str], folder: str | Path, log: str | Path | None = None) -> Used:
    """Run a command and look at all its processes ten times a second.

    Processor time is that of every process when it was last seen: the last tenth of a second of a
    process is lost, and so is a process that does not live that long. The time of the command's
    own process and of those that it has waited for is exact.
    """
    start, before = time.perf_counter(), os.times()
    seen: dict[tuple[int, float], float] = {}
    peak = 0.0
    output = Path(log).open("wb") if log else subprocess.DEVNULL  # noqa: SIM115 - closed below
    process = subprocess.Popen(
        command,
        cwd=folder,
        env=environment(),
        stdout=output,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )
    while process.poll() is None:
        memory = 0.0
        for one in psutil.process_iter(["pid"]):
            try:
                if os.getsid(one.pid) != process.pid:
                    continue
                times = one.cpu_times()
                seen[one.pid, one.create_time()] = times.user + times.system
                memory += one.memory_info().rss / 1e6
            except (psutil.Error, OSError):
                continue
        peak = max(peak, memory)
        time.sleep(PAUSE_S)
    wall, after = time.perf_counter() - start, os.times()
    if log:
        output.close()  # type: ignore[union-attr]
    waited = (after.children_user + after.children_system) - (
        before.children_user + before.children_system
    )
    return Used(wall, max(waited, sum(seen.values())), peak, process.returncode)
