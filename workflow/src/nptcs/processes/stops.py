"""Clean stops: a script ends with its run, and a run that is stopped ends its jobs."""

from __future__ import annotations

import os
import shlex
import signal
import sys
import threading
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import Any

from nptcs.processes.identity import RUN, read_name, wait_for_end
from nptcs.processes.marked import end_children

GRACE_S = 2.0
"""Time that a process has to exit cleanly after it was asked to."""


def leave_in_order(number: int, frame: FrameType | None) -> None:
    """Turn a signal into an exit, so that files that are being written are removed.

    Raises
    ------
    SystemExit
        With 128 plus the number of the signal, as a shell reports it.
    """
    raise SystemExit(128 + number)


def end_with_run() -> None:
    """Let this process end when the Snakemake process that started it is gone, however that ended.

    Without effect outside a run. From now on SIGTERM is a clean exit.
    """
    run = read_name(os.environ.get(RUN, ""))
    if run is None or threading.current_thread() is not threading.main_thread():
        return
    signal.signal(signal.SIGTERM, leave_in_order)

    def watch() -> None:
        wait_for_end(run)
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(GRACE_S)
        os.kill(os.getpid(), signal.SIGKILL)

    threading.Thread(target=watch, daemon=True).start()


def stop_jobs_on_signals(arguments: Sequence[str]) -> None:
    """Let SIGINT and SIGTERM end all jobs of this run at once, and say how to continue.

    Snakemake alone would wait for its running jobs, for hours if need be.

    Parameters
    ----------
    arguments : sequence of str
        The command line of this process.
    """
    for number in (signal.SIGINT, signal.SIGTERM):
        before = signal.getsignal(number)
        if before is not signal.SIG_IGN and callable(before):
            signal.signal(number, _stopping(before, command_again(arguments)))


Handler = Callable[[int, FrameType | None], Any]


def _stopping(before: Handler, again: str) -> Handler:
    def stop(number: int, frame: FrameType | None) -> None:
        print(
            "\nStopping: the running jobs are being ended; all solved cases are kept.\n"
            f"To continue, type the same command again:\n    {again}",
            file=sys.stderr,
            flush=True,
        )
        threading.Thread(target=end_children, args=(GRACE_S,)).start()
        before(number, frame)

    return stop


def command_again(arguments: Sequence[str]) -> str:
    """Return the command that started this run, as a user types it.

    Examples
    --------
    >>> command_again(["/opt/venv/bin/snakemake", "-j2"])
    'snakemake -j2'
    >>> command_again(["/opt/venv/lib/snakemake/__main__.py", "-j2", "--config", "a b"])
    "python -m snakemake -j2 --config 'a b'"
    """
    if "MAKELEVEL" in os.environ:
        return "make run"
    program = Path(arguments[0])
    name = f"python -m {program.parent.name}" if program.name == "__main__.py" else program.name
    return f"{name} {shlex.join(arguments[1:])}".strip()
