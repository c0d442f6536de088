"""A small process that outlives the one it watches: it ends what is left of it and cleans up.

Run as a script: ``warden.py FOLDER PID``. Its input closes when the process PID ends, however it
ends. If the run of Snakemake ends first, PID is asked to end, and then killed.
"""

from __future__ import annotations

import os
import shutil
import signal
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path

GRACE_S = 2.0
"""Time that the watched process has to end after its run."""


def watch(folder: Path, pid: int) -> None:
    """Wait for the end of a process, then end what carries the mark of its folder; remove it."""
    from nptcs.processes.identity import RUN, read_name, wait_for_end
    from nptcs.processes.marked import end_marked

    ended = threading.Event()
    run = read_name(os.environ.get(RUN, ""))

    def end_with_run() -> None:
        if run is None:
            return
        wait_for_end(run)
        for number in (signal.SIGTERM, signal.SIGKILL):
            if ended.is_set():
                return
            with suppress(ProcessLookupError):
                os.kill(pid, number)
            ended.wait(GRACE_S)

    threading.Thread(target=end_with_run, daemon=True).start()
    sys.stdin.buffer.read()
    ended.set()
    time.sleep(0.1)
    end_marked(str(folder))
    shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    for ignored in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        signal.signal(ignored, signal.SIG_IGN)
    sys.path[0] = str(Path(__file__).parents[2])
    watch(Path(sys.argv[1]), int(sys.argv[2]))
