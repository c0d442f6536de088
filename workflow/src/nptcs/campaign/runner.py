"""Run solver cases side by side, one process per case, so that none can harm another."""

from __future__ import annotations

import multiprocessing
import os
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path

from nptcs.campaign import worker
from nptcs.campaign.record import CaseJob, CaseRecord, RecordStore, make_record
from nptcs.processes.marked import MARK, end_marked
from nptcs.processes.scratch import scratch_folder, socket_folder
from nptcs.solvers.contract import SolverResult, Status
from nptcs.solvers.registry import load_solver

THREAD_LIMITS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Set to 1 for every case: cases run side by side, and threads waiting for a core cost time."""

KILL_AFTER_S = 2.0
"""Grace between the polite and the final signal to a case that is out of time."""

SENT_FROM_OUTSIDE = frozenset({signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP})
"""Signals that come from outside a case: a user, the queue, or the kernel when memory runs out."""

OnRecord = Callable[[CaseRecord, bool, int, int], None]
"""Called with the record, whether it was reused, how many are done, how many there are."""


CaseOutcome = tuple[SolverResult, float, float | None]
"""Result, wall time in s, largest memory in MB (None for a process that died)."""


@dataclass
class _Running:
    job: CaseJob
    process: BaseProcess
    channel: Connection
    folder: Path
    started: float


def run_cases(
    jobs: Sequence[CaseJob], store: RecordStore, cores: int, progress: OnRecord
) -> list[CaseRecord]:
    """Solve cases, or take their records from the store.

    A case that raises, hangs, crashes or kills its process becomes one record with a status and
    a message; the others continue.

    Parameters
    ----------
    jobs : sequence of CaseJob
        The cases.
    store : RecordStore
        Solved cases; new ones are added at once, so that an interrupted campaign continues where
        it stopped.
    cores : int
        Cases that run at a time.
    progress : callable
        Called with each record as it comes.

    Returns
    -------
    list of CaseRecord
        One per job, in the order of `jobs`.
    """
    records: dict[int, CaseRecord] = {}

    def done(position: int, record: CaseRecord, reused: bool) -> None:
        if not reused:
            store.write(record)
        records[position] = record
        progress(record, reused, len(records), len(jobs))

    waiting = []
    for position, job in enumerate(jobs):
        known = store.read(job)
        if known is None:
            waiting.append(position)
        else:
            done(position, known, True)
    if waiting:
        for position, outcome in _solve_all(jobs, waiting, cores):
            done(position, make_record(jobs[position], *outcome), False)
    return [records[position] for position in range(len(jobs))]


def _solve_all(
    jobs: Sequence[CaseJob], waiting: Sequence[int], cores: int
) -> Iterator[tuple[int, CaseOutcome]]:
    """Solve the jobs at the positions `waiting`; yield each as it ends."""
    context = multiprocessing.get_context("forkserver")
    modules = {jobs[position].module for position in waiting}
    preload = {module for module in modules if not module.endswith(".py")}
    preload.update(*(load_solver(module).preload for module in sorted(preload)))
    context.set_forkserver_preload(["nptcs.campaign.worker", *sorted(preload)])
    queue = list(reversed(waiting))
    running: dict[int, _Running] = {}
    try:
        while queue or running:
            while queue and len(running) < cores:
                position = queue.pop()
                running[position] = _start(jobs[position])
            for position in _ended(running):
                case = running.pop(position)
                yield position, _collect(case)
    finally:
        for case in running.values():
            case.process.terminate()
        for case in running.values():
            stop(case.process, case.folder)


def _start(job: CaseJob) -> _Running:
    """Start the process of a case."""
    context = multiprocessing.get_context("forkserver")
    receive, send = context.Pipe(duplex=False)
    folder = case_folder()
    process = context.Process(target=worker.run, args=(job, send, str(folder)), name=job.case_id)
    with without_main_file(), case_environment():
        process.start()
    send.close()
    return _Running(job, process, receive, folder, time.monotonic())


def _ended(running: dict[int, _Running]) -> list[int]:
    """Wait until a case has sent its result, died or run out of time; return all such cases."""
    now = time.monotonic()
    left = min(case.started + case.job.timeout_s - now for case in running.values())
    ready = wait([case.channel for case in running.values()], timeout=max(0.0, left))
    now = time.monotonic()
    return [
        position
        for position, case in running.items()
        if case.channel in ready or now - case.started >= case.job.timeout_s
    ]


def _collect(case: _Running) -> CaseOutcome:
    """Take the result of a case that has ended, or say how it died."""
    seconds = time.monotonic() - case.started
    try:
        if not case.channel.poll():
            message = f"stopped after {seconds:.1f} s (timeout_s = {case.job.timeout_s:g})"
            return SolverResult(status=Status.TIMEOUT, message=message), seconds, None
        text, seconds, memory_mb = case.channel.recv()
        return SolverResult.model_validate_json(text), seconds, memory_mb
    except EOFError:
        case.process.join(KILL_AFTER_S)
        code = case.process.exitcode
        died = code is not None and -code in SENT_FROM_OUTSIDE
        message = cause_of_death(code)
        return SolverResult(status=Status.ERROR, message=message, died=died), seconds, None
    finally:
        case.channel.close()
        stop(case.process, case.folder)


def cause_of_death(exit_code: int | None) -> str:
    """Describe how a process that sent no result ended."""
    if exit_code is not None and exit_code < 0:
        return f"the solver's process was killed by signal {signal.Signals(-exit_code).name}"
    return f"the solver's process ended without a result (exit code {exit_code})"


def case_folder() -> Path:
    """Make the folder in which a process that solves cases has its temporary files."""
    return Path(tempfile.mkdtemp(dir=scratch_folder(), prefix="case-"))


def stop(process: BaseProcess, folder: Path) -> None:
    """End a process, politely first, and whatever it left running; remove its folder."""
    process.join(0.1)
    if process.is_alive():
        process.terminate()
        process.join(KILL_AFTER_S)
    if process.is_alive():
        process.kill()
        process.join()
    if process.exitcode != 0:  # it may have had no time to end its commands
        end_marked(str(folder))
    process.close()
    shutil.rmtree(folder, ignore_errors=True)


@contextmanager
def case_environment() -> Iterator[None]:
    """Start the fork server, and so all cases, with one thread and the mark of this process."""
    changes = {**dict.fromkeys(THREAD_LIMITS, "1"), MARK: str(scratch_folder())}
    before = {name: os.environ.get(name) for name in changes}
    os.environ.update(changes)
    temporary, tempfile.tempdir = tempfile.tempdir, str(socket_folder())
    try:
        yield
    finally:
        tempfile.tempdir = temporary
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def without_main_file() -> Iterator[None]:
    """Keep a new process from running the caller's main script a second time.

    multiprocessing imports the parent's ``__main__`` in each child when it has a file. Here that
    may be a Snakemake script, and the worker needs nothing from it.
    """
    main = sys.modules["__main__"]
    file = main.__dict__.pop("__file__", None)
    spec, main.__spec__ = main.__spec__, None
    try:
        yield
    finally:
        main.__spec__ = spec
        if file is not None:
            main.__file__ = file
