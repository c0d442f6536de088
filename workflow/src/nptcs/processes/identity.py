"""A name for a process that no later process has, even after a restart of the machine."""

from __future__ import annotations

import json
import os
import select
import socket
import time
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path

import psutil

RUN = "NPTCS_RUN"
"""Environment variable with the name of the Snakemake process to which a process belongs."""

POLL_S = 0.3
"""Time between two looks at a process if the system cannot report its end."""


@dataclass(frozen=True)
class ProcessName:
    """A process on one machine since its last start.

    Parameters
    ----------
    host : str
        Name of the machine.
    boot : str
        What differs after each start of the machine; empty if the system does not say.
    space : str
        The namespace of process numbers (containers have their own).
    pid : int
    started : str
        When the process began, if possible in a unit that changes of the clock do not affect.
    """

    host: str
    boot: str
    space: str
    pid: int
    started: str

    def text(self) -> str:
        """Return it as one line that `read_name` reads."""
        return json.dumps(asdict(self))


def read_name(text: str) -> ProcessName | None:
    """Read what `ProcessName.text` wrote; None for any other text."""
    try:
        content = json.loads(text)
        name = ProcessName(**content)
    except (ValueError, TypeError):
        return None
    return name if isinstance(name.pid, int) and name.pid > 0 else None


def process_name(pid: int | None = None) -> ProcessName:
    """Name a process of this machine; by default this one.

    Raises
    ------
    ProcessLookupError
        If there is no such process.
    """
    pid = os.getpid() if pid is None else pid
    started = _started(pid)
    if started is None:
        raise ProcessLookupError(f"no process {pid}")
    return ProcessName(socket.gethostname(), _boot(), _space(), pid, started)


def lives(name: ProcessName) -> bool | None:
    """Tell whether a process is still running; None if this machine cannot know."""
    if name.host != socket.gethostname():
        return None
    if name.boot != _boot():
        return False
    if name.space != _space():
        return None
    return _started(name.pid) == name.started


def wait_for_end(name: ProcessName) -> None:
    """Wait until a process of this machine has ended."""
    with suppress(OSError, AttributeError):  # no such call, or no such process any more
        handle = os.pidfd_open(name.pid)
        try:
            if lives(name):
                select.select([handle], [], [])
        finally:
            os.close(handle)
    while lives(name):
        time.sleep(POLL_S)


def _started(pid: int) -> str | None:
    """Return when a process began; None if it has ended, zombies included."""
    stat = Path(f"/proc/{pid}/stat")
    if Path("/proc/self/stat").is_file():
        try:
            fields = stat.read_text(encoding="utf-8", errors="replace").rpartition(")")[2].split()
        except OSError:
            return None
        return None if fields[0] in "ZX" else f"{fields[19]} ticks"
    try:
        process = psutil.Process(pid)
        return None if process.status() == psutil.STATUS_ZOMBIE else f"{process.create_time():.0f}"
    except psutil.Error:
        return None


def _boot() -> str:
    file = Path("/proc/sys/kernel/random/boot_id")
    return file.read_text(encoding="ascii").strip() if file.is_file() else ""


def _space() -> str:
    try:
        return os.readlink("/proc/self/ns/pid")  # noqa: PTH115 - the link leads to no file
    except OSError:
        return ""
