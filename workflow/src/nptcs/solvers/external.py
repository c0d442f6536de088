"""Run a solver that the user has installed: one command, its children, its time, its licence.

The command gets its own process group. Whatever happens to the case, the whole group is ended: a
solver's launcher often leaves behind the process that computes, which holds the licence.
"""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from nptcs.solvers.contract import Status

POLL_S = 0.1
GRACE_S = 1.0
"""Time between the polite and the final signal; the campaign grants a case two seconds."""

OUTPUT_FILE = "nptcs_output.txt"

_groups: set[int] = set()


@dataclass(frozen=True)
class Ended:
    """A command that has ended by itself: exit code and all that it printed."""

    code: int
    output: str


class CommandStopped(Exception):
    """A command that could not be started, or was stopped: the status of its case, and why."""

    def __init__(self, status: Status, message: str) -> None:
        super().__init__(message)
        self.status = status


def time_for_command(timeout_s: float) -> float:
    """Return a command's time limit: a little before its case is stopped without a message."""
    return max(0.9 * timeout_s, timeout_s - 10.0)


def run_command(
    command: Sequence[str],
    folder: Path,
    timeout_s: float,
    watch: Callable[[str], None] | None = None,
) -> Ended:
    """Run a command in a folder and wait for its end.

    Parameters
    ----------
    command : sequence of str
    folder : Path
        Working folder; what the command prints is kept there in ``nptcs_output.txt``.
    timeout_s : float
        Time after which it is stopped, with all its children.
    watch : callable, optional
        Called now and then with all that has been printed; it may raise `CommandStopped`.

    Raises
    ------
    CommandStopped
        With status ``error`` if there is no such command, ``timeout``, or from `watch`.
    """
    output = folder / OUTPUT_FILE
    with output.open("wb") as stream:
        try:
            process = subprocess.Popen(
                list(command),
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=stream,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except (FileNotFoundError, PermissionError) as error:
            message = f"command not found or not executable: {command[0]}"
            raise CommandStopped(Status.ERROR, message) from error
    _groups.add(process.pid)
    try:
        end = time.monotonic() + timeout_s
        while process.poll() is None:
            left = end - time.monotonic()
            if left <= 0.0:
                raise CommandStopped(Status.TIMEOUT, f"stopped after {timeout_s:g} s")
            if watch is not None:
                watch(_read(output))
            time.sleep(min(POLL_S, left))
    finally:
        _end_group(process)
    return Ended(process.returncode, _read(output))


def end_all() -> None:
    """End at once all commands of this process that are still running."""
    for group in list(_groups):
        _signal(group, signal.SIGKILL)


def _end_group(process: subprocess.Popen[bytes]) -> None:
    """End the command and all that it started, politely first."""
    if _signal(process.pid, signal.SIGTERM):
        end = time.monotonic() + GRACE_S
        while time.monotonic() < end and _signal(process.pid, 0):
            process.poll()
            time.sleep(0.02)
        _signal(process.pid, signal.SIGKILL)
    process.wait()
    _groups.discard(process.pid)


def _signal(group: int, number: int) -> bool:
    """Send a signal to a process group; False if no process is left in it."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(group, number)
        return True
    return False


def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace")
