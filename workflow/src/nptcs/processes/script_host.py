"""A Python process in which the scripts of jobs run, each in a fork, and share what is imported.

Run as a script: ``script_host.py DESCRIPTOR``. Through the connection of that number come
``(number, script, environment)``; back go ``(number, exit code)``. With a number of None nothing is
run: one of `TASKS`, which is in the script's place, is done when there is nothing else to do. The
host ends, and its jobs with it, when it gets None or the connection closes
(`nptcs.processes.hosted.ScriptHost`).

Starting Python with pandas, pandera and SciPy takes more processor time than most jobs need for
their work; a fork takes a few milliseconds. The host has one thread and holds no results, so that a
fork of it is as good as a new interpreter.
"""

from __future__ import annotations

import ast
import gc
import importlib
import multiprocessing
import os
import runpy
import signal
import sys
import tempfile
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from multiprocessing.context import ForkProcess
from pathlib import Path
from typing import Any

GRACE_S = 2.0
"""Time that a job has to exit cleanly when the host has ended."""

AT_FIRST_USE: Mapping[str, tuple[str, ...]] = {
    "pandera": (
        "pandera.backends.pandas.register",
        "pandera.backends.pandas.builtin_checks",
        "pandera.backends.pandas.builtin_hypotheses",
        "pandera.api.geopandas.container",
    ),
    "pandas": ("pandas.io.formats.csvs", "pandas.io.formats.string"),
    "nptcs": ("snakemake.io",),
}
"""What is imported only when a library is first used, as every script uses it: to check a table, to
write it, and to read what Snakemake gives a script. Otherwise each fork would import it again."""


def serve(channel: Connection) -> None:
    """Run scripts until told to end; then end those that are still running."""
    jobs: dict[int, ForkProcess] = {}
    tasks: deque[tuple[str, str]] = deque()
    while True:
        ended = {process.sentinel: number for number, process in jobs.items()}
        ready = wait([channel, *ended], timeout=0 if tasks else None)
        for sentinel in ended.keys() & set(ready):
            process = jobs.pop(ended[sentinel])
            process.join()
            with suppress(OSError):  # nobody is listening: the next message will say so
                channel.send((ended[sentinel], process.exitcode))
            process.close()
        if channel in ready:
            message = receive(channel)
            if message is None:
                for process in jobs.values():
                    process.terminate()
                return
            number, script, environment = message
            if number is None:
                tasks.append(script)
            else:
                jobs[number] = start(script, environment)
        elif not ready:
            task, name = tasks.popleft()
            TASKS[task](name)


def receive(channel: Connection) -> Any:
    """Return the next message; None also if the other side is gone."""
    try:
        return channel.recv()
    except (EOFError, OSError):
        return None


def start(script: str, environment: Mapping[str, str]) -> ForkProcess:
    """Import what a script imports, so that later jobs have it too, and run it in a fork."""
    import_for(script)
    gc.freeze()  # the fork's collector does not touch, and so copy, memory shared with the host
    process = multiprocessing.get_context("fork").Process(target=run, args=(script, environment))
    process.start()
    return process


def import_for(script: str) -> None:
    """Execute the import statements at the top of a script; those that fail, fail in the job."""
    with suppress(OSError, SyntaxError):
        for statement in ast.parse(Path(script).read_bytes()).body:
            if isinstance(statement, ast.Import | ast.ImportFrom):
                code = compile(ast.Module([statement], []), script, "exec", dont_inherit=True)
                with suppress(Exception):
                    exec(code, {})
    for library, modules in AT_FIRST_USE.items():
        if library in sys.modules:
            for module in modules:
                with suppress(ImportError):
                    importlib.import_module(module)


def hash_code(module: str) -> None:
    """Hash the code of a module and of what it imports; the forks find it in memory."""
    from nptcs.provenance import code_hash

    with suppress(Exception):  # what cannot be read is for the job to say
        code_hash(module)


def import_in_fork(module: str) -> None:
    """Let a fork import a module at low priority.

    What is compiled then is kept on disk, so that the processes that need it only read it.
    """
    fork = multiprocessing.get_context("fork")
    fork.Process(target=_run_import, args=(module,), daemon=True).start()


def _run_import(module: str) -> None:
    os.nice(10)
    threading.Thread(target=_end_with_host, daemon=True).start()
    with suppress(Exception):  # what cannot be imported is for the case to say
        importlib.import_module(module)


TASKS: Mapping[str, Callable[[str], None]] = {
    "import": import_for,
    "hash": hash_code,
    "import in a fork": import_in_fork,
}


def run(script: str, environment: Mapping[str, str]) -> None:
    """Run a script as a new Python process would, but in a fork of the host."""
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Thread(target=_end_with_host, daemon=True).start()
    os.environ.update(environment)
    tempfile.tempdir = None
    sys.argv, sys.path[0] = [script], str(Path(script).parent)
    runpy.run_path(script, run_name="__main__")


def _end_with_host() -> None:
    """End this job when the host is gone, however that ended: nobody waits for the job any more."""
    host = multiprocessing.parent_process()
    if host is not None:
        host.join()
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(GRACE_S)
        os.kill(os.getpid(), signal.SIGKILL)


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for Snakemake and the jobs
    sys.path[0] = str(Path(__file__).parents[2])
    serve(Connection(int(sys.argv[1])))
